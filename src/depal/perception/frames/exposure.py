"""Whether a picture shows anything: its brightness, its depths, and whether it is a new one."""

from collections.abc import Iterator

import numpy as np

from depal.perception.calibration.finding import grey_of
from depal.ports import Frame

EVERY = 8
"""Every so many pixels along rows and columns are looked at."""

DARK = 30
"""Nearly all of a black picture is darker (of 255)."""

CLIPPED = 250
"""A channel that is as bright or brighter tells nothing (of 255)."""

MOST_CLIPPED = 0.55
"""An overexposed picture has two such channels in a greater share of its pixels."""

FLAT = 4.0
"""The brightness of a picture of something differs by more, as a standard deviation (of 255)."""

LEAST_DEPTH = 0.05
"""The share of a depth picture that is measured where a camera works."""

OLDEST = 2.0
"""An older frame is stale [s]."""


def exposure_problems(frame: Frame) -> Iterator[str]:
    """A picture that is black, overexposed or of one colour; depths that are not there."""
    small = np.ascontiguousarray(frame.colour[::EVERY, ::EVERY])
    grey = grey_of(small)
    bright = float(np.quantile(grey, 0.95))
    clipped = float(np.mean(np.sort(small, axis=2)[..., 1] >= CLIPPED))
    if bright < DARK:
        yield (
            f"black: 95 % of the colour picture is darker than {bright:.0f} of 255, "
            f"expected {DARK} or more"
        )
    elif clipped > MOST_CLIPPED:
        yield (
            f"overexposed: {100 * clipped:.0f} % of the colour picture is white, "
            f"expected at most {100 * MOST_CLIPPED:.0f} %"
        )
    elif float(grey.std()) < FLAT:
        yield (
            f"blank: the colour picture is {grey.mean():.0f} of 255 everywhere, "
            "expected something to be seen"
        )
    measured = float(np.mean(frame.depth[::EVERY, ::EVERY] > 0.0))
    if measured < LEAST_DEPTH:
        yield (
            f"blind: {100 * measured:.1f} % of the depth picture is measured, "
            f"expected {100 * LEAST_DEPTH:.0f} % or more"
        )


def age_problems(frame: Frame, previous: Frame | None, now: float | None) -> Iterator[str]:
    """A frame that is the previous one again, or that is old."""
    if previous is not None and _same(frame, previous):
        yield (
            f"frozen: the frame of {frame.taken:.1f} s is that of {previous.taken:.1f} s byte for "
            "byte, expected other noise"
        )
    elif previous is not None and frame.taken <= previous.taken:
        yield (
            f"stale: the frame was taken at {frame.taken:.1f} s, expected later than the previous "
            f"one's {previous.taken:.1f} s"
        )
    if now is not None and now - frame.taken > OLDEST:
        yield (f"stale: the frame is {now - frame.taken:.1f} s old, expected {OLDEST:g} s or less")


def _same(one: Frame, other: Frame) -> bool:
    return bool(np.array_equal(one.colour, other.colour) and np.array_equal(one.depth, other.depth))
