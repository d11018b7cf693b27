"""When the arm is where: the fastest trajectory along a path that breaks no limit."""

import itertools
from collections.abc import Sequence

import numpy as np

from depal.domain import JointLimits, Robot
from depal.errors import SettingError
from depal.motion.grasping.holding import Holding
from depal.motion.timing.blending import Clear, Smoother
from depal.motion.timing.legs import Floats, Leg, Path
from depal.motion.timing.loads import NOTHING, load_of
from depal.motion.timing.sweeping import Course, Limits, sampled, sweep
from depal.ports import Trajectory

INTERVALS = 120
"""About so many intervals a path is cut into."""

LEAST = 3
"""No piece is cut into fewer; one beside a stop, or a tight turn, into twice as many."""

TIGHT = 0.3
"""A piece is a tight turn when some axis changes its rate by this share of its speed."""

GAP = 1e-3
"""Legs whose ends are closer than this meet [rad]."""

PERIOD = 0.02
"""Samples of a trajectory lie no further apart, at full speed [s]."""


def time_path(
    legs: Sequence[Leg],
    robot: Robot,
    *,
    held: Holding | None = None,
    clear: Clear | None = None,
    speed: float = 1.0,
) -> Trajectory | None:
    """The fastest trajectory along some legs, without a stop where corners may be rounded off.

    Args:
        legs: of the motion, in order; each begins where the one before ended.
        robot: the arm.
        held: the box that must not be lost; with nothing held, or None, suction limits nothing.
        clear: checks rounded corners within free legs; they may be large then.
        speed: the share of full speed: times grow by one over it, and speeds shrink with it.

    Returns:
        The trajectory; None where the box would not be held even at rest.

    Raises:
        SettingError: a leg begins elsewhere than the one before ended.
    """
    path = smooth(legs, robot, clear)
    if path is None:
        here = np.array(legs[0].points[:1])
        return Trajectory(np.zeros(1), here, np.zeros((1, 6)))
    return time_smooth(path, legs, robot, held=held, speed=speed)


def smooth(legs: Sequence[Leg], robot: Robot, clear: Clear | None = None) -> Path | None:
    """The path through some legs, its corners rounded off; None where nothing moves.

    Raises:
        SettingError: a leg begins elsewhere than the one before ended.
    """
    for k, (before, after) in enumerate(itertools.pairwise(legs), start=1):
        gap = float(np.abs(after.points[0] - before.points[-1]).max())
        if gap > GAP:
            raise SettingError(
                f"leg {k + 1}", f"it begins {gap:.3g} rad from where the one before ends", "0 rad"
            )
    return Smoother(np.array(robot.limits.speed), _dims(robot), clear).path(legs)


def time_smooth(
    path: Path,
    legs: Sequence[Leg],
    robot: Robot,
    *,
    held: Holding | None = None,
    speed: float = 1.0,
) -> Trajectory | None:
    """The fastest trajectory along a path; see `time_path`."""
    course = _course(path, np.array(robot.limits.speed))
    limits = Limits(_dims(robot), np.array(robot.limits.speed), np.array(robot.limits.acceleration))
    holds, x = sweep(course, limits, NOTHING if held is None else load_of(held))
    if not holds:
        return None
    times, points, rates, at = sampled(course, x, PERIOD)
    grid = np.concatenate(((0.0,), np.cumsum(course.step)))
    marks = np.interp(path.marks, grid, at)
    marks[-1] = at[-1]
    return Trajectory(times / speed, points, rates * speed, _allowances(legs, marks / speed))


def bound_time(path: Floats, limits: JointLimits) -> float:
    """The time of the straight joint line from the first row to the last at full speed [s]."""
    return float((np.abs(path[-1] - path[0]) / np.array(limits.speed)).max())


def full_speed_time(path: Floats, limits: JointLimits) -> float:
    """The time of a path with corners (n, 6) at full speed, without acceleration [s]."""
    return float((np.abs(np.diff(path, axis=0)) / np.array(limits.speed)).max(axis=1).sum())


def _dims(robot: Robot) -> Floats:
    g = robot.geometry
    return np.array([g.a1, g.a2, g.b, g.c1, g.c2, g.c3, g.c4])


def _course(path: Path, speed: Floats) -> Course:
    """A path cut into intervals: evenly, but none of its pieces into too few."""
    total = float(path.lengths.sum())
    length = path.lengths[:, None]
    turn = np.abs(length * (2 * path.pieces[:, 2] + 3 * length * path.pieces[:, 3]))
    closely = path.stops[:-1] | path.stops[1:] | ((turn / speed).max(axis=1) > TIGHT)
    even = np.ceil(INTERVALS * path.lengths / total).astype(np.int64)
    counts = np.maximum(even, np.where(closely, 2 * LEAST, LEAST))
    rows = np.repeat(np.arange(len(counts), dtype=np.int64), counts)
    first = np.repeat(np.cumsum(counts) - counts, counts)
    step = (path.lengths / counts)[rows]
    rest = np.zeros(len(rows) + 1, dtype=np.bool_)
    rest[np.concatenate(((0,), np.cumsum(counts)))] = path.stops
    start = (np.arange(len(rows)) - first) * step
    return Course(path.pieces, rows, start, step, rest, path.speeds[rows])


def _allowances(legs: Sequence[Leg], marks: Floats) -> tuple[tuple[float, float], ...]:
    """When the held box may touch something, neighbouring legs as one."""
    out: list[tuple[float, float]] = []
    for k, leg in enumerate(legs):
        start, end = float(marks[k]), float(marks[k + 1])
        if not leg.touching or end <= start:
            continue
        if out and out[-1][1] == start:
            start = out.pop()[0]
        out.append((start, end))
    return tuple(out)
