"""One run of a served cell: wired, begun or taken up again, told about, and closed."""

import json
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, replace
from enum import Enum
from pathlib import Path

from depal.app.run.assembly import Assembly, Wiring, assemble
from depal.app.run.inputs import refuse_what_cannot_work
from depal.app.run.record import CHOICES, said
from depal.app.serve.asides import Asides
from depal.app.serve.endings import Endings
from depal.app.serve.outside import Records, World
from depal.app.serve.person import ScreenPerson
from depal.app.serve.result import result_of
from depal.app.serve.seeing import Seen
from depal.cell.ledger import Found, Ledger, page_of, restore
from depal.cell.recovery import Recovery
from depal.cell.reporting import ChoiceNote
from depal.cell.tasks import read_shipped_tasks
from depal.cell.workplace import Policy, Ports, Settings
from depal.domain import BoxId, CellLayout, Gtin, Request
from depal.errors import DepalError, DeviceError, JournalError
from depal.executive import events as ev
from depal.executive.clock import Clock
from depal.executive.journal import SqliteJournal
from depal.executive.record import open_record
from depal.executive.restart import resumed
from depal.executive.schema import Repository
from depal.ports import StoreSystem
from depal.server import cell as server
from depal.server.cellstate import QuestionState

LEDGER = "ledger.db"

TAKEN_FACT = ".taken"


class Stage(Enum):
    """How far a run is."""

    RECOVERED = "recovered"
    WORKING = "working"
    HELD = "held"
    STOPPED = "stopped"
    UNWRITTEN = "unwritten"
    DONE = "done"


@dataclass(frozen=True, slots=True)
class Surroundings:
    """What a run works with.

    Attributes:
        layout: the cell.
        world: its devices.
        store: the store's system.
        records: what is to be known after the run.
        clock: of the cell.
        seen: what it sees with.
        tasks: what the cell can do; None for the shipped tasks.
    """

    layout: CellLayout
    world: World
    store: StoreSystem
    records: Records
    clock: Clock
    seen: Seen
    tasks: Repository | None = None


class Session:
    """A run, on the cell's thread.

    Attributes:
        order: what is to be done.
        folder: of its record.
        person: who is asked.
        wired: the controller and what it works with.
        journal: of its events.
        note: on the last choice.
        stage: how far it is.
        began: when [s].
        reason: why nothing can be written; empty where it can.
    """

    def __init__(
        self,
        order: server.Order,
        around: Surroundings,
        settings: server.Settings,
        folder: Path,
        changed: Callable[[], None],
    ) -> None:
        """Wires the controller; a folder that holds a run of that number is taken up again.

        Args:
            order: what is to be done.
            around: what it is done with.
            settings: of the cell.
            folder: of this run's record.
            changed: called after everything that changes the state.

        Raises:
            InputError: this cell cannot take this delivery.
            JournalError: the record cannot be used.
        """
        self.order, self._around, self._changed = order, around, changed
        self.folder = folder
        self.note: ChoiceNote | None = None
        self.stage = Stage.WORKING
        self.began = around.clock.now()
        self.person = ScreenPerson(
            order.run, around.clock, around.world.deeds, self._asked, self._answered
        )
        findings = refuse_what_cannot_work(around.layout, order.delivery)
        impossible = {Gtin(finding.gtin): str(finding.problem) for finding in findings}
        tasks = around.tasks or read_shipped_tasks()
        self.journal: SqliteJournal = open_record(folder, tasks)
        self._ledger = Ledger(folder / LEDGER)
        old = self.journal.last > 0
        engine = resumed(tasks, self.journal) if old else None
        wiring = Wiring(
            around.layout,
            replace(order.delivery, stack=None),
            cell_settings(settings),
            tasks,
            self.journal,
            seed=order.run,
            impossible=impossible,
            engine=engine,
        )
        self.wired: Assembly = assemble(wiring, self._ports())
        self._recovery: Recovery | None = None
        self._asides = Asides(self.wired, self.person, changed)
        self._endings = Endings(around.records)
        self._unwritten: list[str] = []
        self.reason = ""
        self._bind()
        if old:
            self._take_up()
        else:
            for key, request in order.requests:
                self.wired.work.wishes.add(request, key)

    def _ports(self) -> Ports:
        around, world = self._around, self._around.world
        return Ports(
            arm=world.arm,
            gripper=world.gripper,
            reader=world.reader,
            bays=world.bays,
            safety=world.safety,
            person=self.person,
            store=around.store,
            sight=around.seen.sight,
            clock=around.clock,
            override=world.override,
        )

    def _bind(self) -> None:
        work, desk = self.wired.work, self.wired.desk
        work.keep = self.wired.controller.books.keeping(
            lambda: self._ledger.write(page_of(work, desk.promises, self._around.seen.named()))
        )
        self.wired.notes.listen(heard=self._heard, chosen=self._chosen)

    # Begin, go on, end

    def _take_up(self) -> None:
        """After a restart: what was written is restored, the sensors are read, nothing moves."""
        page = self._ledger.read()
        work, desk = self.wired.work, self.wired.desk
        restore(page, work, desk.promises)
        self._around.seen.recall(page)
        self._asides.recall(page)
        known = {wish.key for wish in work.wishes}
        for key, request in self.order.requests:
            if key not in known:
                work.wishes.add(request, key)
        self._recovery = Recovery(work, desk, page.hand)
        self.wired.controller.runtime.restart()
        self._recovery.examine()
        self.stage = Stage.RECOVERED

    @property
    def found(self) -> Found | None:
        """What a restart has found; None where there was none."""
        return None if self._recovery is None else self._recovery.found

    async def run(self) -> None:
        """To the end; after a restart it waits for `resume`."""
        if self.stage is Stage.WORKING:
            self.wired.controller.begin()
        await self.wired.controller.finish()
        await self._noted(lambda: self._settle(over=True))
        result = result_of(self.wired, self.began)
        records, at = self._around.records, self._around.clock.now()
        await self._noted(lambda: records.run_ended(self.order.run, "done", at, result))
        self.stage = Stage.DONE

    async def _noted(self, note: Callable[[], None]) -> None:
        """What must be known after the run is written, however often it takes."""
        books = self.wired.controller.books
        while True:
            try:
                note()
            except DeviceError as error:
                books.fails(JournalError(str(error)))
                await books.written()
            else:
                return

    async def resume(self, source: str) -> None:
        """A person lets it go on."""
        recovery, stage = self._recovery, self.stage
        self.stage = Stage.WORKING
        self.wired.work.gate.open()
        if stage is Stage.RECOVERED and recovery is not None:
            try:
                await recovery.go_on()
            except DepalError:
                self.stage = stage  # nothing is forgotten: the next start reconciles anew
                recovery.examine()
                raise
            self._recovery = None
            self.wired.controller.begin()
        elif stage in {Stage.HELD, Stage.STOPPED}:
            self.wired.controller.runtime.start(source)
        self._changed()

    def hold(self, source: str) -> None:
        """Nothing starts any more; what the arm does it finishes."""
        self.wired.controller.runtime.hold(source)
        self.stage = Stage.HELD
        self._changed()

    def stop_after_box(self) -> None:
        """The box in the gripper is the last one."""
        self.wired.work.gate.close()
        self._stop_if_empty()
        self._changed()

    def _stop_if_empty(self) -> None:
        work = self.wired.work
        if work.gate.closed and self.stage is Stage.WORKING and work.hand is None:
            self.wired.controller.runtime.hold("stopped after a box")
            self.stage = Stage.STOPPED

    async def lay_aside(self, reason: str) -> None:
        """Nothing can be written: it is closed as it stands, to be taken up again."""
        self.reason, self.stage = reason, Stage.UNWRITTEN
        await self.close()

    async def close(self) -> None:
        """Breaks off, as the end of the controller does; the record can be taken up again."""
        self._asides.close()
        self.wired.controller.books.close()
        await self.wired.controller.runtime.close()
        self.journal.close()
        self._ledger.close()

    # Requests and settings

    def add_request(self, key: str, request: Request) -> None:
        """Honoured at the next selection."""
        self.wired.work.wishes.add(request, key)
        self.wired.work.keep()
        self._changed()

    def change_request(self, key: str, request: Request) -> bool:
        """False where it has been served."""
        changed = self.wired.work.wishes.change(key, request)
        self.wired.work.keep()
        self._changed()
        return changed

    def cancel_request(self, key: str) -> bool:
        """False where it has been served."""
        cancelled = self.wired.work.wishes.cancel(key)
        self.wired.work.keep()
        self._changed()
        return cancelled

    def set(self, settings: server.Settings) -> None:
        """From the next selection and the next motion on."""
        work = self.wired.work
        work.settings = cell_settings(settings)
        self.wired.desk.pace(settings.speed)

    # What happens

    def _asked(self, question: QuestionState) -> None:
        with suppress(DeviceError):  # what cannot be written down is asked all the same
            self._around.records.asked(self.order.run, question)
        self._changed()

    def _answered(self, question: str, choice: str, by: str, at: float) -> None:
        with suppress(DeviceError):
            self._around.records.answered(question, choice, by, at)

    def _chosen(self, note: ChoiceNote) -> None:
        self.note = note
        line = json.dumps(asdict(note), separators=(",", ":"), default=said)
        self._unwritten.append(f"{line}\n")
        with suppress(OSError), (self.folder / CHOICES).open("a", encoding="utf-8") as file:
            file.write("".join(self._unwritten))
            self._unwritten.clear()
        self._changed()

    def _settle(self, *, over: bool = False) -> None:
        work = self.wired.work
        self._endings.settle(work.wishes, work.departures, work.now, over=over)

    def _heard(self, _: int, events: Sequence[ev.Event]) -> None:
        for event in events:
            facts = event.facts if isinstance(event, ev.Ended) else ()
            for key, value in facts:
                if key.endswith(TAKEN_FACT) and value:
                    box = BoxId(key.removesuffix(TAKEN_FACT))
                    self._around.world.witness_lifted(box)
        with suppress(DeviceError):  # the next step tries again
            self._settle()
        self._asides.ask(self.wired.work.departures.sequence)
        self._stop_if_empty()
        self._changed()


def cell_settings(settings: server.Settings) -> Settings:
    """The controller's settings for those that people set."""
    return Settings(w=settings.w, policy=Policy(settings.policy), speed=settings.speed)
