"""Points of a leg: those that differ, thinned, and the cubic spline through them."""

import math

import numpy as np
import numpy.typing as npt

from depal.geometry import kernel, loop_kernel
from depal.motion.timing.legs import Floats

SAME = 1e-6
"""Points closer than this in time at full speed are one [s]."""


@loop_kernel
def _span(points: Floats, a: int, b: int, speed: Floats) -> float:
    """The time between two rows at full speed [s]."""
    most = 0.0
    for axis in range(6):
        most = max(most, abs(points[a, axis] - points[b, axis]) / speed[axis])
    return most


@loop_kernel
def distinct(
    points: Floats, speed: Floats, pitch: float, kept: npt.NDArray[np.int64], spans: Floats
) -> int:
    """Which points to keep: all that differ, thinned to a pitch, the last one always.

    Args:
        points: (n, 6) [rad].
        speed: (6,) [rad/s].
        pitch: in time at full speed [s].
        kept: (n,) receives the rows.
        spans: (n,) receives the times between them at full speed [s].

    Returns:
        How many are kept.
    """
    n, total = len(points), 0.0
    for k in range(1, n):
        total += _span(points, k - 1, k, speed)
    even = total / math.ceil(total / pitch) if pitch > 0.0 and total > 0.0 else 0.0
    kept[0] = 0
    count, gone = 1, 0.0
    for k in range(1, n):
        gone += _span(points, k - 1, k, speed)
        span = _span(points, kept[count - 1], k, speed)
        if k == n - 1 and span < SAME and count > 1:  # the end itself, instead of what is beside it
            count -= 1
            span = _span(points, kept[count - 1], k, speed)
        if span < SAME or (k < n - 1 and gone < even * count - SAME):
            continue
        kept[count], spans[count - 1] = k, span
        count += 1
    return count


@kernel
def spline_rates(at: Floats, points: Floats) -> Floats:
    """The rates of the cubic spline through three points or more, (n, 6).

    Twice continuously differentiable; at the ends its rate is that of the parabola through the
    last three points.
    """
    n = len(at)
    middle, upper, rates = np.ones(n), np.zeros(n), np.empty((n, 6))
    for axis in range(6):
        for k in range(n):
            a = k - 1 if 0 < k < n - 1 else (0 if k == 0 else n - 3)
            h, g = at[a + 1] - at[a], at[a + 2] - at[a + 1]
            before = (points[a + 1, axis] - points[a, axis]) / h
            after = (points[a + 2, axis] - points[a + 1, axis]) / g
            if k == 0:
                rates[k, axis] = before + (before - after) * h / (h + g)
                continue
            if k == n - 1:
                rates[k, axis] = after + (after - before) * g / (h + g)
                continue
            factor = g / middle[k - 1]
            upper[k] = h
            middle[k] = 2 * (h + g) - factor * upper[k - 1]
            rates[k, axis] = 3 * (g * before + h * after) - factor * rates[k - 1, axis]
        for back in range(1, n):
            k = n - 1 - back
            rates[k, axis] = (rates[k, axis] - upper[k] * rates[k + 1, axis]) / middle[k]
    return rates
