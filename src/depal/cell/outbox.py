"""What the store's system is to be told, until it has been: it may be silent for a while."""

import asyncio
from collections import deque

from depal.errors import DeviceError
from depal.ports import Movement, StoreSystem

DEADLINE = 5.0
"""Nobody waits longer for an answer [s]."""

PAUSE, LONGEST = 1.0, 60.0
"""After a silence the next try comes so much later, and twice as much after each [s]."""


class Outbox:
    """Movements in order; one that nobody answers for is told again, and counts once there."""

    def __init__(self, store: StoreSystem) -> None:
        """Nothing is to be told."""
        self._store = store
        self._waiting: deque[Movement] = deque()
        self._telling: asyncio.Task[None] | None = None

    def __len__(self) -> int:
        """How many movements wait."""
        return len(self._waiting)

    async def tell(self, movement: Movement) -> None:
        """Tells it now where that is quickly done; else behind the arm's back."""
        self._waiting.append(movement)
        if self._telling is None and not await self._told():
            self._telling = asyncio.get_running_loop().create_task(self._tell_all())

    async def emptied(self, within: float) -> bool:
        """Waits until everything is told, for so long at the most [s]; whether it is."""
        telling = self._telling
        if telling is not None:
            await asyncio.wait([telling], timeout=within)
            telling.cancel()
        return not self._waiting

    async def _tell_all(self) -> None:
        pause = PAUSE
        while self._waiting:
            if await self._told():
                pause = PAUSE
            else:
                await asyncio.sleep(pause)
                pause = min(2 * pause, LONGEST)
        self._telling = None

    async def _told(self) -> bool:
        """Tells the first; whether it was answered in time."""
        movement = self._waiting[0]
        try:
            await asyncio.wait_for(self._store.moved(movement), DEADLINE)
        except (DeviceError, TimeoutError):
            return False
        self._waiting.remove(movement)
        return True
