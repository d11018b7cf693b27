"""A run in a light world: the real controller, started anew after each cut."""

import asyncio
import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from depal.app.light.cuts import Cut, Disk, Kind, Writes
from depal.app.light.desk import light_desk
from depal.app.light.naive import BlindArm, NaiveRecovery, believed
from depal.app.light.referee import Count, Referee
from depal.app.run.assembly import Assembly, Wiring, assemble
from depal.cell.ledger import page_of, restore
from depal.cell.recovery import Recovery
from depal.cell.workplace import Ports, Settings
from depal.domain import CellLayout, Delivery, Request, StorageKind
from depal.errors import DepalError
from depal.executive.clock import LoopClock, run_simulated
from depal.executive.restart import resumed
from depal.executive.schema import Repository
from depal.logistics.store import assign_places, by_storage
from depal.simulation.light import (
    NO_FAULTS,
    EndedError,
    Life,
    LightCell,
    Rates,
    build_light,
    light_delivery,
)

HORIZON = 100_000.0
"""A run that has not ended by then never will [s]."""

PLACES = 4
"""The store names so many places for a product."""

COMES = (2.0, 20.0)
"""After a restart a person says start, so much later [s]."""

TRIES = 5
"""So often a person says start to a controller that cannot go on."""

WANTED = 2
"""Products of each delivery that somebody waits for."""


@dataclass(frozen=True, slots=True)
class LightJob:
    """What is to be run.

    Attributes:
        boxes: on the pallet.
        seed: of the delivery, the faults, and everything else.
        rates: of the faults.
        cuts: one for each controller but the last.
        naive: whether a controller that is started anew runs again what has no end (the control).
    """

    boxes: int
    seed: int
    rates: Rates = NO_FAULTS
    cuts: tuple[Cut, ...] = ()
    naive: bool = False


@dataclass(frozen=True, slots=True)
class LightOutcome:
    """What became of it.

    Attributes:
        job: what was run.
        count: of the boxes, by the referee.
        wrongs: breaches of invariants, in words.
        asked: ids of the questions to people, trolleys left out.
        struck: how often each fault has, by its rate's name.
        exchanges: of trolleys.
        found: what each restart has found.
        cuts: how many controllers ended before their time.
        writes: of the first controller, by kind.
        sim_seconds: the time that it took.
        events: of all controllers together.
        sha256: of their journal.
    """

    job: LightJob
    count: Count
    wrongs: tuple[str, ...] = ()
    asked: tuple[str, ...] = ()
    struck: dict[str, int] = field(default_factory=dict)
    exchanges: int = 0
    found: tuple[str, ...] = ()
    cuts: int = 0
    writes: dict[Kind, int] = field(default_factory=dict)
    sim_seconds: float = 0.0
    events: int = 0
    sha256: str = ""


def run_light(job: LightJob, layout: CellLayout, tasks: Repository) -> LightOutcome:
    """Runs in simulated time; the same job gives the same journal to the byte."""
    return run_simulated(_Run(job, layout, tasks).outcome())


class _Run:
    """A world, and one controller after the other."""

    def __init__(self, job: LightJob, layout: CellLayout, tasks: Repository) -> None:
        self._job, self._layout, self._tasks = job, layout, tasks
        self._delivery = light_delivery(job.boxes, job.seed)
        self._told = replace(self._delivery, stack=None)
        self._disk = Disk()
        self._found: list[str] = []
        self._writes: dict[Kind, int] = {}
        self._cuts = 0
        self._random = np.random.default_rng([job.seed, 25])

    async def outcome(self) -> LightOutcome:
        asyncio.get_running_loop().set_exception_handler(_complain)
        cell, job = _cell_of(job=self._job, layout=self._layout, delivery=self._delivery), self._job
        referee = Referee(cell)
        try:
            async with asyncio.timeout(HORIZON):
                for cut in (*job.cuts, None):
                    if await self._life(cell, referee, cut):
                        break
        except TimeoutError:
            referee.no_end("the run has not ended")
        count = referee.count()
        asked = [question for _, question, _ in cell.deeds.asked]
        trolleys = {s.id for s in self._layout.storages if s.kind is StorageKind.TROLLEY}
        return LightOutcome(
            job,
            count,
            tuple(referee.wrongs),
            tuple(question.id for question in asked if question.about not in trolleys),
            dict(cell.struck),
            sum(question.about in trolleys for question in asked),
            tuple(self._found),
            self._cuts,
            self._writes,
            cell.clock.now(),
            self._disk.journal.last,
            _sha256(self._disk),
        )

    async def _life(self, cell: LightCell, referee: Referee, cut: Cut | None) -> bool:
        """One controller, to its end; whether its work is done."""
        life, loop = Life(), asyncio.get_running_loop()
        writes = Writes(self._disk, life, cut)
        ending = loop.create_task(life.over.wait())
        timer = None
        if cut is not None and cut.kind is Kind.TIME:
            timer = loop.call_later(cut.at, life.end)
        working = loop.create_task(self._work(cell, referee, life, writes))
        await asyncio.wait([working, ending], return_when=asyncio.FIRST_COMPLETED)
        done = working.done() and not life.over.is_set()
        if timer is not None:
            timer.cancel()
        life.end()
        await _end_all(cell)
        cell.world.stop(cell.clock.now())
        if done:
            working.result()
        else:
            self._cuts += 1
            if cut is not None and cut.power:
                self._disk.lose_power()
        if not self._writes:
            self._writes = writes.count
        return done

    async def _work(self, cell: LightCell, referee: Referee, life: Life, writes: Writes) -> None:
        again = self._disk.journal.last > 0 or self._disk.page is not None
        wired = self._wired(cell, life, writes, again=again)
        referee.watch(wired.work)
        wired.notes.listen(heard=referee.heard)
        if again:
            await self._take_up(wired, cell, referee)
        else:
            self._want(wired)
        wired.controller.begin()
        await wired.controller.finish()

    def _wired(self, cell: LightCell, life: Life, writes: Writes, *, again: bool) -> Assembly:
        devices = cell.devices(life)
        ports = Ports(
            arm=BlindArm(devices.arm) if self._job.naive else devices.arm,
            override=devices.arm,
            gripper=devices.gripper,
            reader=devices.reader,
            bays=devices.bays,
            safety=devices.safety,
            person=devices.person,
            store=devices.store,
            sight=devices.sight,
            clock=cell.clock,
        )
        engine = resumed(self._tasks, writes) if again else None
        wiring = Wiring(
            self._layout, self._told, Settings(), self._tasks, writes, self._job.seed, engine=engine
        )
        wired = assemble(wiring, ports, light_desk(cell.refuses))
        work, promises = wired.work, wired.desk.promises
        work.keep = lambda: writes.write_page(page_of(work, promises))
        return wired

    def _want(self, wired: Assembly) -> None:
        """What is wanted that the controller does not know of yet."""
        known = {wish.key for wish in wired.work.wishes}
        for number, line in enumerate(self._told.lines[:WANTED]):
            key, priority = f"r-{number}", 0.3 + 0.4 * number
            if key not in known:
                wired.work.wishes.add(Request(priority, gtin=line.product.gtin), key)

    async def _take_up(self, wired: Assembly, cell: LightCell, referee: Referee) -> None:
        """As a served cell is taken up: restored, held, reconciled, and on after a start."""
        page, motions = self._disk.last_page(), cell.world.motions
        work, desk = wired.work, wired.desk
        if self._job.naive:
            page = believed(page, wired.controller.runtime.engine.state.facts)
        restore(page, work, desk.promises)
        self._want(wired)
        if self._job.naive:
            naive = NaiveRecovery(wired)
            wired.controller.runtime.restart()
            await asyncio.sleep(float(self._random.uniform(*COMES)))
            await naive.go_on()
            return
        recovery = Recovery(work, desk, page.hand)
        wired.controller.runtime.restart()
        recovery.examine()
        self._found.append(recovery.found.value)
        for _ in range(TRIES):
            await asyncio.sleep(float(self._random.uniform(*COMES)))
            referee.at_rest(motions)
            try:
                await recovery.go_on()
            except DepalError:
                recovery.examine()
                motions = cell.world.motions
            else:
                return
        referee.no_end("the cell could not go on after a restart")


def _cell_of(job: LightJob, layout: CellLayout, delivery: Delivery) -> LightCell:
    homes = assign_places([delivery], by_storage(layout.places, without=layout.aside))
    places = {gtin: found[:PLACES] for gtin, found in homes.items()}
    return build_light(layout, delivery, places, job.seed, clock=LoopClock(), rates=job.rates)


async def _end_all(cell: LightCell) -> None:
    """Everything that the controller has begun ends; what people do goes on."""
    mine = asyncio.current_task()
    tasks = [
        task for task in asyncio.all_tasks() if task is not mine and task not in cell.deeds.tasks
    ]
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)


def _complain(loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
    """The end of a controller is no fault of a task; anything else is."""
    if not isinstance(context.get("exception"), EndedError):
        loop.default_exception_handler(context)


def _sha256(disk: Disk) -> str:
    digest = hashlib.sha256()
    for record in disk.journal.records:
        digest.update(repr(record).encode())
    return digest.hexdigest()


def summed(outcomes: Sequence[LightOutcome]) -> Count:
    """The boxes of all runs together."""
    total = Count()
    for outcome in outcomes:
        total += outcome.count
    return total
