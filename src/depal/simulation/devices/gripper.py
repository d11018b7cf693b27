"""The simulated suction gripper."""

import asyncio

from depal.domain import Cup
from depal.executive.clock import Clock
from depal.simulation.world import World


class SimulatedGripper:
    """A gripper whose cups hold boxes of the simulated world."""

    def __init__(self, world: World, clock: Clock) -> None:
        """The gripper on the arm of this world."""
        self._world, self._clock = world, clock

    def vacuum(self) -> dict[str, float]:
        """What each module's sensor reads: below the pressure around [Pa], 0 when vented."""
        self._world.advance(self._clock.now())
        return self._world.suction.vacuum(self._world.now)

    def folded(self) -> bool:
        """Whether the lower module is hinged up."""
        return self._world.suction.folded

    async def fold(self, *, up: bool) -> None:
        """Moves the hinge and waits for its end."""
        if up == self.folded():
            return
        await asyncio.sleep(self._world.layout.tool.fold_time)
        self._world.advance(self._clock.now())
        self._world.fold(up=up)

    async def suck(self, cups: tuple[Cup, ...]) -> bool:
        """Opens the valves of these cups and waits until the vacuum stands, or will not.

        Returns:
            Whether every module with an open valve holds its vacuum.
        """
        self._world.advance(self._clock.now())
        self._world.suction.open_valves(cups, self._world.now)
        await asyncio.sleep(self._world.layout.tool.suction.rise)
        self._world.advance(self._clock.now())
        self._world.wake()
        return self._world.suction.grip(self._clock.now())

    async def release(self) -> None:
        """Vents all cups and waits until the box is let go."""
        self._world.advance(self._clock.now())
        self._world.suction.vent(self._world.now)
        self._world.wake()
        await asyncio.sleep(self._world.layout.tool.suction.vent)
        self._world.advance(self._clock.now())
