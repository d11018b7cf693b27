"""The cell of `depal serve`: the controller on a thread of its own, behind the protocol `Cell`."""

import asyncio
import threading
from collections.abc import Callable, Coroutine
from concurrent.futures import Future
from typing import Any, TypeVar

from depal.app.serve.means import Means
from depal.app.serve.pictures import Picture
from depal.app.serve.shift import Shift
from depal.domain import CellLayout, Request
from depal.executive.clock import LoopClock
from depal.server.cell import Order, Refusal, Settings, Watcher
from depal.server.cellstate import CellState

T = TypeVar("T")

PATIENCE = 20.0
"""A command that the cell has not taken by then has failed [s of wall time]."""


class Host:
    """The cell behind the use cases; see `depal.server.cell.Cell`."""

    def __init__(
        self, means: Means, settings: Settings | None = None, unfinished: Order | None = None
    ) -> None:
        """Not started yet.

        Args:
            means: what it works with.
            settings: of the cell.
            unfinished: the run that an earlier controller left in the middle.
        """
        self._means, self._settings = means, settings or Settings()
        self._unfinished = unfinished
        self._thread = threading.Thread(target=self._work, name="cell", daemon=True)
        self._ready: Future[None] = Future()
        self._loop: asyncio.AbstractEventLoop | None = None
        self._over: asyncio.Event | None = None
        self._watchers: list[Watcher] = []
        self._state = CellState()
        self._picture = Picture()
        self._shift: Shift | None = None

    @property
    def layout(self) -> CellLayout:
        """The cell file."""
        return self._means.layout

    def open(self) -> None:
        """Starts the thread and waits until the world is there.

        Raises:
            DepalError: the world or the unfinished run cannot be taken up.
        """
        self._thread.start()
        self._ready.result()

    def shut(self) -> None:
        """Ends the thread, and the world with it."""
        if self._loop is not None and self._over is not None and self._thread.is_alive():
            self._loop.call_soon_threadsafe(self._over.set)
        self._thread.join(PATIENCE)

    def state(self) -> CellState:
        """What is so now."""
        return self._state

    def watch(self, watcher: Watcher) -> Callable[[], None]:
        """Calls a function with every new state."""
        self._watchers.append(watcher)
        return lambda: self._watchers.remove(watcher) if watcher in self._watchers else None

    def start(self, order: Order | None = None) -> None:
        """Begins with an order, or goes on."""
        self._ask(lambda shift: shift.start(order))

    def hold(self, source: str) -> None:
        """Nothing new begins."""
        self._ask(lambda shift: _now(shift, shift.hold, source))

    def resume(self, source: str) -> None:
        """Goes on after a hold."""
        self._ask(lambda shift: shift.resume(source))

    def stop_after_box(self, source: str) -> None:
        """Finishes the box in hand, then stops."""
        del source
        self._ask(lambda shift: _now(shift, shift.stop_after_box))

    def add_request(self, key: str, request: Request) -> None:
        """One more request."""
        self._ask(lambda shift: _now(shift, shift.add_request, key, request))

    def change_request(self, key: str, request: Request) -> None:
        """A request with another priority or due time."""
        self._ask(lambda shift: _now(shift, shift.change_request, key, request))

    def cancel_request(self, key: str) -> None:
        """A request is not wanted any more."""
        self._ask(lambda shift: _now(shift, shift.cancel_request, key))

    def answer(self, question: str, choice: str, source: str) -> None:
        """A person has answered a question."""
        self._ask(lambda shift: _now(shift, shift.answer, question, choice, source))

    def set(self, settings: Settings) -> None:
        """Other settings."""
        self._ask(lambda shift: _now(shift, shift.set, settings))

    def why(self, box: str) -> str:
        """Why the last selection took a box, or did not."""
        for line in self._state.queue:
            if line.box == box:
                chosen = box == self._state.target
                told = self._state.explanation if chosen else line.reason
                return f"{box}: h = {line.h:.3f}, l = {line.l:.3f}, s = {line.s:.3f}; {told}"
        raise Refusal(f"box {box!r} does not stand on the pallet")

    def picture(self) -> bytes:
        """The last camera picture with what was seen in it, as JPEG."""
        return self._picture.jpeg()

    def _ask(self, work: Callable[[Shift], Coroutine[Any, Any, T]]) -> T:
        """Has the cell's thread do something, and waits for it."""
        if self._loop is None or self._shift is None or not self._thread.is_alive():
            raise Refusal("the cell is not running")
        future = asyncio.run_coroutine_threadsafe(work(self._shift), self._loop)
        try:
            return future.result(PATIENCE)
        except TimeoutError:
            future.cancel()
            raise Refusal(f"the cell did not answer within {PATIENCE:.0f} s") from None

    # On the cell's thread

    def _work(self) -> None:
        try:
            self._means.run_loop(self._main)
        except BaseException as error:
            if not self._ready.done():
                self._ready.set_exception(error)
                return
            raise

    async def _main(self) -> None:
        self._loop, self._over = asyncio.get_running_loop(), asyncio.Event()
        clock = LoopClock()
        world = await self._means.connect(clock)
        shift = Shift(
            self._means,
            world,
            self._means.records(),
            clock,
            self._settings,
            self._picture,
            self._tell,
        )
        if self._unfinished is not None:
            await shift.take_up(self._unfinished)
        shift.tell()
        self._shift = shift
        self._ready.set_result(None)
        telling = asyncio.create_task(shift.tell_on())
        await self._over.wait()
        telling.cancel()
        await shift.end()
        await world.shutdown()

    def _tell(self, state: CellState) -> None:
        self._state = state
        for watcher in tuple(self._watchers):
            watcher(state)


async def _now(shift: Shift, function: Callable[..., T], *args: object) -> T:
    """Does something at once, and tells of it."""
    found = function(*args)
    shift.tell()
    return found
