"""The gate before the next box: closed, nothing further is taken off the pallet."""

import asyncio


class Gate:
    """Whoever is about to begin with a box waits here while it is closed."""

    def __init__(self) -> None:
        """Open."""
        self._open = asyncio.Event()
        self._open.set()
        self.waiting = 0

    @property
    def closed(self) -> bool:
        """Whether no further box is begun."""
        return not self._open.is_set()

    def close(self) -> None:
        """No further box is begun."""
        self._open.clear()

    def open(self) -> None:
        """Whoever waits goes on."""
        self._open.set()

    async def passed(self) -> None:
        """Returns once it is open."""
        self.waiting += 1
        try:
            await self._open.wait()
        finally:
            self.waiting -= 1
