"""Runs of a served cell in simulated time, over a world that outlives its controller."""

import asyncio
from dataclasses import dataclass, field
from pathlib import Path

from depal.app.serve.seeing import seen_with
from depal.app.serve.session import Session, Stage, Surroundings
from depal.cell.files import shipped_cell
from depal.domain import BoxId, CellLayout, Delivery, Request
from depal.executive.clock import LoopClock
from depal.logistics.store import LocalStore, by_storage
from depal.ports import Question
from depal.ports.wire.messages import Built
from depal.server.cell import Order, Settings
from depal.server.cellstate import QuestionState
from depal.simulation.cell import SimulatedCell, build
from depal.simulation.truth_sight import SightSettings

SHARP = SightSettings(sigma=0.001, unrecognised=0.0)


class Hands:
    """What the worker does in the world."""

    def __init__(self, cell: SimulatedCell) -> None:
        """In this cell."""
        self._cell = cell

    async def do(self, question: Question, answer: str) -> None:
        """As the simulated worker does it."""
        await self._cell.person.does(question, answer)


class WorldHere:
    """A simulated cell in this process, behind what a host sees of a world."""

    def __init__(self, cell: SimulatedCell, clock: LoopClock) -> None:
        """Around this cell."""
        self.cell, self._clock = cell, clock
        self.arm, self.gripper, self.bays = cell.arm, cell.gripper, cell.bays
        self.override = cell.arm
        self.safety, self.reader, self.cameras = cell.safety, cell.reader, cell.cameras
        self.override = cell.arm
        self.deeds, self.truth_sight = Hands(cell), cell.sight
        self.built = Built("tiny", 1)

    def witness_lifted(self, box: BoxId) -> None:
        """Which box hangs on the arm."""
        self.cell.witness.lifted(box, self._clock.now())

    async def build(
        self, layout: CellLayout, delivery: Delivery, *, seed: int, severity: str, number: int
    ) -> None:
        """It stands already."""

    async def shutdown(self) -> None:
        """It ends with the test."""

    async def close(self) -> None:
        """It lives on."""


@dataclass
class Notes:
    """What a host has written down."""

    questions: list[QuestionState] = field(default_factory=list)
    answers: list[tuple[str, str, str, float]] = field(default_factory=list)
    requests: list[tuple[str, bool, float, str]] = field(default_factory=list)
    runs: list[tuple[int, str, dict[str, object]]] = field(default_factory=list)

    def asked(self, run: int, question: QuestionState) -> None:
        """A question."""
        assert run == 1
        self.questions.append(question)

    def answered(self, question: str, choice: str, by: str, at: float) -> None:
        """Its answer."""
        self.answers.append((question, choice, by, at))

    def request_ended(self, key: str, *, served: bool, at: float, reason: str) -> None:
        """The end of a request."""
        self.requests.append((key, served, at, reason))

    def run_ended(self, run: int, state: str, at: float, result: dict[str, object]) -> None:
        """The end of a run."""
        assert at > 0.0
        self.runs.append((run, state, result))


@dataclass
class Served:
    """A run at its end."""

    cell: SimulatedCell
    session: Session
    store: LocalStore
    notes: Notes
    found: list[str]


async def served(
    delivery: Delivery, folder: Path, *cuts: float, requests: tuple[tuple[str, Request], ...] = ()
) -> Served:
    """Runs, with the controller killed after so many seconds, again and again [s]."""
    layout, clock = shipped_cell("default"), LoopClock()
    cell = build(layout, delivery, clock=clock, sight=SHARP)
    world, notes, store = WorldHere(cell, clock), Notes(), LocalStore()
    store.seed_places([delivery], by_storage(layout.places, without=layout.aside))
    order, found = Order(1, delivery, requests), []
    for patience in (*cuts, None):
        seen = await seen_with("truth", layout, delivery, world, clock, 0)
        around = Surroundings(layout, world, store, notes, clock, seen)
        session = Session(order, around, Settings(), folder, lambda: None)
        worker = asyncio.create_task(_answers(session, cell))
        run = asyncio.create_task(session.run())
        if session.stage is Stage.RECOVERED:
            found.append(str(session.found and session.found.value))
            await session.resume("somebody")
        await asyncio.wait([run], timeout=patience)
        over = run.done()
        worker.cancel()
        run.cancel()
        await asyncio.gather(worker, run, return_exceptions=True)
        await session.close()
        if over:
            break
        await asyncio.sleep(1.0)
    return Served(cell, session, store, notes, found)


async def _answers(session: Session, cell: SimulatedCell) -> None:
    """A worker who comes every five seconds and says what is so."""
    while True:
        await asyncio.sleep(5.0)
        for state in session.person.open:
            name = state.id.split("/", 1)[1].rsplit("/", 1)[0]
            question = Question(name, state.text, state.choices, state.about, state.at)
            session.person.answer(state.id, cell.person.what_is_so(question), "worker")
