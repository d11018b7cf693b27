"""Whole motions for the arm of one cell."""

import copy
from collections.abc import Iterable, Sequence
from typing import Self

import numpy as np

from depal.domain import CellLayout, Grasp
from depal.geometry import OrientedBox, Pose, Vector3
from depal.motion.collision import Body, Checker, Margins, Scene
from depal.motion.collision.values import Array
from depal.motion.moves.margins import OPEN, TILT
from depal.motion.moves.picking import plan_pick, why_no_pick
from depal.motion.moves.putting import Berth, plan_put, why_no_put
from depal.motion.moves.reach import Reach
from depal.motion.moves.righting import righted
from depal.motion.moves.values import SURE, Doubts, Kind, NoMotion, Part, Pick, Put
from depal.motion.planning.free import Effort


class Mover:
    """Plans whole motions; a pure function of what it is given."""

    def __init__(self, layout: CellLayout) -> None:
        """For a cell."""
        self.layout = layout
        self._reach = Reach(layout)

    def leaning(self, tilt: float) -> Self:
        """The same with held boxes that lean no further than this, and than ever [rad]."""
        least = min(tilt, TILT)
        if least == self._reach.tilt:
            return self
        other = copy.copy(self)
        other._reach = self._reach.leaning(least)  # noqa: SLF001 - it is of this class
        return other

    @property
    def body(self) -> Body:
        """The arm, ready for checks."""
        return self._reach.body

    def checker(
        self,
        scene: Scene,
        margins: Margins,
        grasp: Grasp | None = None,
        size: Vector3 | None = None,
        *,
        folded: bool = False,
    ) -> Checker:
        """The check for an empty hand, or for one that holds a box by a grasp."""
        return self._reach.checker(scene, margins, grasp, size, folded=folded)

    def is_open(self, checker: Checker, q: Array) -> bool:
        """Whether the arm can draw in from a configuration (6,) at once [rad]."""
        return self._reach.free.is_open(checker, q)

    def pick(
        self,
        start: Array,
        box: OrientedBox,
        grasps: Sequence[Grasp],
        scene: Scene,
        name: str,
        effort: Effort,
        doubts: Doubts = SURE,
    ) -> Pick | NoMotion:
        """To a box, and straight out of the pile with it.

        Args:
            start: (6,) where the arm is [rad].
            box: in the cell frame.
            grasps: ways to hold it, best first.
            scene: all that stands around, the box included under its name.
            name: of the box in the scene.
            effort: for free space.
            doubts: what is not as it looks, maybe.
        """
        return plan_pick(self._reach, start, box, grasps, scene, name, effort, doubts)

    def why_no_pick(
        self, near: Array, box: OrientedBox, grasp: Grasp, scene: Scene, name: str
    ) -> str:
        """Why a grasp is of no use, by its straight parts alone; empty where it is.

        Cheap: for the choice of a grasp that suits both the pick and the place.

        Args:
            near: (6,) where the arm will be [rad].
            box: in the cell frame.
            grasp: how it would be held.
            scene: all that stands around, the box included under its name.
            name: of the box in the scene.
        """
        return why_no_pick(self._reach, near, box, grasp, scene, name)

    def put(
        self,
        lead: tuple[Part, ...],
        start: Array,
        berth: Berth,
        scene: Scene,
        effort: Effort,
    ) -> Put | NoMotion:
        """With a held box into a place.

        Args:
            lead: parts that come before, ending at `start`: the way out of the pile.
            start: (6,) where free space begins [rad].
            berth: what is put where.
            scene: all that stands around, the held box left out.
            effort: for free space.
        """
        lead = (*lead, *righted(self._reach, start, scene, berth.grasp, berth.size))
        start = lead[-1].path[-1] if lead else start
        return plan_put(self._reach, lead, start, berth, scene, effort)

    def why_no_put(self, near: Array, berth: Berth, scene: Scene) -> str:
        """Why a spot cannot be had, by its straight parts alone; empty where it can.

        Cheap: for the choice of spots, and of grasps before a box is taken.

        Args:
            near: (6,) where the arm will be [rad].
            berth: what would be put where.
            scene: all that stands around, the held box left out.
        """
        return why_no_put(self._reach, near, berth, scene)

    def show(
        self,
        lead: tuple[Part, ...],
        start: Array,
        grasp: Grasp,
        size: Vector3,
        poses: Iterable[Pose],
        scene: Scene,
        effort: Effort,
    ) -> tuple[tuple[Part, ...], Pose] | NoMotion:
        """With a held box to the first pose of the flange that can be had.

        Args:
            lead: parts that come before, ending at `start`.
            start: (6,) where free space begins [rad].
            grasp: how the box is held.
            size: of the box [m].
            poses: of the flange, best first.
            scene: all that stands around, the held box left out.
            effort: for free space.
        """
        lead = (*lead, *righted(self._reach, start, scene, grasp, size))
        start = lead[-1].path[-1] if lead else start
        clear = self.checker(scene, OPEN, grasp, size)
        reasons: list[str] = []
        for pose in poses:
            branches = self._reach.branches(pose, start)
            if not len(branches):
                reasons.append("no reach to show it")
                continue
            hits = [clear.why(q) for q in branches]
            reasons += [hit for hit in hits if hit]
            goals = [q for q, hit in zip(branches, hits, strict=True) if not hit]
            if not goals:
                continue
            way = self._reach.free.plan(clear, start, np.stack(goals), effort, level=True)
            if way is not None:
                return (*lead, Part(Kind.FREE, way.path)), pose
            reasons.append("no free way to show it")
        return NoMotion.because(reasons)

    def park(self, start: Array, scene: Scene, effort: Effort, *, folded: bool) -> Part | NoMotion:
        """With an empty hand to where the arm stands idle."""
        goal = np.array(self.layout.robot.parked)
        empty = self.checker(scene, OPEN, folded=folded)
        if hit := empty.why(goal):
            return NoMotion((hit,))
        way = self._reach.free.plan(empty, start, goal[None, :], effort, level=False)
        return NoMotion(("no free way to park",)) if way is None else Part(Kind.FREE, way.path)
