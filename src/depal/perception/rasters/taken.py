"""What of a raster belongs to faces that are known already: nothing else is looked for there."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import cv2
import numpy as np
import numpy.typing as npt

from depal.perception.faces import Raster, Rectangle

Flags = npt.NDArray[np.bool_]
Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]

RIM = 0.007
"""Faces may reach so far into each other, each [m]."""

DEEP = 0.03
"""What is seen so far before a face hides it there, and belongs to another [m]."""

MOST = 0.25
"""A rectangle of which more belongs to known faces is none of those that are looked for."""


@dataclass(frozen=True)
class Taken:
    """The places of known faces.

    Attributes:
        places: (h, w) bool.
    """

    places: Flags

    @classmethod
    def by(cls, raster: Raster, faces: Sequence[Rectangle]) -> Self:
        """Of faces in the plane of a raster."""
        places = np.zeros(raster.known.shape, dtype=np.bool_)
        for face in faces:
            rows, columns, inside = filled(face, raster.step, places.shape, RIM)
            with np.errstate(invalid="ignore"):
                hidden = face.depth - raster.depth[rows, columns] > DEEP
            places[rows, columns] |= inside & ~hidden
        return cls(places)

    def turned(self, raster_from_turned: Floats, shape: tuple[int, int]) -> Self:
        """The same in a turned raster.

        Args:
            raster_from_turned: (2, 3) from its pixels to those of this one.
            shape: height and width [pixel].
        """
        height, width = shape
        how = cv2.INTER_NEAREST | cv2.WARP_INVERSE_MAP
        grey = self.places.astype(np.uint8)
        return type(self)(
            np.asarray(cv2.warpAffine(grey, raster_from_turned, (width, height), flags=how)) > 0
        )

    def leaves(self, pixels: Ints) -> Flags:
        """(n,) which rectangles (n, 4), left, top, right, bottom, may still be looked for."""
        height, width = self.places.shape
        left, right = np.clip(pixels[:, [0, 2]], 0, width).T
        top, bottom = np.clip(pixels[:, [1, 3]], 0, height).T
        sums = self._sums
        inside = sums[bottom, right] - sums[top, right] - sums[bottom, left] + sums[top, left]
        area = (pixels[:, 2] - pixels[:, 0]) * (pixels[:, 3] - pixels[:, 1])
        return np.asarray(inside <= MOST * area)

    @cached_property
    def _sums(self) -> Ints:
        return np.asarray(cv2.integral(self.places.astype(np.uint8)), dtype=np.int64)


def filled(
    rectangle: Rectangle, step: float, shape: tuple[int, ...], less: float = 0.0
) -> tuple[slice, slice, Flags]:
    """The pixels of a raster inside a rectangle.

    Args:
        rectangle: in the raster's plane.
        step: edge of a pixel [m].
        shape: of the raster [pixel].
        less: every side is taken to lie so much farther in [m].

    Returns:
        The rows and the columns that it lies in, and which of the pixels there are inside.
    """
    wide = max(rectangle.width - 2 * less, step)
    high = max(rectangle.height - 2 * less, step)
    inner = Rectangle(rectangle.u, rectangle.v, wide, high, rectangle.turn, rectangle.depth)
    corners = np.round(inner.corners / step).astype(np.int32)
    first = np.clip(corners.min(axis=0), 0, (shape[1], shape[0]))
    last = np.clip(corners.max(axis=0) + 1, 0, (shape[1], shape[0]))
    (left, top), (right, bottom) = first.tolist(), last.tolist()
    inside = np.zeros((bottom - top, right - left), dtype=np.uint8)
    if inside.size:
        cv2.fillConvexPoly(inside, corners - first.astype(np.int32), (1,))
    return slice(top, bottom), slice(left, right), inside > 0
