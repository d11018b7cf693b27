"""Whether what is printed small on a face is what the picture shows: letters, above all.

Siblings differ in a few letters. Tape, scuffs, shadows and film change a face too, but between
the letters or smoothly, so letters are compared by their strokes, window by window, in windows
of a word, of some letters, and of one letter.
"""

from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

from depal.perception.recognition.features import Features
from depal.perception.recognition.kernels import products

Narrow = npt.NDArray[np.float32]
Floats = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Scale:
    """How strokes are looked at.

    Attributes:
        around: strokes are what differs from the mean around, a Gauss curve of this width [m].
        cell: sums are taken over squares of so many pixels.
        window: windows are so many squares wide and high.
        printed: mean square of a window's strokes from which on something small is printed there.
        noise: mean square of the strokes that noise makes.
    """

    around: float
    cell: int
    window: int
    printed: float
    noise: float


SCALES = (
    Scale(0.004, 2, 5, 0.008, 0.003),
    Scale(0.003, 2, 3, 0.0056, 0.0021),
    Scale(0.002, 1, 5, 0.0056, 0.0021),
)

INSIDE = 0.3
"""A window is compared where so much of it lies on the print."""

LIMITS = (0.2, 0.3, 0.5, 0.65, 0.8)
"""What is told of a scale: the shares of its windows that agree less than this."""

PERCENTILES = (1, 5, 20, 50)
"""And these percentiles of their agreement."""

FEW = 0.003
"""Shares are told by their logarithm, with this added."""


def small_print(sharp: Features) -> tuple[Flags, ...]:
    """On each scale the windows in which something small is printed.

    Args:
        sharp: features of a print, not blurred.
    """
    return tuple(_small(sharp, scale) for scale in SCALES)


def reading(seen: Features, printed: Features, small: tuple[Flags, ...]) -> Floats:
    """How much of the small print is found again on a face, as the numbers of `reading_names`.

    Args:
        seen: features of the face, brought back to the print.
        printed: features of the print with the blur that suits both.
        small: of the print.
    """
    numbers = list[float]()
    for scale, there in zip(SCALES, small, strict=True):
        found = found_again(seen, printed, scale)[there]
        if not found.size:
            found = np.zeros(1, dtype=np.float32)
        numbers += [float(np.log((found < limit).mean() + FEW)) for limit in LIMITS]
        numbers += np.percentile(found, PERCENTILES).tolist()
    return np.array(numbers)


def reading_names() -> tuple[str, ...]:
    """What the numbers of a reading are."""
    told = [f"below {limit}" for limit in LIMITS] + [f"percentile {p}" for p in PERCENTILES]
    return tuple(f"{scale.around * 1000:g} mm, {name}" for scale in SCALES for name in told)


def found_again(seen: Features, printed: Features, scale: Scale) -> Narrow:
    """(rows, columns) in each window 1 where the strokes are the print's, 0 where they are others.

    Args:
        seen: features of the face, brought back to the print.
        printed: features of the print with the blur that suits both.
        scale: how strokes are looked at.
    """
    one, other = seen.sharpened(scale.around), printed.sharpened(scale.around)
    sums = _sums(one.values, other.values, printed.weights, scale)
    share = _share(printed.weights, sums.shape[:2], scale)
    floor = np.float32(scale.noise * scale.cell**2) * np.maximum(share, np.float32(0.05))
    alike = sums[..., 0] / np.sqrt((sums[..., 1] + floor) * (sums[..., 2] + floor))
    there = sums[..., 0] / (sums[..., 2] + floor)
    return np.asarray(np.maximum(alike, np.minimum(there, 1.0)), dtype=np.float32)


def _small(sharp: Features, scale: Scale) -> Flags:
    strokes = sharp.sharpened(scale.around).values
    sums = _sums(strokes, strokes, sharp.weights, scale)[..., 0]
    share = _share(sharp.weights, sums.shape, scale)
    enough = scale.printed * scale.cell**2 * np.maximum(share, np.float32(1e-6))
    return np.asarray((sums > enough) & (share > INSIDE))


def _sums(one: Narrow, other: Narrow, weights: Narrow, scale: Scale) -> Narrow:
    height, width = (max(edge // scale.cell, 1) for edge in weights.shape)
    sums = np.empty((height, width, 3), dtype=np.float32)
    products(one, other, weights, scale.cell, sums)
    return _window(sums, scale)


def _share(weights: Narrow, shape: tuple[int, ...], scale: Scale) -> Narrow:
    """Of each window the share that lies on the print."""
    size = (shape[1], shape[0])
    return _window(cv2.resize(weights, size, interpolation=cv2.INTER_AREA), scale)


def _window(values: npt.NDArray[Any] | cv2.Mat, scale: Scale) -> Narrow:
    """Means over the window around each square."""
    size = (scale.window, scale.window)
    return np.asarray(cv2.boxFilter(values, -1, size, borderType=cv2.BORDER_CONSTANT), np.float32)
