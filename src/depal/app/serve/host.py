"""The cell of `depal serve`: the controller on a thread of its own, behind the protocol `Cell`."""

import asyncio
import threading
from collections.abc import Callable, Coroutine
from concurrent.futures import Future
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

from depal.app.serve.empty import empty_statement
from depal.app.serve.modes import mode_of
from depal.app.serve.outside import Connect, Records, World
from depal.app.serve.pictures import Picture
from depal.app.serve.seeing import seen_with
from depal.app.serve.session import Session, Stage, Surroundings
from depal.app.serve.statement import Moment, statement
from depal.domain import CellLayout, Request
from depal.errors import DepalError
from depal.executive.clock import Clock, LoopClock
from depal.ports import StoreSystem
from depal.ports.wire.messages import Built
from depal.server.cell import Order, Refusal, Settings, Watcher
from depal.server.cellstate import Alarm, CellState

T = TypeVar("T")

PATIENCE = 20.0
"""A command that the cell has not taken by then has failed [s of wall time]."""

FRAMES = 0.1
"""While the arm moves, a new state is told so often [s of wall time]."""

Wrote = Callable[[int, int], None]

RunLoop = Callable[[Callable[[], Coroutine[Any, Any, None]]], None]
"""Runs a coroutine function to its end on an event loop of the cell's time."""


@dataclass(frozen=True, slots=True)
class Means:
    """What a host works with.

    Attributes:
        layout: the cell.
        folder: the data folder; each run has a folder of its own below it.
        connect: finds or starts the world.
        store: makes the store's system for a run, on the cell's thread.
        records: made on the cell's thread.
        run_loop: brings the cell's time.
        perception: "camera" or "truth".
        severity: how far simulated cameras and boxes are from ideal.
        wrote: told the number of each last event of a run's journal.
    """

    layout: CellLayout
    folder: Path
    connect: Connect
    store: Callable[[int], StoreSystem]
    records: Callable[[], Records]
    run_loop: RunLoop
    perception: str = "camera"
    severity: str = "normal"
    wrote: Wrote = lambda _run, _sequence: None


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
        self._keep_world = False
        self._watchers: list[Watcher] = []
        self._state = CellState()
        self._session: Session | None = None
        self._running: asyncio.Task[None] | None = None
        self._resuming: asyncio.Task[None] | None = None
        self._trouble: Alarm | None = None
        self._picture = Picture()
        self._world: World | None = None
        self._clock: Clock = LoopClock()
        self._records: Records | None = None
        self._stale = True

    # From any thread

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

    def shut(self, *, keep_world: bool = False) -> None:
        """Ends the thread, and the world with it unless it is to live on."""
        self._keep_world = keep_world
        if self._loop is not None and self._over is not None:
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
        self._ask(lambda: self._start(order))

    def hold(self, source: str) -> None:
        """Nothing new begins."""
        self._ask(lambda: self._now(self._hold, source))

    def resume(self, source: str) -> None:
        """Goes on after a hold."""
        self._ask(lambda: self._resume(source))

    def stop_after_box(self, source: str) -> None:
        """Finishes the box in hand, then stops."""
        del source
        self._ask(lambda: self._now(self._stop_after_box))

    def add_request(self, key: str, request: Request) -> None:
        """One more request."""
        self._ask(lambda: self._now(self._add_request, key, request))

    def change_request(self, key: str, request: Request) -> None:
        """A request with another priority or due time."""
        self._ask(lambda: self._now(self._change_request, key, request))

    def cancel_request(self, key: str) -> None:
        """A request is not wanted any more."""
        self._ask(lambda: self._now(self._cancel_request, key))

    def answer(self, question: str, choice: str, source: str) -> None:
        """A person has answered a question."""
        self._ask(lambda: self._now(self._answer, question, choice, source))

    def set(self, settings: Settings) -> None:
        """Other settings."""
        self._ask(lambda: self._now(self._set, settings))

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

    def _ask(self, work: Callable[[], Coroutine[Any, Any, T]]) -> T:
        """Has the cell's thread do something, and waits for it."""
        if self._loop is None or not self._thread.is_alive():
            raise Refusal("the cell is not running")
        future = asyncio.run_coroutine_threadsafe(work(), self._loop)
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
        self._records = self._means.records()
        self._world = await self._means.connect(self._clock)
        if self._unfinished is not None:
            await self._take_up(self._world, self._unfinished)
        self._tell()
        self._ready.set_result(None)
        telling = asyncio.create_task(self._tell_on())
        await self._over.wait()
        telling.cancel()
        await self._end()

    async def _end(self) -> None:
        if self._running is not None:
            self._running.cancel()
        if self._session is not None and self._session.stage is not Stage.DONE:
            await self._session.close()
        if self._world is not None:
            await (self._world.close() if self._keep_world else self._world.shutdown())

    async def _take_up(self, world: World, order: Order) -> None:
        """Goes on with what an earlier controller began, where its world is still there."""
        if world.built == Built(order.delivery.id, order.run):
            await self._open_session(world, order)
            return
        records = self._records
        if records is not None:
            reason: dict[str, object] = {"reason": "its world ended before it did"}
            records.run_ended(order.run, "aborted", self._clock.now(), reason)
        text = f"Run {order.run} cannot be taken up: the world that it ran in has ended."
        todo = "Load the pallet anew, then press Start."
        self._trouble = Alarm("world", text, todo, self._clock.now())

    async def _start(self, order: Order | None) -> None:
        session = self._session
        if session is not None and session.stage is not Stage.DONE:
            if order is not None:
                raise Refusal(f"delivery {session.order.delivery.id} is not finished yet")
            await self._resume("start")
            return
        if order is None:
            raise Refusal("there is no delivery to start; add one to the queue")
        if self._world is None:
            raise Refusal("there is no world")
        self._trouble = None
        await self._world.build(
            self._means.layout,
            order.delivery,
            seed=order.run,
            severity=self._means.severity,
            number=order.run,
        )
        await self._open_session(self._world, order)

    async def _open_session(self, world: World, order: Order) -> None:
        means = self._means
        seen = await seen_with(
            means.perception, means.layout, order.delivery, world, self._clock, order.run
        )
        records = self._records
        if records is None:
            raise Refusal("the cell is not open")
        around = Surroundings(
            means.layout, world, means.store(order.run), records, self._clock, seen
        )
        folder = means.folder / "runs" / str(order.run)
        session = Session(order, around, self._settings, folder, self._changed)
        session.wired.notes.listen(heard=lambda last, _: means.wrote(order.run, last))
        self._session = session
        self._picture.watch(session, seen)
        self._running = asyncio.create_task(self._run(session))
        self._tell()

    async def _run(self, session: Session) -> None:
        try:
            await session.run()
            await session.close()
        except asyncio.CancelledError:
            raise
        except DepalError as error:
            text, todo = f"The run has failed: {error}", "Look at the cell, then start it anew."
            self._trouble = Alarm("run", text, todo, self._clock.now())
        self._tell()

    def _live(self) -> Session | None:
        """The run that is not over."""
        session = self._session
        return None if session is None or session.stage is Stage.DONE else session

    def _current(self) -> Session:
        session = self._live()
        if session is None:
            raise Refusal("no delivery is being worked on")
        return session

    async def _now(self, function: Callable[..., T], *args: object) -> T:
        found = function(*args)
        self._tell()
        return found

    def _hold(self, source: str) -> None:
        session = self._current()
        if session.stage is not Stage.WORKING:
            raise Refusal(f"the cell is {session.stage.value} already")
        session.hold(source)

    async def _resume(self, source: str) -> None:
        session = self._current()
        if session.stage is Stage.WORKING and not session.wired.work.gate.closed:
            raise Refusal("the cell is working")
        if session.wired.work.ports.safety.state().stopped:
            raise Refusal("a safety stop is active; it is released at the cell, not from here")
        self._trouble = None
        # A person need not wait until the arm has drawn clear: the state tells how it goes on.
        self._resuming = asyncio.create_task(self._go_on(session, source))
        await asyncio.sleep(0)
        self._tell()

    async def _go_on(self, session: Session, source: str) -> None:
        try:
            await session.resume(source)
        except DepalError as error:
            text, todo = f"The cell could not go on: {error}", "Look at the cell, then press Start."
            self._trouble = Alarm("resume", text, todo, self._clock.now())
            session.stage = Stage.HELD
        self._tell()

    def _stop_after_box(self) -> None:
        session = self._current()
        if session.stage is not Stage.WORKING:
            raise Refusal(f"the cell is {session.stage.value} already")
        session.stop_after_box()

    def _add_request(self, key: str, request: Request) -> None:
        session = self._live()
        if session is not None:
            now = replace(request, arrived=min(request.arrived, self._clock.now()))
            session.add_request(key, now)

    def _change_request(self, key: str, request: Request) -> None:
        session = self._live()
        if session is not None and not session.change_request(key, request):
            raise Refusal(f"request {key} has been served already")

    def _cancel_request(self, key: str) -> None:
        session = self._live()
        if session is not None and not session.cancel_request(key):
            raise Refusal(f"request {key} has been served already")

    def _answer(self, question: str, choice: str, source: str) -> None:
        if self._session is None:
            raise Refusal(f"there is no open question {question!r}")
        self._session.person.answer(question, choice, source)

    def _set(self, settings: Settings) -> None:
        self._settings = settings
        session = self._live()
        if session is not None:
            session.set(settings)

    # Telling

    def _changed(self) -> None:
        """A new state is told once the step that changes it is over, however much it changes."""
        if not self._stale:
            self._stale = True
            asyncio.get_running_loop().call_soon(self._tell)

    async def _tell_on(self) -> None:
        """While the arm moves the state changes all the time."""
        loop = asyncio.get_running_loop()
        while True:
            await loop.run_in_executor(None, threading.Event().wait, FRAMES)
            if self._live() is not None:
                self._tell()

    def _tell(self) -> None:
        self._stale = False
        self._state = self._stated()
        for watcher in tuple(self._watchers):
            watcher(self._state)

    def _stated(self) -> CellState:
        session, trouble = self._session, self._trouble
        alarms = (() if trouble is None else (trouble,)) + (
            () if session is None else session.alarms()
        )
        mode, reason = mode_of(session, alarms)
        if session is None:
            return empty_statement(
                self._means.layout, self._state, mode, reason, alarms, self._settings, self._clock
            )
        moment = Moment(
            mode, reason, session.order.run, session.began, session.note, alarms,
            self._picture.number,
        )  # fmt: skip
        state = statement(session.wired, moment, self._state)
        return replace(state, questions=session.person.open)
