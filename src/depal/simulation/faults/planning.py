"""A mover that finds no way: the planner gives up, or nothing is in reach."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from depal.domain import CellLayout, Grasp
from depal.geometry import OrientedBox, Pose, Vector3
from depal.motion.collision import Scene
from depal.motion.collision.values import Array
from depal.motion.moves import SURE, Berth, Doubts, Mover, NoMotion, Part, Pick, Put
from depal.motion.planning.free import Effort
from depal.simulation.faults.catalogue import Phase
from depal.simulation.faults.chances import Chances

GAVE_UP, NO_REACH = "no free way to be found", "no reach to hold it"

AGAIN = 3
"""A planner that gives up does so for this many motions."""


@dataclass(slots=True)
class _Trouble:
    """What goes on now; movers for other limits share it.

    Attributes:
        left: so many motions more the planner gives up.
        unreached: the box that nothing reaches.
    """

    left: int = 0
    unreached: str = ""


class FaultyMover(Mover):
    """M4: no free way is found, a few times. M3: for a while nothing reaches one box."""

    def __init__(self, layout: CellLayout, chances: Chances) -> None:
        """A mover of this cell that may find no way."""
        super().__init__(layout)
        self._chances = chances
        self._trouble = _Trouble()

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
        """To a box, and straight out of the pile with it."""
        if self._out_of_reach(name):
            return NoMotion((NO_REACH,))
        if self._gives_up():
            return NoMotion((GAVE_UP,))
        return super().pick(start, box, grasps, scene, name, effort, doubts)

    def put(
        self, lead: tuple[Part, ...], start: Array, berth: Berth, scene: Scene, effort: Effort
    ) -> Put | NoMotion:
        """With a held box into a place."""
        if self._gives_up():
            return NoMotion((GAVE_UP,))
        return super().put(lead, start, berth, scene, effort)

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
        """With a held box to the first pose of the flange that can be had."""
        if self._gives_up():
            return NoMotion((GAVE_UP,))
        return super().show(lead, start, grasp, size, poses, scene, effort)

    def _gives_up(self) -> bool:
        if self._trouble.left == 0 and self._chances.strikes("M4", Phase.PLAN) is not None:
            self._trouble.left = AGAIN
        if self._trouble.left == 0:
            return False
        self._trouble.left -= 1
        return True

    def _out_of_reach(self, name: str) -> bool:
        lasting = self._chances.lasting("M3")
        if lasting is None:
            if self._chances.strikes("M3", Phase.PLAN) is None:
                return False
            self._trouble.unreached = name
        return name == self._trouble.unreached
