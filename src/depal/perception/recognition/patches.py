"""Faces cut out of pictures and laid flat."""

import math
from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from depal.geometry import Vector3
from depal.perception.faces import Facing, Raster, Rectangle
from depal.perception.recognition.features import Features, features_of

Bytes = npt.NDArray[np.uint8]
Flags = npt.NDArray[np.bool_]

MARGIN = 0.012
"""Patches show so much around their face: its pose may be wrong by that [m]."""

FINE = 0.0015
"""Edge of a pixel of the patches that are named [m]."""

RIM = 0.004
"""Means are taken so far inside a face's edges [m]."""

SOFT = 0.7
"""Patches are smoothed by so much before they are compared, as a Gauss curve's width [pixel]."""


@dataclass(frozen=True, slots=True, eq=False)
class Patch:
    """A face as it was seen, laid flat; its middle is the picture's middle.

    Attributes:
        facing: which way it looks.
        size: width and height of the face [m]; the picture shows `margin` more on every side.
        colour: (h, w, 3) uint8 RGB.
        known: (h, w): seen by a camera.
        step: edge of a pixel [m].
        margin: see above [m].
        eye: where the camera stands that saw it, in the face's frame [m]; None for a raster's.
    """

    facing: Facing
    size: tuple[float, float]
    colour: Bytes
    known: Flags
    step: float = FINE
    margin: float = MARGIN
    eye: Vector3 | None = None

    @property
    def features(self) -> Features:
        """What of it resists the light; means are taken over the face alone."""
        soft = cv2.GaussianBlur(self.colour.astype(np.float32), (0, 0), SOFT)
        weights = self.known.astype(np.float32)
        counts = weights.copy()
        rim = round((self.margin + RIM) / self.step)
        if rim > 0:
            counts[:rim] = counts[-rim:] = 0.0
            counts[:, :rim] = counts[:, -rim:] = 0.0
        return features_of(np.asarray(soft, dtype=np.float32), weights, self.step, counts)


def patch_of(raster: Raster, rectangle: Rectangle, step: float | None = None) -> Patch:
    """A patch cut out of a raster.

    Args:
        raster: what is seen.
        rectangle: which face.
        step: edge of the patch's pixels [m]; the raster's own where none is given.
    """
    step = raster.step if step is None else step
    warp, shape = _warp(rectangle, raster.step, step)
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    colour = cv2.warpAffine(raster.colour, warp, shape, flags=flags)
    known = cv2.warpAffine(raster.known.view(np.uint8) * 255, warp, shape, flags=flags)
    size = (rectangle.width, rectangle.height)
    return Patch(raster.facing, size, np.asarray(colour, np.uint8), known > 250, step)  # noqa: PLR2004


def cut_out(raster: Features, rectangle: Rectangle, step: float) -> Features:
    """The features of a face and a margin around it, cut out of those of a raster.

    Args:
        raster: features of all of it.
        rectangle: which face.
        step: edge of a pixel of the result [m].
    """
    warp, shape = _warp(rectangle, raster.step, step)
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    values = cv2.warpAffine(raster.values, warp, shape, flags=flags)
    weights = cv2.warpAffine(raster.weights, warp, shape, flags=flags)
    return Features(np.asarray(values), np.asarray(weights), step)


def _warp(
    rectangle: Rectangle, raster_step: float, step: float
) -> tuple[npt.NDArray[np.float64], tuple[int, int]]:
    """From a patch's pixels to a raster's, and the patch's width and height [pixel]."""
    width, height = patch_shape((rectangle.width, rectangle.height), step, MARGIN)
    c, s, k = math.cos(rectangle.turn), math.sin(rectangle.turn), step / raster_step
    x0, y0 = (width - 1) / 2, (height - 1) / 2
    warp = k * np.array([[c, -s, -c * x0 + s * y0], [s, c, -s * x0 - c * y0]])
    warp[:, 2] += (rectangle.u / raster_step, rectangle.v / raster_step)
    return warp, (width, height)


def patch_shape(size: tuple[float, float], step: float, margin: float) -> tuple[int, int]:
    """Width and height of a patch's picture [pixel]."""
    width, height = (max(round((edge + 2 * margin) / step), 8) for edge in size)
    return width, height
