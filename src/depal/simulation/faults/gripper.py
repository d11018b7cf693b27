"""A gripper whose vacuum does not come."""

import asyncio
from collections.abc import Callable

from depal.domain import Cup
from depal.ports import Gripper
from depal.simulation.faults.catalogue import Phase
from depal.simulation.faults.chances import Chances
from depal.simulation.faults.pile import FaultyPile
from depal.simulation.world import World

LEAKING = 0.25
"""So much of the vacuum comes in spite of the leak."""


class FaultyGripper:
    """G1: the vacuum does not come, once or more often. G7: a module gives none any more."""

    def __init__(
        self,
        gripper: Gripper,
        world: World,
        chances: Chances,
        pile: FaultyPile,
        grasped: Callable[[int], None],
    ) -> None:
        """A gripper of this world in which faults strike; `grasped` hears of every box."""
        self._pile = pile
        self._gripper, self._world, self._chances = gripper, world, chances
        self._grasped = grasped
        self._dead = ""

    def vacuum(self) -> dict[str, float]:
        """Of each module [Pa]."""
        return {
            name: 0.0 if name == self._dead else value
            for name, value in self._gripper.vacuum().items()
        }

    def folded(self) -> bool:
        """Whether the lower module is up."""
        return self._gripper.folded()

    async def fold(self, *, up: bool) -> None:
        """Moves the hinge."""
        await self._gripper.fold(up=up)

    async def suck(self, cups: tuple[Cup, ...]) -> bool:
        """Opens the valves; whether every module with an open valve holds its vacuum."""
        suction = self._world.suction
        under = sorted(set(suction.boxes_under(cups).tolist()) - {-1})
        box = under[0] if under else None
        if box is not None:
            self._grasped(box)
            self._pile.grasped(box)
        self._dead = self._dead_module(box)
        live = tuple(cup for cup in cups if cup[0] != self._dead)
        if not live:
            await asyncio.sleep(self._world.layout.tool.suction.rise)
            return False
        leaks = bool(under) and self._chances.lasts("G1", Phase.GRASP, box) is not None
        suction.supply = LEAKING if leaks else 1.0
        try:
            came = await self._gripper.suck(live) and len(live) == len(cups)
        finally:
            suction.supply = 1.0
        if came and suction.held_boxes:
            self._pile.sticks(suction.held_boxes[0])
        return came

    async def release(self) -> None:
        """Vents."""
        await self._gripper.release()

    def _dead_module(self, box: int | None) -> str:
        """The module that died, or dies now."""
        if self._chances.lasts("G7", Phase.GRASP, box) is None:
            return ""
        names = [module.name for module in self._world.layout.tool.modules]
        return self._dead or names[int(self._chances.dice(2).integers(len(names)))]
