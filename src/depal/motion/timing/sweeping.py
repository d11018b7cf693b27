"""The fastest speed along a path: a sweep back from its end, then one forward from its start.

With x = s'^2 and u = s'' everything that limits a motion is a row a u + b x <= c, at both ends of
every interval of a grid. Going back, the greatest x is found from which the interval can be passed
into what is allowed behind it; going forward, the greatest u is taken (reachability analysis: Pham,
Pham 2018). Rest is allowed everywhere (c > 0), so what can be reached always begins at x = 0.
"""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from depal.geometry import kernel
from depal.motion.grasping.cone import RESERVE
from depal.motion.kinematics import link_frames
from depal.motion.timing.legs import Floats, piece_at
from depal.motion.timing.loads import Load, flange_rates, wrenches

FLAT = 1e-10
"""A coefficient below this is none."""

CLOSE = 2e-6
"""Samples that follow each other faster than this are left out, for rounding's sake [s]."""

STEPS = 60
"""The greatest x of an interval is looked for in this many steps at the most."""


class Course(NamedTuple):
    """A path, cut into intervals.

    Attributes:
        pieces: (m, 4, 6) see `Path`.
        piece: (n,) of each interval.
        start: (n,) of each interval, since its piece's start [s].
        step: (n,) its length [s].
        rest: (n + 1,) whether the arm stops there.
        speed: (n,) of the flange at the most [m/s].
    """

    pieces: Floats
    piece: npt.NDArray[np.int64]
    start: Floats
    step: Floats
    rest: npt.NDArray[np.bool_]
    speed: Floats


class Limits(NamedTuple):
    """What the arm can do.

    Attributes:
        dims: (7,) of its geometry [m].
        speed: (6,) [rad/s].
        acceleration: (6,) [rad/s^2].
    """

    dims: Floats
    speed: Floats
    acceleration: Floats


@kernel
def rows_at(
    piece: Floats,
    u: float,
    most: float,
    limits: Limits,
    load: Load,
    rows: Floats,
    scratch: Floats,
    frames: Floats,
) -> float:
    """The rows a, b, c of one point, and the greatest x that the speeds allow there.

    Args:
        piece: (4, 6) of the path.
        u: since the piece's start [s].
        most: speed of the flange [m/s].
        limits: of the arm.
        load: what is held.
        rows: (12 + k, 3) receives a, b, c.
        scratch: (16, 6).
        frames: (7, 3, 4) scratch.

    Returns:
        The greatest x; negative where the box does not hold at rest.
    """
    q, q1, q2 = scratch[0], scratch[1], scratch[2]
    piece_at(piece, u, q, q1, q2)
    fastest = 1e12
    for axis in range(6):
        a, b = q1[axis] / limits.acceleration[axis], q2[axis] / limits.acceleration[axis]
        rows[2 * axis, 0], rows[2 * axis, 1], rows[2 * axis, 2] = a, b, 1.0
        rows[2 * axis + 1, 0], rows[2 * axis + 1, 1], rows[2 * axis + 1, 2] = -a, -b, 1.0
        if abs(q1[axis]) > FLAT:
            fastest = min(fastest, (limits.speed[axis] / q1[axis]) ** 2)
    held = len(load.rows)
    if most > 1e6 and held == 0:  # noqa: PLR2004 - no limit
        return fastest
    rates, work, wrench = scratch[3:7, :3], scratch[7:10, :3], scratch[10:13]
    link_frames(q, limits.dims, frames)
    flange_rates(q1, q2, frames, rates, work)
    square = rates[1, 0] ** 2 + rates[1, 1] ** 2 + rates[1, 2] ** 2
    if square > FLAT:
        fastest = min(fastest, most * most / square)
    if held:
        wrenches(load, frames, rates, wrench)
        for k in range(held):
            still, by_u, by_x = 0.0, 0.0, 0.0
            for column in range(6):
                row = load.rows[k, column]
                still += row * wrench[0, column]
                by_u += row * wrench[1, column]
                by_x += row * wrench[2, column]
            rows[12 + k, 0], rows[12 + k, 1], rows[12 + k, 2] = by_u, by_x, 1.0 - still
            if 1.0 - still < RESERVE:
                fastest = -1.0
    return fastest


@kernel
def _range_of_u(rows: Floats, x: float, ends: Floats) -> bool:
    """The rows that bound u from below and above at an x; False where one forbids this x.

    Args:
        rows: (k, 3) a, b, c.
        x: the square of the speed.
        ends: (2, 3) receives for the lower and the upper end: u, and its line p + r x.
    """
    good = True
    ends[0, 0], ends[1, 0] = -1e30, 1e30
    for k in range(len(rows)):
        a, b, c = rows[k, 0], rows[k, 1], rows[k, 2]
        left = c - b * x
        if a > FLAT:
            u = left / a
            if u < ends[1, 0]:
                ends[1, 0], ends[1, 1], ends[1, 2] = u, c / a, -b / a
        elif a < -FLAT:
            u = left / a
            if u > ends[0, 0]:
                ends[0, 0], ends[0, 1], ends[0, 2] = u, c / a, -b / a
        elif left < 0.0:
            good = False
    return good


@kernel
def _greatest_x(rows: Floats, limit: float, ends: Floats) -> float:
    """The greatest x up to a limit at which some u obeys all rows; 0 obeys them.

    The gap between the ends of u falls short of nothing at x = 0 and is concave in x: Newton's
    steps from the limit come down to its zero from above, without passing it.
    """
    x = limit
    for k in range(len(rows)):
        if abs(rows[k, 0]) <= FLAT and rows[k, 1] * x > rows[k, 2]:
            x = rows[k, 2] / rows[k, 1]
    for _ in range(STEPS):
        _range_of_u(rows, x, ends)
        if ends[0, 0] <= ends[1, 0]:
            return x
        slope = ends[0, 2] - ends[1, 2]
        lower = (ends[1, 1] - ends[0, 1]) / slope if slope > 0.0 else 0.0
        if lower >= x or lower <= 0.0:
            return max(0.0, min(x, lower)) if lower >= x * (1.0 - 1e-9) else 0.0
        x = lower
    return x * (1.0 - 1e-6)


@kernel
def sweep(course: Course, limits: Limits, load: Load) -> tuple[bool, Floats]:
    """The square of the fastest s' at every point of the grid.

    Returns:
        Whether the box holds at rest everywhere, and (n + 1,) x.
    """
    n, width = len(course.step), 12 + len(load.rows)
    rows = np.empty((n, 2 * width + 2, 3))
    most = np.full(n + 1, 1e12)
    scratch, frames, ends = np.zeros((16, 6)), np.empty((7, 3, 4)), np.empty((2, 3))
    for i in range(n):
        piece, step = course.pieces[course.piece[i]], course.step[i]
        for end in range(2):
            x = rows_at(
                piece,
                course.start[i] + end * step,
                course.speed[i],
                limits,
                load,
                rows[i, end * width : (end + 1) * width],
                scratch,
                frames,
            )
            if x < 0.0:
                return False, most
            most[i + end] = min(most[i + end], x)
        there = rows[i, width : 2 * width]
        for k in range(width):  # at the interval's end x is x + 2 step u
            there[k, 0] += 2 * step * there[k, 1]
        rows[i, 2 * width, 0], rows[i, 2 * width, 1] = 2 * step, 1.0
        low = 2 * width + 1
        rows[i, low, 0], rows[i, low, 1], rows[i, low, 2] = -2 * step, -1.0, 0.0
    for i in range(n + 1):
        if course.rest[i]:
            most[i] = 0.0
    for back in range(n):
        i = n - 1 - back
        rows[i, 2 * width, 2] = most[i + 1]
        most[i] = min(most[i], _greatest_x(rows[i], most[i], ends))
    found = np.zeros(n + 1)
    for i in range(n):
        _range_of_u(rows[i], found[i], ends)
        found[i + 1] = min(max(found[i] + 2 * course.step[i] * ends[1, 0], 0.0), most[i + 1])
    return True, found


@kernel
def sampled(course: Course, x: Floats, period: float) -> tuple[Floats, Floats, Floats, Floats]:
    """Times, configurations and rates along the path at the speeds of a sweep.

    Args:
        course: the path.
        x: (n + 1,) the square of s' at every point of the grid.
        period: samples lie no further apart [s].

    Returns:
        Times (m,) [s], configurations (m, 6) [rad], rates (m, 6) [rad/s], and the times of the
        grid's points (n + 1,) [s].
    """
    n = len(course.step)
    at = np.zeros(n + 1)
    counts = np.empty(n, np.int64)
    for i in range(n):
        span = 2 * course.step[i] / (math.sqrt(x[i]) + math.sqrt(x[i + 1]))
        at[i + 1] = at[i] + span
        counts[i] = max(1, math.ceil(span / period))
    m = counts.sum() + 1
    times, points, rates = np.zeros(m), np.empty((m, 6)), np.zeros((m, 6))
    scratch = np.empty((3, 6))
    row = 0
    for i in range(n):
        span, speed = at[i + 1] - at[i], math.sqrt(x[i])
        u = (x[i + 1] - x[i]) / (2 * course.step[i])
        for k in range(counts[i] + (1 if i == n - 1 else 0)):
            t = span * k / counts[i]
            if row > 0 and k < counts[i] and at[i] + t - times[row - 1] < CLOSE:
                continue
            s, fast = course.start[i] + t * (speed + u * t / 2), max(speed + u * t, 0.0)
            piece_at(course.pieces[course.piece[i]], s, scratch[0], scratch[1], scratch[2])
            times[row] = at[i] + t
            for axis in range(6):
                points[row, axis], rates[row, axis] = scratch[0, axis], scratch[1, axis] * fast
            row += 1
    rates[row - 1] = 0.0
    return times[:row], points[:row], rates[:row], at
