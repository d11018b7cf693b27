"""News of the cell for everybody who looks: watched once, shown to each viewer as often as useful.

The arm moves all the time: that is shown at most ten times a second. What people act on (a
question, a mode, another box) does not wait for the next of these moments.
"""

import asyncio
from collections.abc import Awaitable, Callable

from depal.server.cell import Cell
from depal.server.cellstate import CellState

PAUSE, LEAST = 0.1, 0.02
"""Between two states for one viewer, and between two that cannot wait [s]."""

Show = Callable[[CellState], Awaitable[None]]
Sleep = Callable[[float], Awaitable[None]]


class Viewer:
    """One browser window: it is shown the newest state, never a queue of old ones."""

    def __init__(self, show: Show, sleep: Sleep, pause: float) -> None:
        """Nothing to show yet.

        Args:
            show: brings a state to the browser.
            sleep: waits so long [s].
            pause: the least time between two states [s].
        """
        self._show, self._sleep, self.pause = show, sleep, pause
        self._news: CellState | None = None
        self._come, self._pressing = asyncio.Event(), asyncio.Event()

    def tell(self, state: CellState, *, pressing: bool = False) -> None:
        """There is a newer state; on the viewer's loop.

        Args:
            state: of the cell.
            pressing: whether people may have to act on it.
        """
        self._news = state
        self._come.set()
        if pressing:
            self._pressing.set()

    async def run(self) -> None:
        """Shows what is new, until cancelled."""
        while True:
            await self._come.wait()
            self._come.clear()
            state, self._news = self._news, None
            self._pressing.clear()
            if state is not None:
                await self._show(state)
                await self._rest()

    async def _rest(self) -> None:
        """Until the pause is over, or something comes that cannot wait."""
        await self._sleep(LEAST)
        pause = asyncio.ensure_future(self._sleep(self.pause - LEAST))
        pressing = asyncio.ensure_future(self._pressing.wait())
        try:
            await asyncio.wait({pause, pressing}, return_when=asyncio.FIRST_COMPLETED)
        finally:
            pause.cancel()
            pressing.cancel()


class Hub:
    """Watches the cell once, on its thread, and tells all viewers, on theirs."""

    def __init__(self, cell: Cell, sleep: Sleep = asyncio.sleep) -> None:
        """Nobody looks yet."""
        self._cell, self._sleep = cell, sleep
        self._viewers: set[Viewer] = set()
        self._loop: asyncio.AbstractEventLoop | None = None
        self._unwatch: Callable[[], None] | None = None
        self._told: tuple[object, ...] = ()

    @property
    def viewers(self) -> int:
        """How many look."""
        return len(self._viewers)

    def add(self, show: Show, pause: float = PAUSE) -> Viewer:
        """One more viewer, on the loop that it is shown on; it is told of the present state."""
        if self._unwatch is None:
            self._loop = asyncio.get_running_loop()
            self._unwatch = self._cell.watch(self._heard)
        viewer = Viewer(show, self._sleep, pause)
        self._viewers.add(viewer)
        viewer.tell(self._cell.state())
        return viewer

    def remove(self, viewer: Viewer) -> None:
        """It looks no more; the last one ends the watching."""
        self._viewers.discard(viewer)
        if not self._viewers and self._unwatch is not None:
            self._unwatch()
            self._unwatch = None

    def _heard(self, state: CellState) -> None:
        loop = self._loop
        if loop is not None and not loop.is_closed():
            loop.call_soon_threadsafe(self._tell, state)

    def _tell(self, state: CellState) -> None:
        before, self._told = self._told, acted_on(state)
        for viewer in tuple(self._viewers):
            viewer.tell(state, pressing=self._told != before)


def acted_on(state: CellState) -> tuple[object, ...]:
    """What of a state people may have to act on: all but clocks, estimates and the arm's way."""
    requests = tuple((each.key, each.priority, each.aims) for each in state.requests)
    return (
        state.mode,
        state.reason,
        state.run,
        state.delivery,
        state.stopping,
        (state.stored, state.aside, state.lost),
        (state.held, state.target),
        (state.w, state.speed, state.policy),
        tuple((line.box, line.fate, line.requested) for line in state.queue),
        state.trolleys,
        requests,
        state.questions,
        state.alarms,
        state.picture,
    )
