"""Whether the arm can hold a box at a pose and move it straight from there."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from depal.cell.checking.sizes import BoxSize
from depal.domain import Approach, CellLayout, Grasp
from depal.geometry import OrientedBox, Pose, Vector3
from depal.motion.collision import Body, Checker, Hand, Margins, Scene, fixed_solids, held_box
from depal.motion.collision.values import Array
from depal.motion.grasping import grasps
from depal.motion.planning.straight import straight

CLEAR = Margins(held=0.006, pile=-0.004)
"""In straight moves a held box may rub along the cases that it stands beside."""

BACK_OFF = 0.05
"""The empty tool comes along the face's normal from so far away [m]."""


@dataclass(frozen=True, slots=True)
class Task:
    """A box at one end of a straight way.

    Attributes:
        box: the box where it stands, in the cell frame.
        load: its name, size and mass.
        cases: what stands beside it.
        moves: from where it stands, one after the other: shifts in the cell frame [m].
    """

    box: OrientedBox
    load: BoxSize
    cases: tuple[OrientedBox, ...]
    moves: tuple[Vector3, ...]


class Mover:
    """The arm in an otherwise empty cell."""

    def __init__(self, layout: CellLayout) -> None:
        """Of a cell.

        Raises:
            CellError: the arm's kinematics have no closed form here.
        """
        self._layout = layout
        self._body = Body.of(layout)
        self._fixed = fixed_solids(layout)
        self._grasps: dict[tuple[BoxSize, Approach], tuple[Grasp, ...]] = {}

    def ways(self, load: BoxSize, approach: Approach) -> tuple[Grasp, ...]:
        """Every way to hold a box, best first; the side that faces -x of its frame is its front.

        Args:
            load: the box.
            approach: from the front or from above.
        """
        key = (load, approach)
        if key not in self._grasps:
            box = OrientedBox.upright((0.0, 0.0, 0.0), load.size)
            offered = grasps(box, load.mass, self._layout.tool, (-1.0, 0.0, 0.0))
            self._grasps[key] = tuple(one for one in offered if one.approach is approach)
        return self._grasps[key]

    def parked_hits(self) -> str:
        """What the parked arm touches, in words; empty where nothing."""
        scene = Scene.of(self._fixed, [])
        hand = Hand.of(self._layout.tool)
        checker = Checker(self._body, hand, scene, Margins(arm=0.0, tool=0.0, floor=0.0))
        return checker.why(np.array(self._layout.robot.parked))

    def parked_in(self) -> tuple[str, ...]:
        """The zones into which the parked arm reaches."""
        hand, bare = Hand.of(self._layout.tool), Margins(arm=0.0, tool=0.0, floor=0.0)
        parked = np.array(self._layout.robot.parked)
        nothing = Scene.of([], [])
        return tuple(
            zone.name
            for zone in self._layout.zones
            if Checker(self._body, hand, nothing.with_zones([zone]), bare).why(parked)
        )

    def can(self, task: Task, approach: Approach) -> bool:
        """Whether some grasp holds the box at the task and moves it as the task says."""
        named = [(f"case {number}", case) for number, case in enumerate(task.cases)]
        scene = Scene.of(self._fixed, named)
        return any(self._holds(task, scene, grasp) for grasp in self.ways(task.load, approach))

    def shows(self, box: OrientedBox, load: BoxSize, grasp: Grasp) -> bool:
        """Whether a held box can be brought to a pose in the empty cell."""
        scene = Scene.of(self._fixed, [])
        hand = Hand.of(self._layout.tool, folded=grasp.folded, held=held_box(grasp, load.size))
        checker = Checker(self._body, hand, scene, CLEAR)
        flange = box.pose @ grasp.box_from_flange
        return any(checker.free(q) for q in self._body.kinematics.solve(flange))

    def _holds(self, task: Task, scene: Scene, grasp: Grasp) -> bool:
        flange = task.box.pose @ grasp.box_from_flange
        joints = self._body.kinematics.solve(flange)
        if not len(joints):
            return False
        tool = self._layout.tool
        empty = Checker(self._body, Hand.of(tool, folded=grasp.folded), scene, CLEAR)
        hand = Hand.of(tool, folded=grasp.folded, held=held_box(grasp, task.load.size))
        full = Checker(self._body, hand, scene, CLEAR)
        back = _back_off(
            tool.module(grasp.cups[0][0], folded=grasp.folded).flange_from_face, flange
        )
        for start in joints:
            if not empty.free(start):
                continue
            away = straight(self._body.kinematics, start, back)
            if away is None or not empty.path_free(away):
                continue
            if self._moves(full, start, task.moves):
                return True
        return False

    def _moves(self, full: Checker, start: Array, moves: Sequence[Vector3]) -> bool:
        for number, shift in enumerate(moves):
            path = straight(self._body.kinematics, start, shift)
            # Where it stands, the box touches what it stands on.
            if path is None or not full.path_free(path[-1:] if number == 0 else path):
                return False
            start = path[-1]
        return True


def _back_off(flange_from_face: Pose, cell_from_flange: Pose) -> Vector3:
    """The shift out of the face, in the cell frame [m]."""
    rows = (cell_from_flange @ flange_from_face).rotation
    return (-BACK_OFF * rows[0][0], -BACK_OFF * rows[1][0], -BACK_OFF * rows[2][0])
