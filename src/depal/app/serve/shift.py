"""One cell at work, on its own thread: begins runs, takes them up, holds them, tells about them."""

import asyncio
import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from depal.app.serve.alarms import alarms_of
from depal.app.serve.early import Early
from depal.app.serve.empty import begun_statement, empty_statement
from depal.app.serve.means import Means
from depal.app.serve.modes import mode_of
from depal.app.serve.outside import Records, World
from depal.app.serve.pictures import Picture
from depal.app.serve.seeing import seen_with
from depal.app.serve.session import Session, Stage, Surroundings
from depal.app.serve.statement import Moment, statement
from depal.cell.safety import heard, judged
from depal.domain import Request
from depal.errors import DepalError, DeviceError, UnwrittenError
from depal.executive.clock import Clock
from depal.executive.record import JOURNAL
from depal.ports.wire.messages import Built
from depal.server.cell import Order, Refusal, Settings
from depal.server.cellstate import Alarm, CellState

OVER = (Stage.DONE, Stage.UNWRITTEN)
"""In these stages a run is closed already."""

FRAMES = 0.1
"""While the arm moves, a new state is told so often [s of wall time]."""

Told = Callable[[CellState], None]


class Shift:
    """What the host's commands are carried out by; used on the cell's thread alone."""

    def __init__(
        self,
        means: Means,
        world: World,
        records: Records,
        clock: Clock,
        settings: Settings,
        picture: Picture,
        told: Told,
    ) -> None:
        """Nothing is begun.

        Args:
            means: what the cell works with.
            world: its devices.
            records: what is to be known afterwards.
            clock: of the cell.
            settings: of the cell.
            picture: shows what was seen.
            told: called with every new state.
        """
        self._means, self._world, self._records, self._clock = means, world, records, clock
        self._settings, self._picture, self._told = settings, picture, told
        self._state = CellState()
        self._session: Session | None = None
        self._running: asyncio.Task[None] | None = None
        self._resuming: asyncio.Task[None] | None = None
        self._beginning: asyncio.Task[None] | None = None
        self._begun: Order | None = None
        self._early = Early()
        self._trouble: Alarm | None = None
        self._stale = True

    # Runs

    async def end(self) -> None:
        """Breaks off, as the end of the controller does; the world is somebody else's."""
        for task in (self._beginning, self._resuming, self._running):
            if task is not None:
                task.cancel()
        if self._session is not None and self._session.stage not in OVER:
            await self._session.close()

    async def take_up(self, order: Order) -> None:
        """Goes on with what an earlier controller began, where its world is still there."""
        begun = (self._folder(order) / JOURNAL).is_file()
        if begun and self._world.built == Built(order.delivery.id, order.run):
            await self._open_session(order)
            return
        reason = "its world ended before it did" if begun else "the cell ended before it began"
        state = "aborted" if begun else "failed"
        self._records.run_ended(order.run, state, self._clock.now(), {"reason": reason})
        text = f"Run {order.run} cannot be taken up: {reason}."
        todo = "Load the pallet anew, then press Start."
        self._trouble = Alarm("world", text, todo, self._clock.now())

    async def start(self, order: Order | None) -> None:
        """Begins with an order, or goes on."""
        session = self._live()
        if session is not None:
            if order is not None:
                raise Refusal(f"delivery {session.order.delivery.id} is not finished yet")
            await self.resume("start")
            return
        if order is None:
            raise Refusal("there is no delivery to start; add one to the queue")
        if self._begun is not None:
            raise Refusal(f"delivery {self._begun.delivery.id} is being started")
        self._trouble, self._begun, self._session = None, order, None
        self._early = Early(order.requests)
        # The first pictures take a while, and a machine's first ones longer: nobody waits for them.
        self._beginning = asyncio.create_task(self._begin(order))
        self.tell()

    async def _begin(self, order: Order) -> None:
        means = self._means
        try:
            await self._world.build(
                means.layout,
                order.delivery,
                seed=order.run,
                severity=means.severity,
                number=order.run,
            )
            self._refuse_blind_start()
            await self._open_session(order)
        except DepalError as error:
            text = f"Delivery {order.delivery.id} could not be started: {error}"
            todo = "See to it, then press Start."
            self._trouble = Alarm("start", text, todo, self._clock.now())
            reason: dict[str, object] = {"reason": str(error)}
            self._records.run_ended(order.run, "failed", self._clock.now(), reason)
        finally:
            self._begun = None
            self.tell()

    def _refuse_blind_start(self) -> None:
        """Never a start without the safety inputs.

        Raises:
            DeviceError: they are silent, a stop is active, or somebody is before the arm.
        """
        inputs = judged(heard(self._world.safety), self._clock.now())
        if not inputs.may_move:
            raise DeviceError(inputs.reason)

    def _folder(self, order: Order) -> Path:
        return self._means.folder / "runs" / str(order.run)

    async def _open_session(self, order: Order) -> None:
        means, world = self._means, self._world
        seen = await seen_with(
            means.perception, means.layout, order.delivery, world, self._clock, order.run
        )
        around = Surroundings(
            means.layout,
            world,
            means.store(order.run),
            self._records,
            self._clock,
            seen,
            means.tasks,
        )
        wanted = replace(order, requests=self._early.requests) if self._begun else order
        session = Session(wanted, around, self._settings, self._folder(order), self._changed)
        session.wired.notes.listen(heard=lambda last, _: means.wrote(order.run, last))
        self._session = session
        self._picture.watch(session, seen)
        self._running = asyncio.create_task(self._run(session))
        self.tell()

    async def _run(self, session: Session) -> None:
        try:
            await session.run()
            await session.close()
        except UnwrittenError as error:
            await session.lay_aside(str(error))
        except Exception as error:  # noqa: BLE001 - whatever it is, nobody waits for ever
            await self._give_up(session, error)
        self.tell()

    async def _give_up(self, session: Session, error: Exception) -> None:
        """A run that cannot go on is over: its delivery waits again."""
        with suppress(DepalError):
            await session.close()
        self._session = None
        text = f"Run {session.order.run} has failed: {error}"
        todo = "Look at the cell, load the pallet anew, then press Start."
        self._trouble = Alarm("run", text, todo, self._clock.now())
        reason: dict[str, object] = {"reason": str(error)}
        self._records.run_ended(session.order.run, "aborted", self._clock.now(), reason)

    def _live(self) -> Session | None:
        """The run that is not over."""
        session = self._session
        return None if session is None or session.stage is Stage.DONE else session

    def _current(self) -> Session:
        session = self._live()
        if session is None:
            raise Refusal("no delivery is being worked on")
        return session

    def hold(self, source: str) -> None:
        """Nothing new begins."""
        session = self._current()
        if session.stage is not Stage.WORKING:
            raise Refusal(f"the cell is {session.stage.value} already")
        session.hold(source)

    async def resume(self, source: str) -> None:
        """Goes on after a hold, a stop or a restart."""
        session = self._current()
        if session.stage is Stage.WORKING and not session.wired.work.gate.closed:
            raise Refusal("the cell is working")
        inputs = session.wired.controller.safety.read()
        if not inputs.may_move:
            raise Refusal(f"{inputs.reason}; that is seen to at the cell, not from here")
        self._trouble = None
        if session.stage is Stage.UNWRITTEN:
            await self._open_session(session.order)  # from what was written, as after a restart
            session = self._current()
        # A person need not wait until the arm has drawn clear: the state tells how it goes on.
        self._resuming = asyncio.create_task(self._go_on(session, source))
        await asyncio.sleep(0)
        self.tell()

    async def _go_on(self, session: Session, source: str) -> None:
        try:
            await session.resume(source)
        except DepalError as error:
            text, todo = f"The cell could not go on: {error}", "Look at the cell, then press Start."
            self._trouble = Alarm("resume", text, todo, self._clock.now())
        self.tell()

    def stop_after_box(self) -> None:
        """Finishes the box in hand, then stops."""
        session = self._current()
        if session.stage is not Stage.WORKING:
            raise Refusal(f"the cell is {session.stage.value} already")
        session.stop_after_box()

    def add_request(self, key: str, request: Request) -> None:
        """One more request; for a run that is being started it waits until that begins."""
        session = self._live()
        now = replace(request, arrived=min(request.arrived, self._clock.now()))
        if session is not None:
            session.add_request(key, now)
        else:
            self._early.put(key, now)

    def change_request(self, key: str, request: Request) -> None:
        """A request with another priority or due time."""
        session = self._live()
        if session is None:
            self._early.put(key, request)
        if session is not None and not session.change_request(key, request):
            raise Refusal(f"request {key} has been served already")

    def cancel_request(self, key: str) -> None:
        """A request is not wanted any more."""
        session = self._live()
        if session is None:
            self._early.drop(key)
        if session is not None and not session.cancel_request(key):
            raise Refusal(f"request {key} has been served already")

    def answer(self, question: str, choice: str, source: str) -> None:
        """A person has answered a question."""
        if self._session is None:
            raise Refusal(f"there is no open question {question!r}")
        self._session.person.answer(question, choice, source)

    def set(self, settings: Settings) -> None:
        """Other settings."""
        self._settings = settings
        session = self._live()
        if session is not None:
            session.set(settings)

    # Telling

    def _changed(self) -> None:
        """A new state is told once the step that changes it is over, however much it changes."""
        if not self._stale:
            self._stale = True
            asyncio.get_running_loop().call_soon(self.tell)

    async def tell_on(self) -> None:
        """While the arm moves the state changes all the time."""
        loop = asyncio.get_running_loop()
        while True:
            await loop.run_in_executor(None, threading.Event().wait, FRAMES)
            if self._live() is not None:
                self.tell()

    def tell(self) -> None:
        """A new state."""
        self._stale = False
        self._state = self._stated()
        self._told(self._state)

    def _stated(self) -> CellState:
        session, trouble = self._session, self._trouble
        alarms = (() if trouble is None else (trouble,)) + (
            () if session is None else alarms_of(session, self._clock.now())
        )
        mode, reason = mode_of(session, alarms)
        if session is None:
            empty = empty_statement(
                self._means.layout, self._state, mode, reason, alarms, self._settings, self._clock
            )
            return empty if self._begun is None else begun_statement(empty, self._begun)
        moment = Moment(
            mode, reason, session.order.run, session.began, session.note, alarms,
            self._picture.number,
        )  # fmt: skip
        state = statement(session.wired, moment, self._state)
        return replace(state, questions=session.person.open)
