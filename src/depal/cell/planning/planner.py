"""One motion at a time: planned with a seed of its own, counted, timed, charged."""

import asyncio
import math
from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np

from depal.cell.planning.plans import Load
from depal.cell.planning.timing import Timing
from depal.cell.timekeeping import PLANNING, Timekeeper
from depal.cell.workplace import Workplace
from depal.domain import Grasp
from depal.geometry import OrientedBox, Pose
from depal.motion.collision import Checker, Scene
from depal.motion.collision.values import Array
from depal.motion.grasping import Holding
from depal.motion.moves import (
    CLOSE,
    OPEN,
    SURE,
    Berth,
    Doubts,
    Mover,
    NoMotion,
    Part,
    Pick,
    Put,
)
from depal.motion.planning.free import Effort

T = TypeVar("T")


class Planner:
    """Plans the motions of one cell's arm.

    Attributes:
        mover: the paths.
        timing: from paths to trajectories.
        planned: how many motions were planned so far; each is charged unless the arm moves.
        spent: how long each took to compute [s of wall time], for reports.
    """

    def __init__(
        self,
        work: Workplace,
        times: Timekeeper,
        *,
        cone: bool = True,
        seed: int = 0,
        stopwatch: Callable[[], float] | None = None,
    ) -> None:
        """Nothing is planned yet.

        Args:
            work: the cell, its arm, and what planning is charged.
            times: told when planning is charged.
            cone: whether motions respect the suction's limits.
            seed: of the planner's samples.
            stopwatch: real time for reports [s]; nothing is decided by it.
        """
        self._work = work
        self._times = times
        self._seed = seed
        self._stopwatch = stopwatch or (lambda: 0.0)
        self.mover = Mover(work.layout)
        self.timing = Timing(work.layout, work.settings.speed, cone, lambda: work.bounds.speed)
        self.planned = 0
        self.spent: list[float] = []

    @property
    def here(self) -> Array:
        """(6,) where the arm stands [rad]."""
        return np.array(self._work.ports.arm.joints())

    async def charge(self, motions: int) -> None:
        """Lets the simulated time of planning pass; motions go on meanwhile."""
        if motions:
            with self._times.during(PLANNING):
                await asyncio.sleep(motions * self._work.settings.charges.plan)

    def pick(
        self,
        start: Array,
        solid: OrientedBox,
        ways: Sequence[Grasp],
        scene: Scene,
        name: str,
        doubts: Doubts = SURE,
        tilt: float = math.inf,
    ) -> Pick | NoMotion:
        """To a box and off what it stands on.

        Args:
            start: (6,) where the arm begins [rad].
            solid: the box, in the cell frame.
            ways: to hold it, best first.
            scene: all that stands around, the box included under its name.
            name: of the box in the scene.
            doubts: what is not as it looks, maybe.
            tilt: how far the box may lean once it is held [rad].
        """
        effort, mover = self._effort(self.planned + 1), self.mover.leaning(tilt)
        return self._measured(lambda: mover.pick(start, solid, ways, scene, name, effort, doubts))

    def put(self, load: Load, berth: Berth, scene: Scene) -> Put | NoMotion:
        """With a box into a place and out again."""
        hit = self._lead_hits(load, scene)
        if hit:
            return NoMotion((hit,))
        effort, mover = self._effort(self.planned), self.mover.leaning(load.rules.tilt)
        return self._measured(lambda: mover.put(load.lead, load.start, berth, scene, effort))

    def show(self, load: Load, pose: Pose, scene: Scene) -> tuple[Part, ...] | NoMotion:
        """With a box to one pose of the flange."""
        hit = self._lead_hits(load, scene)
        if hit:
            return NoMotion((hit,))
        effort, mover = self._effort(self.planned), self.mover.leaning(load.rules.tilt)
        found = self._measured(
            lambda: mover.show(load.lead, load.start, load.grasp, load.size, [pose], scene, effort)
        )
        return found if isinstance(found, NoMotion) else found[0]

    def park(self, scene: Scene, *, folded: bool) -> Part | NoMotion:
        """With an empty hand from where the arm stands to where it stands idle."""
        effort = self._effort(self.planned)
        return self._measured(lambda: self.mover.park(self.here, scene, effort, folded=folded))

    def holding(self, load: Load) -> Holding:
        """What the suction has to hold."""
        return Holding.of(load.grasp, load.mass, self._work.layout.tool, size=load.size)

    def checker(self, load: Load, scene: Scene) -> Checker:
        """The check for a hand with a box, on free ways."""
        mover = self.mover.leaning(load.rules.tilt)
        return mover.checker(scene, OPEN, load.grasp, load.size)

    def why_no_start(self, start: Array, scene: Scene) -> str:
        """Which zone an empty arm stands in, or too near to, in words; empty for none."""
        folded = self._work.ports.gripper.folded()
        hit = self.mover.checker(scene.zones, OPEN, folded=folded).why(start)
        return f"{hit}, where it stands" if hit else ""

    def _lead_hits(self, load: Load, scene: Scene) -> str:
        """Which zone the way out of the pile enters, in words: it was planned for another task."""
        if not load.lead or not load.rules.zones:
            return ""
        checker = self.mover.checker(scene.zones, CLOSE, load.grasp, load.size)
        return checker.why_along(np.concatenate([part.path for part in load.lead]))

    def _effort(self, number: int) -> Effort:
        return Effort(seed=self._seed + number)

    def _measured(self, plan: Callable[[], T]) -> T:
        self.planned += 1
        began = self._stopwatch()
        found = plan()
        self.spent.append(self._stopwatch() - began)
        return found
