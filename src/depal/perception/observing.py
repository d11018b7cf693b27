"""One look: from frames to boxes. A later look finds anew only where something has changed."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import chain

import cv2
import numpy as np
import numpy.typing as npt

from depal.domain import Product
from depal.geometry import Pose, Vector3
from depal.geometry.abreast import abreast
from depal.perception.assembling import boxes_of
from depal.perception.changing import changed
from depal.perception.detecting import (
    Expected,
    Finder,
    Found,
    Printed,
    Refuted,
    Weighed,
    implied_by,
)
from depal.perception.faces import Face, Look, Raster, Rectangle
from depal.perception.locating import located
from depal.perception.rasters import Region, Taken, filled, rasters_of
from depal.perception.recognition import Gallery, sightings
from depal.perception.relations import relations_of
from depal.ports import Frame

Flags = npt.NDArray[np.bool_]

AROUND = 0.018
"""A face is found anew where anything has changed on it or so near to it [m]."""

TOUCHED = 0.02
"""A face is found anew when more than this share of it and its surroundings has changed."""

TWICE = 0.025
"""Faces that are no farther from each other are one that was found twice [m]."""


@dataclass(frozen=True, slots=True, eq=False)
class ByItself:
    """What one raster shows, whatever the other one does.

    Attributes:
        kept: faces that look as they did before.
        weighed: what else may be faces; None where nothing new can be.
        found: of that what the raster by itself takes for faces.
    """

    kept: tuple[Face, ...]
    weighed: Weighed | None = None
    found: tuple[Face, ...] = ()


@dataclass(frozen=True, slots=True)
class Known:
    """What is known before the look.

    Attributes:
        products: what may be there; none where nobody knows.
        sizes: of boxes that may be there, without a name: length, width, height [m].
        gallery: the prints that may come; None where there are no pictures.
        standing: whether boxes stand upright.
        refuted: what is no box: something else explains what is seen there.
    """

    products: tuple[Product, ...] = ()
    sizes: tuple[Vector3, ...] = ()
    gallery: Gallery | None = None
    standing: bool = True
    refuted: Refuted = field(default_factory=Refuted)

    @property
    def expected(self) -> Expected:
        """The sizes of boxes."""
        sizes = {product.size for product in self.products} | set(self.sizes)
        return Expected(tuple(sorted(sizes)), self.standing)


@dataclass(frozen=True, slots=True, eq=False)
class Observation:
    """What a look has made of its frames.

    Attributes:
        look: the boxes, with faces where the boxes have them.
        rasters: what was seen.
        faces: found on each raster, where each by itself seemed to be.
    """

    look: Look
    rasters: tuple[Raster, Raster]
    faces: tuple[tuple[Face, ...], tuple[Face, ...]]


@dataclass(frozen=True, slots=True, eq=False)
class Observer:
    """Finds boxes in the frames of a cell's cameras.

    Attributes:
        region: where boxes are looked for.
        finder: of faces.
    """

    region: Region
    finder: Finder = field(default_factory=Finder)

    def look(
        self, frames: Sequence[Frame], known: Known, before: Observation | None = None
    ) -> Observation:
        """The boxes that frames of one moment show.

        Args:
            frames: one of each camera.
            known: what is known before.
            before: the look before; what looks as it did then is taken over.
        """
        rasters = rasters_of(frames, self.region)

        def weighed_on(k: int) -> ByItself:
            kept: tuple[Face, ...] = ()
            part: Raster | None = rasters[k]
            if before is not None:
                kept, part = _unchanged(before.rasters[k], before.faces[k], rasters[k])
            if part is None:
                return ByItself(kept)
            weighed = self._weighed(part, kept, known)
            return ByItself(kept, weighed, _laid_on(part, self.finder.chosen(weighed)))

        by_itself = abreast(weighed_on, range(len(rasters)))

        def chosen_on(k: int) -> tuple[Face, ...]:
            return self._chosen(by_itself[k], by_itself[1 - k], known)

        found = chain.from_iterable(abreast(chosen_on, range(len(rasters))))

        def located_one(face: Face) -> Face:
            return located(face, frames, known.expected.faces(face.facing), known.gallery)

        placed = abreast(located_one, found)
        fronts, tops = (
            (*own.kept, *distinct([each for each in placed if each.facing is facing], own.kept))
            for facing, own in zip((raster.facing for raster in rasters), by_itself, strict=True)
        )
        faces = (fronts, tops)
        boxes = boxes_of([*faces[0], *faces[1]], self.region, known.products)
        settled = tuple(face for box in boxes for face in box.faces)
        look = Look(boxes, *relations_of(boxes), faces=settled)
        return Observation(look, rasters, faces)

    def _chosen(self, own: ByItself, other: ByItself, known: Known) -> tuple[Face, ...]:
        """The new faces of a raster, by what it and the other one showed by themselves."""
        weighed, speaking = own.weighed, (*other.kept, *other.found)
        if weighed is None:
            return ()
        back = self.region.cell_from_region.inverse
        implied = implied_by(speaking, weighed.raster, known.expected, back)
        return _laid_on(weighed.raster, self.finder.chosen(weighed, implied))

    def _weighed(self, raster: Raster, kept: Sequence[Face], known: Known) -> Weighed:
        fixed = [rectangle_of(raster, face) for face in kept]
        taken = Taken.by(raster, fixed) if fixed else None
        prints = None if known.gallery is None else printed_on(raster, known.gallery, taken)
        refuted = known.refuted.on(raster)
        return self.finder.weighed(raster, known.expected, prints, fixed, refuted)


def distinct(faces: Sequence[Face], kept: Sequence[Face] = ()) -> tuple[Face, ...]:
    """Faces in their order, without those that were found at two places and lie at one.

    Two parts of one face may both be found; its print then sets both right. The likelier stays.

    Args:
        faces: that look one way, where they are located.
        kept: others that look this way, which stay.
    """
    chosen = list[Face]()
    for face in sorted(faces, key=lambda face: -face.score):
        if all(_apart(face, other) > TWICE for other in (*kept, *chosen)):
            chosen.append(face)
    return tuple(face for face in faces if any(face is each for each in chosen))


def _apart(face: Face, other: Face) -> float:
    """How far two faces' middles are from each other, or their edges differ if that is more [m]."""
    middles = math.dist(face.cell_from_face.translation, other.cell_from_face.translation)
    return max(middles, *(abs(a - b) for a, b in zip(face.size, other.size, strict=True)))


def printed_on(raster: Raster, gallery: Gallery, taken: Taken | None = None) -> tuple[Printed, ...]:
    """Where prints appear on a raster, but for what of it belongs to known faces."""
    seen = sightings(raster, gallery, taken)
    return tuple(Printed(each.rectangle, each.name) for each in seen)


def rectangle_of(raster: Raster, face: Face) -> Rectangle:
    """A face in the plane of a raster."""
    pose = raster.cell_from_raster.inverse @ face.cell_from_face
    u, v, depth = pose.translation
    turn = math.atan2(pose.rotation[1][0], pose.rotation[0][0])
    return Rectangle(u, v, *face.size, turn, depth)


def _laid_on(raster: Raster, found: Sequence[Found]) -> tuple[Face, ...]:
    """Found faces in the cell."""
    return tuple(
        Face(
            raster.facing,
            raster.pose_of(each.rectangle),
            (each.rectangle.width, each.rectangle.height),
            each.probability,
            each.known,
            each.name,
        )
        for each in found
    )


def _unchanged(
    before: Raster, faces: Sequence[Face], now: Raster
) -> tuple[tuple[Face, ...], Raster | None]:
    """The faces that look as they did, and the part of the raster where others may be.

    Args:
        before: of the look before.
        faces: that were found on it.
        now: of this look.

    Returns:
        Faces to keep, and a part of `now`; None where nothing new can be.
    """
    differs = changed(before, now)
    reach = 2 * round(AROUND / now.step) + 1
    near = cv2.dilate(differs.astype(np.uint8), np.ones((reach, reach), dtype=np.uint8)) > 0
    kept, explained = [], np.zeros(now.known.shape, dtype=np.uint8)
    for face in faces:
        down, across, inside = filled(rectangle_of(now, face), now.step, explained.shape)
        if (near[down, across] & inside).sum() <= TOUCHED * max(int(inside.sum()), 1):
            kept.append(face)
            explained[down, across] |= inside
    open_ = ((now.known | near) & (explained == 0)).astype(np.uint8)
    _, labels = cv2.connectedComponents(open_)
    touched = np.unique(labels[near & (open_ > 0)])
    rows, columns = np.nonzero(np.isin(labels, touched[touched > 0]))
    if not rows.size:
        return tuple(kept), None
    return tuple(kept), _part(now, rows, columns, reach)


def _part(
    raster: Raster, rows: npt.NDArray[np.intp], columns: npt.NDArray[np.intp], around: int
) -> Raster:
    """The part of a raster that holds these pixels and some around."""
    height, width = raster.known.shape
    first, last = max(int(rows.min()) - around, 0), min(int(rows.max()) + around + 1, height)
    left, right = max(int(columns.min()) - around, 0), min(int(columns.max()) + around + 1, width)
    at = (slice(first, last), slice(left, right))
    shift = Pose((left * raster.step, first * raster.step, 0.0))
    return replace(
        raster,
        cell_from_raster=raster.cell_from_raster @ shift,
        colour=np.ascontiguousarray(raster.colour[at]),
        depth=np.ascontiguousarray(raster.depth[at]),
        known=np.ascontiguousarray(raster.known[at]),
    )
