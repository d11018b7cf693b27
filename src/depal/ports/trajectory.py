"""Motions as the arm takes them."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.domain.robot import Joints

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Trajectory:
    """Where the axes are to be when; cubic between samples (value and rate at both ends).

    Attributes:
        times: (n,) [s], rising from 0.
        positions: (n, 6) [rad].
        velocities: (n, 6) [rad/s]; zero at the end.
        allowances: (start, end) [s] of the straight parts near boxes, in which the held box may
            touch what it stands beside or on; anywhere else a contact is a collision.
    """

    times: Floats
    positions: Floats
    velocities: Floats
    allowances: tuple[tuple[float, float], ...] = ()

    @property
    def duration(self) -> float:
        """How long it takes [s]."""
        return float(self.times[-1])

    @property
    def start(self) -> Joints:
        """Where it begins [rad]."""
        return _joints(self.positions[0])

    @property
    def end(self) -> Joints:
        """Where it ends [rad]."""
        return _joints(self.positions[-1])

    def may_touch(self, time: float) -> bool:
        """Whether a held box may touch something at a time [s], held beyond the ends."""
        within = min(max(time, 0.0), self.duration)
        return any(first <= within <= last for first, last in self.allowances)

    def at(self, time: float) -> tuple[Floats, Floats]:
        """Position (6,) [rad] and rate (6,) [rad/s] at a time [s], held beyond the ends."""
        if time >= self.times[-1]:
            return self.positions[-1], np.zeros(6)
        if time <= 0.0:
            return self.positions[0], self.velocities[0]
        k = int(np.searchsorted(self.times, time, side="right")) - 1
        h = self.times[k + 1] - self.times[k]
        u = (time - self.times[k]) / h
        p0, p1 = self.positions[k], self.positions[k + 1]
        m0, m1 = self.velocities[k] * h, self.velocities[k + 1] * h
        position = (
            (1 + 2 * u) * (1 - u) ** 2 * p0
            + u * (1 - u) ** 2 * m0
            + u**2 * (3 - 2 * u) * p1
            + u**2 * (u - 1) * m1
        )
        rate = (6 * u * (u - 1) * (p0 - p1) + (1 - u) * (1 - 3 * u) * m0 + u * (3 * u - 2) * m1) / h
        return position, rate


def _joints(row: Floats) -> Joints:
    a, b, c, d, e, f = row.tolist()
    return (a, b, c, d, e, f)
