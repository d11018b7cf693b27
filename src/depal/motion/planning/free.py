"""Motions in free space: the straight joint line, over drawn-in postures, or by growing trees."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from depal.domain import JointLimits
from depal.motion.collision import STEP, Checker
from depal.motion.collision.values import Array
from depal.motion.kinematics import Kinematics, solve_near
from depal.motion.planning.trees import grow_trees, shorten, span

DRAWN_IN = ((0.95, 1.25), (0.85, 1.6), (1.05, 0.95), (0.75, 1.9), (1.2, 1.5))
"""Where the wrist's centre is in a drawn-in posture: distance from axis 1 and height [m]."""

TRIES = 60
"""Short cuts that are tried."""


@dataclass(frozen=True, slots=True)
class Effort:
    """How hard a path is searched for; never by the clock, so that a seed gives the same bytes.

    Attributes:
        iterations: samples of the trees.
        seed: of the samples.
    """

    iterations: int = 3000
    seed: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class Found:
    """A path through free space.

    Attributes:
        path: (n, 6) corners [rad]; straight joint lines between them.
        how: "line", "drawn in" or "trees".
        bound: the time of the straight joint line to the same end at full speed [s].
        length: the time of the path at full speed [s].
    """

    path: Array
    how: str
    bound: float
    length: float


class FreePlanner:
    """Plans for one arm."""

    def __init__(self, kinematics: Kinematics, limits: JointLimits) -> None:
        """Of an arm with its limits."""
        self._kinematics = kinematics
        self._speed = np.array(limits.speed)

    def plan(
        self, checker: Checker, start: Array, goals: Array, effort: Effort, *, level: bool
    ) -> Found | None:
        """A path from a start to the goal that is nearest along it.

        Args:
            checker: what must not be touched; start and goals are free.
            start: (6,) [rad].
            goals: (g, 6) [rad].
            effort: how hard to search.
            level: whether samples hold the flange as start and goals do, up to a turn about the
                vertical.

        Returns:
            The path with its short cuts; None where none was found.
        """
        speed = self._speed
        order = sorted(range(len(goals)), key=lambda k: (span(start, goals[k], speed), k))
        for k in order:
            if checker.edge_free(start, goals[k]):
                return self._found(np.stack((start, goals[k])), "line")
        for k in order[:4]:
            for path in self._over_drawn_in(start, goals[k]):
                if all(checker.edge_free(a, b) for a, b in zip(path[:-1], path[1:], strict=True)):
                    return self._found(self._shortened(checker, path, effort), "drawn in")
        levels = self._levels(start, goals) if level else np.empty((0, 3, 3))
        kinematics = self._kinematics
        path = grow_trees(
            checker.case,
            checker.reach,
            STEP,
            speed,
            kinematics.lower,
            kinematics.upper,
            levels,
            start,
            goals,
            effort.iterations,
            effort.seed,
        )
        if not len(path):
            return None
        return self._found(self._shortened(checker, path, effort), "trees")

    def _shortened(self, checker: Checker, path: Array, effort: Effort) -> Array:
        short = shorten(checker.case, checker.reach, STEP, self._speed, path, TRIES, effort.seed)
        return _without_straights(short)

    def _found(self, path: Array, how: str) -> Found:
        length = sum(span(a, b, self._speed) for a, b in zip(path[:-1], path[1:], strict=True))
        return Found(path, how, span(path[0], path[-1], self._speed), length)

    def _over_drawn_in(self, start: Array, goal: Array) -> Iterator[Array]:
        """Draw the arm in, turn, reach out; several postures, and one end alone drawn in."""
        for radius, height in DRAWN_IN:
            one = self._drawn_in(start, radius, height)
            other = self._drawn_in(goal, radius, height)
            if one is not None and other is not None:
                yield np.stack((start, one, other, goal))
            if one is not None:
                yield np.stack((start, one, goal))
            if other is not None:
                yield np.stack((start, other, goal))

    def _drawn_in(self, q: Array, radius: float, height: float) -> Array | None:
        """The flange as it is held at q, the wrist drawn in along the same heading of axis 1."""
        kinematics = self._kinematics
        frame = kinematics.frames(q)[6].copy()
        heading = -q[0]
        c4 = kinematics.dims[6]
        wrist = np.array([radius * math.cos(heading), radius * math.sin(heading), height])
        frame[:, 3] = wrist + c4 * frame[:, 0]
        found = solve_near(frame, q, kinematics.dims, kinematics.lower, kinematics.upper)
        if not len(found):
            return None
        times = np.abs(found - q) / self._speed
        return found[int(np.argmin(times.max(axis=1)))]

    def _levels(self, start: Array, goals: Array) -> Array:
        """The flange's orientation at the start and at the goals."""
        kept = [self._kinematics.frames(q)[6][:, :3] for q in (start, *goals[:2])]
        return np.stack(kept)


def _without_straights(path: Array) -> Array:
    """Without corners that are none."""
    kept = [path[0]]
    for k in range(1, len(path) - 1):
        ahead, behind = path[k + 1] - path[k], path[k] - kept[-1]
        long = np.linalg.norm(ahead) * np.linalg.norm(behind)
        if np.linalg.norm(behind) < 1e-9 or (long > 0 and ahead @ behind > (1 - 1e-10) * long):
            continue
        kept.append(path[k])
    kept.append(path[-1])
    return np.stack(kept)
