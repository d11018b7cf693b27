"""One look: from frames to boxes."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from depal.domain import Product
from depal.geometry import Pose
from depal.perception.assembling import boxes_of
from depal.perception.detecting import Expected, Finder, Found, Printed
from depal.perception.faces import Face, Facing, Look, Raster
from depal.perception.rasters import Region, rasters_of
from depal.perception.recognition import Gallery, identify, sightings
from depal.perception.recognition.rectifying import rectified
from depal.ports import Frame

STEEPEST = math.radians(6)
"""A front's yaw is taken from its depths up to this; they are noisy."""

TRUST = 0.3
"""Of a front's slope so much is believed, for most boxes stand straight."""


@dataclass(frozen=True, slots=True)
class Known:
    """What is known before the look.

    Attributes:
        products: what may be there; none where nobody knows.
        sizes: of boxes that may be there, without a name: length, width, height [m].
        gallery: the prints that may come; None where there are no pictures.
        standing: whether boxes stand upright.
    """

    products: tuple[Product, ...] = ()
    sizes: tuple[tuple[float, float, float], ...] = ()
    gallery: Gallery | None = None
    standing: bool = True

    @property
    def expected(self) -> Expected:
        """The sizes of boxes."""
        sizes = {product.size for product in self.products} | set(self.sizes)
        return Expected(tuple(sorted(sizes)), self.standing)


@dataclass(slots=True)
class Observer:
    """Finds boxes in the frames of a cell's cameras.

    Attributes:
        region: where boxes are looked for.
        finder: of faces.
    """

    region: Region
    finder: Finder = field(default_factory=Finder)

    def look(self, frames: Sequence[Frame], known: Known) -> Look:
        """The boxes that frames of one moment show.

        Args:
            frames: one of each camera.
            known: what is known before.
        """
        rasters = rasters_of(frames, self.region)
        faces = [face for raster in rasters for face in self._faces(raster, frames, known)]
        boxes = boxes_of(faces, self.region, known.products)
        return Look(boxes, faces=tuple(faces))

    def _faces(self, raster: Raster, frames: Sequence[Frame], known: Known) -> list[Face]:
        prints = None if known.gallery is None else printed_on(raster, known.gallery)
        found = self.finder.faces(raster, known.expected, prints)
        faces = [_laid(raster, each) for each in found]
        if known.gallery is None:
            return faces
        return [_named(face, frames, known.gallery) for face in faces]


def printed_on(raster: Raster, gallery: Gallery) -> tuple[Printed, ...]:
    """Where prints appear on a raster."""
    return tuple(Printed(each.rectangle, each.name) for each in sightings(raster, gallery))


def _laid(raster: Raster, found: Found) -> Face:
    """A found face in the cell."""
    pose = raster.pose_of(found.rectangle)
    if raster.facing is Facing.FRONT:
        yaw = math.atan(float(np.clip(found.slopes[0], -STEEPEST, STEEPEST))) * TRUST
        c, s = math.cos(yaw), math.sin(yaw)
        pose = pose @ Pose(rotation=((c, 0.0, -s), (0.0, 1.0, 0.0), (s, 0.0, c)))
    size = (found.rectangle.width, found.rectangle.height)
    return Face(raster.facing, pose, size, found.probability, found.known, found.name)


def _named(face: Face, frames: Sequence[Frame], gallery: Gallery) -> Face:
    """A face with what its print says, seen finely, and moved to where the print says it is."""
    patch = rectified(frames, face.facing, face.cell_from_face, face.size)
    identity = None if patch is None else identify(patch, gallery)
    if identity is None:
        return face
    move, c, s = identity.refined, *_turn(identity.refined.turn)
    shift = Pose((move.du, move.dv, 0.0), ((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)))
    return replace(face, cell_from_face=face.cell_from_face @ shift, name=identity.name)


def _turn(angle: float) -> tuple[float, float]:
    return math.cos(angle), math.sin(angle)
