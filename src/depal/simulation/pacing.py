"""A motion gone through no faster than a speed of the tool: the override of the arm's controller.

The path stays as it was planned; only the rate r at which the time along it passes changes. The
fastest profile r(s) below the limit is found as motions are timed: backwards so that the arm can
still brake for what comes, forwards from the rate that it has now.
"""

from collections.abc import Callable

import numpy as np

from depal.domain import JointLimits
from depal.simulation.servo import WHOLE, Floats, Motion, made_of, sampled

GRID = 0.01
"""The path is looked at this often [s along it]."""

SHARE, STOP = 0.5, 1.0
"""So much of the axes' accelerations the override may ask for beside what the path asks for, and
where it brings the arm to rest."""

QUICKEST = 10.0
"""The rate changes no faster than this, also where the axes stand [1/s]."""

SPARE = 0.88
"""So much of its limit is asked for: servos overshoot by a tenth where an acceleration ends."""

Speeds = Callable[[Floats], Floats]
"""From (n, 6) configurations [rad] to (n, k, 3) points of the tool [m]."""


def paced(
    motion: Motion,
    step: int,
    period: float,
    limits: JointLimits,
    most: float,
    points: Speeds,
) -> Motion:
    """The same motion, from a step on no faster than a limit.

    Args:
        motion: that is being followed.
        step: the present one.
        period: of a step [s].
        limits: of the axes.
        most: speed of every point [m/s]; infinite for as fast as planned, 0 to stand still.
        points: where the points of the tool are.

    Returns:
        The motion from that step on; it ends before the trajectory's end where the limit is 0.
    """
    row = motion.row(step)
    start, end = float(motion.path[row]), motion.trajectory.duration
    now = float(motion.rates[row])
    if end - start < WHOLE:
        return motion
    count = max(int(np.ceil((end - start) / GRID)), 2)
    grid = np.linspace(start, end, count + 1)
    pitch = (end - start) / count
    positions, turning = sampled(motion.trajectory, grid, np.ones(count + 1))
    able = np.array(limits.acceleration) / np.maximum(np.abs(turning), 1e-9)
    change = np.minimum((SHARE if most > 0.0 else STOP) * able.min(axis=1), QUICKEST)
    wanted = _allowed(points(positions), pitch, most)
    for k in range(count - 1, -1, -1):
        wanted[k] = min(wanted[k], np.sqrt(wanted[k + 1] ** 2 + 2 * change[k] * pitch))
    rates = np.empty(count + 1)
    rates[0] = now if motion.velocities[row].any() else min(now, wanted[0])
    for k in range(count):
        gain = 2 * change[k] * pitch
        least = np.sqrt(max(rates[k] ** 2 - gain, 0.0))
        rates[k + 1] = min(max(wanted[k + 1], least), np.sqrt(rates[k] ** 2 + gain))
    path, rate = _in_time(grid, rates, change, period)
    return made_of(motion.trajectory, step, path, rate, period)


def _allowed(points: Floats, pitch: float, most: float) -> Floats:
    """(n,) the greatest rate at each place of the grid, 1 at the most."""
    ways = np.linalg.norm(np.diff(points, axis=0), axis=2).max(axis=1) / pitch
    speeds = np.maximum(np.append(ways, 0.0), np.append(0.0, ways))
    allowed: Floats = np.minimum(1.0, SPARE * most / np.maximum(speeds, 1e-9))
    return allowed


def _in_time(grid: Floats, rates: Floats, change: Floats, period: float) -> tuple[Floats, Floats]:
    """Places along the path and rates at each step from now on, to the end or to rest.

    Between two places of the grid the rate changes evenly with time.
    """
    rest = np.flatnonzero(rates[1:] <= 0.0)
    last = int(rest[0]) + 1 if len(rest) else len(grid) - 1
    spans = 2 * np.diff(grid[: last + 1]) / np.maximum(rates[:last] + rates[1 : last + 1], 1e-12)
    if len(rest):  # it comes to rest before it is there
        spans[-1] = rates[last - 1] / change[last - 1]
    times = np.concatenate(((0.0,), np.cumsum(spans)))
    steps = np.arange(int(np.ceil(times[-1] / period - 1e-9)) + 1) * period
    k = np.clip(np.searchsorted(times, steps, side="right") - 1, 0, last - 1)
    u = np.minimum(steps, times[-1]) - times[k]
    slope = (rates[k + 1] - rates[k]) / np.maximum(spans[k], 1e-12)
    path = grid[k] + rates[k] * u + slope * u**2 / 2
    rate = rates[k] + slope * u
    rate[-1] = rates[last]
    if not len(rest):
        path[-1] = grid[-1]
    return np.minimum(path, grid[-1]), rate
