"""Motions in free space: the straight joint line, over drawn-in postures, or by growing trees."""

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from depal.domain import JointLimits
from depal.motion.collision import STEP, Checker
from depal.motion.collision.values import Array
from depal.motion.kinematics import Kinematics, solve_near
from depal.motion.planning.axes import Axes, span
from depal.motion.planning.escaping import escaped
from depal.motion.planning.shortcuts import pull, shorten
from depal.motion.planning.trees import grow_trees

DRAWN_IN = ((0.95, 1.25), (0.85, 1.6), (1.05, 0.95), (0.75, 1.9), (1.2, 1.5), (0.7, 1.3))
"""Where the wrist's centre is in a drawn-in posture: distance from axis 1 and height [m]."""

TRIES = 80
"""Short cuts that are tried."""

EASY = 4
"""So many goals, the nearest ones, are approached over drawn-in postures."""

COMPARED = 2
"""So many easy ways are shortened; the shorter one is taken."""

WORTH = 2.5
"""An easy way that is longer than another by this factor will not become shorter."""

LINE = 2
"""A straight joint line has as many corners."""

SAME = 1e-9
"""Corners nearer to each other than this are one [rad]."""


@dataclass(frozen=True, slots=True)
class Effort:
    """How hard a path is searched for; never by the clock, so that a seed gives the same bytes.

    Attributes:
        iterations: samples of the trees.
        seed: of the samples.
    """

    iterations: int = 12000
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
        """A path from a start to one of some goals: an easy one, or one that is searched for.

        Args:
            checker: what must not be touched; goals are free, and the start is, or nearly so.
            start: (6,) [rad].
            goals: (g, 6) [rad].
            effort: how hard to search.
            level: whether samples hold the flange as start and goals do, up to a turn about the
                vertical.

        Returns:
            The path with its short cuts; None where none was found.
        """
        easy = self.quick(checker, start, goals, effort)
        return easy or self.search(checker, start, goals, effort, level=level)

    def quick(self, checker: Checker, start: Array, goals: Array, effort: Effort) -> Found | None:
        """The shortest of the straight joint lines and the ways over drawn-in postures."""
        begin = escaped(checker, start)
        if begin is None:
            return None
        return self._with_escape(start, begin, self._easy(checker, begin, goals, effort))

    def _with_escape(self, start: Array, begin: Array, found: Found | None) -> Found | None:
        if found is None or begin is start:
            return found
        return self._found(np.vstack((start, found.path)), found.how)

    def _easy(self, checker: Checker, start: Array, goals: Array, effort: Effort) -> Found | None:
        ways = [np.stack((start, goal)) for goal in goals]
        order = sorted(range(len(goals)), key=lambda k: (self._length(ways[k]), k))
        for k in order[:EASY]:
            ways += self._over_drawn_in(start, goals[k])
        found: list[Found] = []
        for way in sorted(ways, key=self._length):
            if found and self._length(way) > WORTH * found[0].length:
                break
            if all(checker.edge_free(a, b) for a, b in itertools.pairwise(way)):
                if len(way) == LINE:
                    return self._found(way, "line")
                found.append(self._found(self._shortened(checker, way, effort), "drawn in"))
                if len(found) == COMPARED:
                    break
        return min(found, key=lambda one: one.length, default=None)

    def is_open(self, checker: Checker, q: Array) -> bool:
        """Whether the arm can draw in from a configuration at once: from there all is near."""
        return any(
            checker.free(drawn) and checker.edge_free(drawn, q) for drawn in self._all_drawn_in(q)
        )

    def search(
        self, checker: Checker, start: Array, goals: Array, effort: Effort, *, level: bool
    ) -> Found | None:
        """A path found by growing trees from the start and from all goals."""
        begin = escaped(checker, start)
        if begin is None:
            return None
        kinematics = self._kinematics
        path = grow_trees(
            checker.case,
            Axes(self._speed, kinematics.lower, kinematics.upper, STEP),
            self._levels(begin, goals) if level else np.empty((0, 3, 3)),
            begin,
            goals,
            effort.iterations,
            effort.seed,
        )
        if not len(path):
            return None
        found = self._found(self._shortened(checker, path, effort), "trees")
        return self._with_escape(start, begin, found)

    def _shortened(self, checker: Checker, path: Array, effort: Effort) -> Array:
        kinematics = self._kinematics
        axes = Axes(self._speed, kinematics.lower, kinematics.upper, STEP)
        short = shorten(checker.case, axes, path, TRIES, effort.seed)
        return _without_straights(pull(checker.case, axes, short))

    def _found(self, path: Array, how: str) -> Found:
        return Found(path, how, span(path[0], path[-1], self._speed), self._length(path))

    def _length(self, path: Array) -> float:
        """The time of a path at full speed [s]."""
        turns = np.abs(np.diff(path, axis=0)) / self._speed
        return float(turns.max(axis=1).sum())

    def _over_drawn_in(self, start: Array, goal: Array) -> Iterator[Array]:
        """Draw the arm in, turn, reach out; several postures, and one end alone drawn in."""
        ones, others = list(self._all_drawn_in(start)), list(self._all_drawn_in(goal))
        for one in ones:
            yield np.stack((start, one, goal))
            yield from (np.stack((start, one, other, goal)) for other in others)
        yield from (np.stack((start, other, goal)) for other in others)

    def _all_drawn_in(self, q: Array) -> Iterator[Array]:
        for radius, height in DRAWN_IN:
            drawn = self._drawn_in(q, radius, height)
            if drawn is not None:
                yield drawn

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
        nearest: Array = found[int(np.argmin(times.max(axis=1)))]
        return nearest

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
        if np.linalg.norm(behind) < SAME or (long > 0 and ahead @ behind > (1 - 1e-10) * long):
            continue
        kept.append(path[k])
    kept.append(path[-1])
    return np.stack(kept)
