"""Whether what is printed small on a face is what the picture shows: letters, above all.

Siblings differ in a few letters. Tape, scuffs, shadows and film change a face too, but between
the letters or smoothly, so letters are compared by their strokes, window by window, in windows
of a word, of some letters, and of one letter.
"""

from collections.abc import Sequence
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

STRENGTHS = (2, 10, 50)
"""Percentiles that are told of how strongly the print's strokes are there."""

RESTS = (50, 90, 98)
"""And of the strokes that are not the print's, as a share of its own [logarithm]."""

WEAK, MUCH = 0.4, 0.3
"""A window whose strokes are weaker shows others, where more of these are there, or none."""

WORDS = ((15, 1), (7, 1))
"""Windows of a word and of half a word are so many squares wide and high, on the first scale."""

FEWEST = 0.25
"""A window of a word is told of where so much of it bears small print."""


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
        sums, floor = _compared(seen, printed, scale)
        if scale is SCALES[0]:
            numbers += _words(sums, there)
        if not there.any():
            sums, floor = np.zeros((1, 1, 3), np.float32), np.ones((1, 1), np.float32)
            there = np.ones((1, 1), dtype=np.bool_)  # noqa: PLW2901 - as if nothing were found
        numbers += _told(sums[there], floor[there])
    return np.array(numbers)


def _told(sums: Narrow, floor: Narrow) -> list[float]:
    """Of the windows with small print what share of them, and how much, is found again."""
    found = _found(sums, floor)
    strength = sums[:, 0] / (sums[:, 2] + floor)
    rest = np.maximum(sums[:, 1] - sums[:, 0] * strength, 0.0) / (sums[:, 2] + floor)
    weak = strength < WEAK
    shares = [(found < limit).mean() for limit in LIMITS]
    shares += [(weak & (rest > MUCH)).mean(), (weak & (rest <= MUCH)).mean()]
    return [
        *np.log(np.array(shares) + FEW).tolist(),
        *percentiles(found, PERCENTILES).tolist(),
        *percentiles(strength, STRENGTHS).tolist(),
        *np.log(percentiles(rest, RESTS) + 0.02).tolist(),
    ]


def percentiles(values: Narrow, of: Sequence[float]) -> Floats:
    """Percentiles, linear between neighbours; numpy's own take much longer for so few.

    Args:
        values: (n,) at least one.
        of: which, in 0 .. 100.
    """
    ordered = np.sort(values).astype(np.float64)
    at = np.array(of) * ((len(ordered) - 1) / 100)
    low = at.astype(np.int64)
    high = np.minimum(low + 1, len(ordered) - 1)
    return np.asarray(ordered[low] + (at - low) * (ordered[high] - ordered[low]))


def _words(sums: Narrow, there: Flags) -> list[float]:
    """How well the word and the half word agree that do so worst, and the usual ones."""
    inside, numbers = sums * there[..., None], list[float]()
    for size in WORDS:
        whole = cv2.boxFilter(inside, -1, size, borderType=cv2.BORDER_CONSTANT)
        share = cv2.boxFilter(there.astype(np.float32), -1, size, borderType=cv2.BORDER_CONSTANT)
        chosen = np.asarray(whole)[there & (np.asarray(share) > FEWEST)]
        if not len(chosen):
            chosen = np.zeros((1, 3), dtype=np.float32)
        alike = chosen[:, 0] / np.sqrt(chosen[:, 1] * chosen[:, 2] + 1e-8)
        strength = chosen[:, 0] / (chosen[:, 2] + 1e-4)
        numbers += [*percentiles(alike, (0, 5, 25)).tolist(), float(strength.min())]
    return numbers


def reading_names() -> tuple[str, ...]:
    """What the numbers of a reading are."""
    told = [f"below {limit}" for limit in LIMITS] + ["others", "none"]
    told += [f"percentile {p}" for p in PERCENTILES]
    told += [f"strength {p}" for p in STRENGTHS] + [f"rest {p}" for p in RESTS]
    names = [f"{scale.around * 1000:g} mm, {name}" for scale in SCALES for name in told]
    worst = ("worst", "percentile 5", "percentile 25", "weakest")
    words = [f"{word}, {name}" for word in ("word", "half word") for name in worst]
    return (*words, *names)


def found_again(seen: Features, printed: Features, scale: Scale) -> Narrow:
    """(rows, columns) in each window 1 where the strokes are the print's, 0 where they are others.

    Args:
        seen: features of the face, brought back to the print.
        printed: features of the print with the blur that suits both.
        scale: how strokes are looked at.
    """
    return _found(*_compared(seen, printed, scale))


def _compared(seen: Features, printed: Features, scale: Scale) -> tuple[Narrow, Narrow]:
    """(rows, columns, 3) products and squares of both's strokes, and the squares of noise."""
    one, other = seen.sharpened(scale.around), printed.sharpened(scale.around)
    sums = _sums(one.values, other.values, printed.weights, scale)
    share = _share(printed.weights, sums.shape[:2], scale)
    return sums, np.float32(scale.noise * scale.cell**2) * np.maximum(share, np.float32(0.05))


def _found(sums: Narrow, floor: Narrow) -> Narrow:
    """1 where strokes are the print's, 0 where they are others; more than them is no fault."""
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
