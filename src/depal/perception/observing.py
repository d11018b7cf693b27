"""One look: from frames to boxes."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from depal.domain import DeliveryLine, Product
from depal.geometry import Pose
from depal.perception.assembling import boxes_of
from depal.perception.detecting import Expected, Finder, Found
from depal.perception.faces import Face, Facing, Look, Raster, Rectangle
from depal.perception.pictures import PictureBook
from depal.perception.rasters import Region, rasters_of
from depal.perception.recognition import Gallery, Patch, gallery_of, identify, patch_of
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
        faces = [face for raster in rasters for face in self._faces(raster, known)]
        boxes = boxes_of(faces, self.region, known.products)
        return Look(boxes, faces=tuple(faces))

    def _faces(self, raster: Raster, known: Known) -> list[Face]:
        found = self.finder.faces(raster, known.expected, None)
        return [self._face(raster, each, known) for each in found]

    def _face(self, raster: Raster, found: Found, known: Known) -> Face:
        """A found face in the cell, named where its print says something."""
        rectangle, name = found.rectangle, found.name
        if known.gallery is not None:
            identity = identify(patch_of(raster, rectangle, 0.0015), known.gallery)
            if identity is not None:
                name = identity.name
                move = identity.refined
                c, s = math.cos(rectangle.turn), math.sin(rectangle.turn)
                rectangle = replace(
                    rectangle,
                    u=rectangle.u + c * move.du - s * move.dv,
                    v=rectangle.v + s * move.du + c * move.dv,
                    turn=rectangle.turn + move.turn,
                )
        pose = raster.pose_of(rectangle)
        if raster.facing is Facing.FRONT:
            yaw = math.atan(float(np.clip(found.slopes[0], -STEEPEST, STEEPEST))) * TRUST
            c, s = math.cos(yaw), math.sin(yaw)
            pose = pose @ Pose(rotation=((c, 0.0, -s), (0.0, 1.0, 0.0), (s, 0.0, c)))
        size = (rectangle.width, rectangle.height)
        return Face(raster.facing, pose, size, found.probability, found.known, name)
