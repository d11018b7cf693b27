"""The arm's servos: what they follow at every step, and how they come to rest on their path."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.domain import JointLimits
from depal.ports.trajectory import Trajectory

Floats = npt.NDArray[np.float64]

WHOLE = 1e-9
"""Nearer than this to its end a motion has come to its end [s]."""

SHORTEST_STOP = 0.008
"""Coming to rest takes this long at least [s]."""


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """A trajectory as the servos take it, one row for each step of the physics.

    Attributes:
        trajectory: what it was made of.
        first: the step in which it begins.
        path: (n,) times along the trajectory [s]; they rise slower while it is slowed or stopped.
        rates: (n,) how fast these rise; 1 as planned.
        positions: (n, 6) [rad].
        velocities: (n, 6) [rad/s].
        accelerations: (n, 6) from each row to the next [rad/s^2].
    """

    trajectory: Trajectory
    first: int
    path: Floats
    rates: Floats
    positions: Floats
    velocities: Floats
    accelerations: Floats

    @property
    def whole(self) -> bool:
        """Whether it goes to the trajectory's end, not only to a rest before it."""
        return float(self.path[-1]) >= self.trajectory.duration - WHOLE

    @property
    def last(self) -> int:
        """The step in which it is at rest."""
        return self.first + len(self.path) - 1

    def row(self, step: int) -> int:
        """The row that belongs to a step; the last one after the end."""
        return min(max(step - self.first, 0), len(self.path) - 1)

    def may_touch(self, step: int) -> bool:
        """Whether a held box may touch something in this step."""
        return self.trajectory.may_touch(float(self.path[self.row(step)]))


def motion_along(trajectory: Trajectory, first: int, period: float) -> Motion:
    """The motion that follows a trajectory from the step `first` on, steps of `period` [s]."""
    count = int(np.ceil(trajectory.duration / period - 1e-9)) + 1
    path = np.minimum(np.arange(count) * period, trajectory.duration)
    return made_of(trajectory, first, path, np.ones(count), period)


def stopped(motion: Motion, step: int, period: float, limits: JointLimits) -> Motion:
    """The same motion, brought to rest along its path from a step on.

    The path's rate falls evenly; it falls as slowly as the accelerations of the axes ask for.
    """
    row = motion.row(step)
    start, rate_now = float(motion.path[row]), float(motion.rates[row])
    rates = np.abs(motion.velocities[row])
    time = max(float(np.max(rates / np.array(limits.acceleration))), SHORTEST_STOP)
    count = int(np.ceil(time / period))
    u = np.arange(1, count + 1) / count
    ahead = start + rate_now * count * period * (u - u**2 / 2)
    inside = ahead < motion.trajectory.duration
    path = np.concatenate((motion.path[: row + 1], np.minimum(ahead, motion.trajectory.duration)))
    rate = np.concatenate((motion.rates[: row + 1], np.where(inside, rate_now * (1 - u), 0.0)))
    return made_of(motion.trajectory, motion.first, path, rate, period)


def made_of(
    trajectory: Trajectory, first: int, path: Floats, rate: Floats, period: float
) -> Motion:
    """The motion along a trajectory at these times along it, one a step.

    Args:
        trajectory: what is followed.
        first: the step of the first row.
        path: (n,) times along it [s].
        rate: (n,) how fast they rise.
        period: of a step [s].
    """
    positions, velocities = sampled(trajectory, path, rate)
    accelerations = np.diff(velocities, axis=0, append=velocities[-1:]) / period
    return Motion(trajectory, first, path, rate, positions, velocities, accelerations)


def sampled(trajectory: Trajectory, path: Floats, rate: Floats) -> tuple[Floats, Floats]:
    """Positions [rad] and velocities [rad/s] at times along a trajectory, each (n, 6).

    Args:
        trajectory: cubic between its samples.
        path: (n,) times along it [s].
        rate: (n,) how fast these pass; 1 as planned.
    """
    times = trajectory.times
    if len(times) == 1:
        return np.repeat(trajectory.positions, len(path), axis=0), np.zeros((len(path), 6))
    k = np.clip(np.searchsorted(times, path, side="right") - 1, 0, len(times) - 2)
    h = (times[k + 1] - times[k])[:, None]
    u = np.clip((path[:, None] - times[k][:, None]) / h, 0.0, 1.0)
    p0, p1 = trajectory.positions[k], trajectory.positions[k + 1]
    m0, m1 = trajectory.velocities[k] * h, trajectory.velocities[k + 1] * h
    positions = (
        (1 + 2 * u) * (1 - u) ** 2 * p0
        + u * (1 - u) ** 2 * m0
        + u**2 * (3 - 2 * u) * p1
        + u**2 * (u - 1) * m1
    )
    slope = 6 * u * (u - 1) * (p0 - p1) + (1 - u) * (1 - 3 * u) * m0 + u * (3 * u - 2) * m1
    velocities = slope / h * rate[:, None]
    velocities[path >= trajectory.duration] = 0.0
    return positions, velocities
