"""A world that cannot keep up is late: its time waits for it, and nobody has to catch up."""

import asyncio

from depal.executive.clock import PacedLoop
from depal.simulation.world import World


class LateWorld(World):
    """Physics on an event loop at a pace: what takes longer than it lasts puts the time off."""

    def advance(self, to: float) -> None:
        """Lets the world go on until a time [s]."""
        loop = asyncio.get_running_loop()
        if not isinstance(loop, PacedLoop):
            super().advance(to)
            return
        began, was = loop.pace.now(), self.now
        super().advance(to)
        loop.lag += max(loop.pace.now() - began - (self.now - was), 0.0)


def lag_of_this_loop() -> float:
    """How far the running loop is behind its pace [s]."""
    loop = asyncio.get_running_loop()
    return loop.lag if isinstance(loop, PacedLoop) else 0.0
