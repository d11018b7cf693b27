"""A gate in the way of work: closed, whoever comes waits."""

import asyncio


class Gate:
    """Whoever is about to begin with something waits here while it is closed."""

    def __init__(self) -> None:
        """Open."""
        self._open = asyncio.Event()
        self._open.set()
        self.waiting = 0

    @property
    def closed(self) -> bool:
        """Whether nothing further is begun."""
        return not self._open.is_set()

    def close(self) -> None:
        """Nothing further is begun."""
        self._open.clear()

    def open(self) -> None:
        """Whoever waits goes on."""
        self._open.set()

    async def passed(self, patience: float | None = None) -> None:
        """Returns once it is open, or after so long [s]."""
        self.waiting += 1
        try:
            async with asyncio.timeout(patience):
                await self._open.wait()
        except TimeoutError:
            return
        finally:
            self.waiting -= 1
