"""How well a face and a print agree, as a whole and in their worst place."""

from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from depal.perception.recognition.features import Features
from depal.perception.recognition.kernels import moments

Narrow = npt.NDArray[np.float32]
Flags = npt.NDArray[np.bool_]

CELL = 2
"""Sums are taken over squares of so many pixels, then over windows of them."""

WINDOW = 0.02
"""Edge of the windows that are compared one by one: a few letters [m]."""

FAINT = 0.04
"""Variance of a window's features below which it says little."""

SEEN = 0.5
"""A window is compared where so much of it is known."""


@dataclass(frozen=True, slots=True, eq=False)
class Agreement:
    """How well two pictures agree that lie over each other.

    Attributes:
        cosine: between their features, over all that both know and whatever their means.
        differing: (rows, columns) of the window around each cell 1 minus the correlation.
        tone: (rows, columns) the largest difference of its mean features.
        known: (rows, columns) whether enough of it is known.
        seen: share of the second's contrast that lies where the first is known.
    """

    cosine: float
    differing: Narrow
    tone: Narrow
    known: Flags
    seen: float

    @property
    def worst(self) -> float:
        """In the window where they differ most: 0 is perfect."""
        return float(self.differing[self.known].max(initial=0.0))

    @property
    def worst_tone(self) -> float:
        """The largest difference of a window's means."""
        return float(self.tone[self.known].max(initial=0.0))


def agreement(seen: Features, printed: Features) -> Agreement:
    """Compares a face with a print that lies over it.

    Args:
        seen: features of the face, brought back to the print.
        printed: features of the print, as large.
    """
    height, width = printed.weights.shape
    sums = np.empty((max(height // CELL, 1), max(width // CELL, 1), 10), dtype=np.float32)
    moments(seen.values, seen.weights, printed.values, printed.weights, CELL, sums)
    total = sums.sum(axis=(0, 1), dtype=np.float64)
    cosine, mean_a, mean_b = _cosine(total)
    n = 2 * round(WINDOW / printed.step / CELL / 2) + 1
    windows = np.asarray(
        cv2.boxFilter(sums, -1, (n, n), normalize=False, borderType=cv2.BORDER_CONSTANT)
    )
    weight = windows[..., 0]
    windows = windows / np.maximum(weight, np.float32(1e-3))[..., None]
    a, b = windows[..., 1:4], windows[..., 4:7]
    own = windows[..., 7] - np.einsum("ijk,ijk->ij", a, a)
    others = windows[..., 8] - np.einsum("ijk,ijk->ij", b, b)
    both = np.sqrt(np.maximum(own * others, 0.0))
    shared = windows[..., 9] - np.einsum("ijk,ijk->ij", a, b)
    differing = 1.0 - (shared + FAINT) / (both + FAINT)
    off = np.abs(a - b - (mean_a - mean_b).astype(np.float32))
    tone = np.maximum(np.maximum(off[..., 0], off[..., 1]), off[..., 2])
    squares = np.einsum("ijk,ijk->ij", printed.values, printed.values) * printed.weights
    share = float((squares * seen.weights).sum()) / max(float(squares.sum()), 1e-9)
    return Agreement(cosine, differing, tone, weight > SEEN * (n * CELL) ** 2, share)


def cosine_of(one: Features, other: Features) -> float:
    """The cosine between two pictures' features, whatever their means."""
    height, width = one.weights.shape
    sums = np.empty((height // CELL, width // CELL, 10), dtype=np.float32)
    moments(one.values, one.weights, other.values, other.weights, CELL, sums)
    return _cosine(sums.sum(axis=(0, 1), dtype=np.float64))[0]


def _cosine(
    total: npt.NDArray[np.float64],
) -> tuple[float, npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """From the sums over all cells the cosine, and the means of both."""
    weight = max(float(total[0]), 1e-9)
    a, b = total[1:4] / weight, total[4:7] / weight
    one, other = total[7] / weight - a @ a, total[8] / weight - b @ b
    return float((total[9] / weight - a @ b) / max(one * other, 1e-12) ** 0.5), a, b
