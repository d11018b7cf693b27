"""Where on a raster prints appear, coarsely: correlation of every print with all of it."""

from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt
from scipy import fft

from depal.perception.faces import Facing
from depal.perception.recognition.features import Features
from depal.perception.recognition.prints import Gallery, Print

Narrow = npt.NDArray[np.float32]

LOWEST = 0.3
"""Cosine of a peak, at least."""

APART = 5
"""A peak is the highest within a square of so many pixels."""

KNOWN = 0.55
"""Share of a place's pixels that must be known."""

HALF = 0.5
"""Rows and columns of a print count where they lie on it by so much."""

FAINT = 0.004
"""Mean square of a place's features below which nothing is printed there."""


@dataclass(frozen=True, slots=True, eq=False)
class Peak:
    """A place where a print may be.

    Attributes:
        score: the cosine between print and raster.
        printed: which print.
        quarter: its quarter turns.
        row: of its middle [pixel].
        column: of its middle [pixel].
    """

    score: float
    printed: Print
    quarter: int
    row: float
    column: float


def peaks(raster: Features, facing: Facing, gallery: Gallery) -> list[Peak]:
    """Places where prints may be, the most similar first.

    Args:
        raster: coarse features of a raster, all compared with what is around.
        facing: what the raster shows.
        gallery: what may come.
    """
    height, width = raster.weights.shape
    shape = (fft.next_fast_len(height, real=True), fft.next_fast_len(width, real=True))
    planes = np.moveaxis(raster.values * raster.weights[..., None], 2, 0)
    spectrum = fft.rfft2(planes, shape)
    squares = np.asarray(cv2.integral((planes * planes).sum(axis=0)), dtype=np.float64)
    counts = np.asarray(cv2.integral(raster.weights), dtype=np.float64)
    found = list[Peak]()
    for printed in gallery.prints:
        if printed.facing is not facing:
            continue
        for quarter in range(4) if facing is Facing.TOP else range(1):
            part = printed.outline.turned(quarter)
            rows, columns = part.weights.shape
            if rows > height or columns > width:
                continue
            pattern = np.moveaxis(part.values * part.weights[..., None], 2, 0)
            other = fft.rfft2(pattern, shape)
            product = fft.irfft2((spectrum * other.conj()).sum(axis=0), shape)
            inside = product[: height - rows + 1, : width - columns + 1]
            energy = _sums(squares, part.weights)
            share = _sums(counts, part.weights) / max(float(part.weights.sum()), 1e-6)
            own = float((pattern * pattern).sum())
            floor = FAINT * float(part.weights.sum())
            cosine = inside / np.sqrt(np.maximum(energy, floor) * max(own, floor) + 1e-9)
            cosine[share < KNOWN] = 0.0
            found += _highest(cosine.astype(np.float32), printed, quarter, (rows, columns))
    found.sort(key=lambda peak: -peak.score)
    return found


def _sums(integral: npt.NDArray[np.float64], weights: Narrow) -> npt.NDArray[np.float64]:
    """Sums under a window of these weights at every place: over its frame, less its blank part."""
    window = (weights.shape[0], weights.shape[1])
    frame = _around(weights > HALF)
    total = _box(integral, frame, window)
    top, left, bottom, right = frame
    # At a corner of the frame both its row and its column count by half or more.
    blank = weights[top:bottom, left:right] < HALF * HALF
    if blank.any():
        a, b, c, d = _around(blank)
        total = total - _box(integral, (top + a, left + b, top + c, left + d), window)
    return np.maximum(total, 0.0)


def _around(flags: npt.NDArray[np.bool_]) -> tuple[int, int, int, int]:
    """First row, first column, and the ends of rows and columns that hold any flag."""
    rows, columns = (np.flatnonzero(flags.any(axis=axis)) for axis in (1, 0))
    return int(rows[0]), int(columns[0]), int(rows[-1]) + 1, int(columns[-1]) + 1


def _box(
    integral: npt.NDArray[np.float64], box: tuple[int, int, int, int], window: tuple[int, int]
) -> npt.NDArray[np.float64]:
    """Sums over a part of a window, at every place of the window."""
    top, left, bottom, right = box
    down, across = integral.shape[0] - window[0], integral.shape[1] - window[1]
    a = integral[bottom : bottom + down, right : right + across]
    b = integral[top : top + down, right : right + across]
    c = integral[bottom : bottom + down, left : left + across]
    d = integral[top : top + down, left : left + across]
    return np.asarray(a - b - c + d)


def _highest(cosine: Narrow, printed: Print, quarter: int, window: tuple[int, int]) -> list[Peak]:
    """The peaks of one print's cosines."""
    square = np.ones((APART, APART), dtype=np.uint8)
    top = (cosine >= cv2.dilate(cosine, square)) & (cosine > LOWEST)
    middle = ((window[0] - 1) / 2, (window[1] - 1) / 2)
    return [
        Peak(float(cosine[i, j]), printed, quarter, i + middle[0], j + middle[1])
        for i, j in np.argwhere(top).tolist()
    ]
