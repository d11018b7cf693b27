"""`depal run`: from options to a report."""

import asyncio
import time
from collections.abc import Callable, Mapping
from contextlib import nullcontext
from dataclasses import dataclass, field, replace
from pathlib import Path

from depal.app.files import write_json
from depal.app.progress import progress_bar
from depal.app.reports.report import Report
from depal.app.run.accounting import Onlooker, left_behind, meant
from depal.app.run.case2 import NAME as CASE2
from depal.app.run.case2 import case2_delivery, case2_requests
from depal.app.run.film import Film
from depal.app.run.inputs import cell_of, checked_speed, policy_of, refuse_what_cannot_work
from depal.app.run.live import LiveView, watched
from depal.app.run.record import RESULT, Keeper
from depal.app.run.summary import Outcome, disagreements, run_report
from depal.cell.controller import Controller
from depal.cell.planning.desk import Desk
from depal.cell.planning.planner import Planner
from depal.cell.questions import Questions
from depal.cell.reporting import Journalist
from depal.cell.stock import movements_in
from depal.cell.tasks import read_shipped_tasks
from depal.cell.timekeeping import WAITING, Timekeeper, timed
from depal.cell.wishes import Wish
from depal.cell.workplace import Ports, Settings, Workplace
from depal.domain import CellLayout, Delivery, Gtin, Request, checked_share
from depal.errors import MissingPartError, SettingError, did_you_mean
from depal.executive.clock import LoopClock, run_simulated
from depal.executive.schema import Repository
from depal.logistics import read_delivery, read_requests
from depal.logistics.store import LocalStore, RequestState, StockProjection, by_storage
from depal.simulation.cell import SimulatedCell, build
from depal.simulation.truth_sight import SightSettings

DEFAULT = "dev-035"
"""The delivery that is run when none is named: real, and the smallest that ships."""

NONE = "none"

PERCEPTIONS = ("truth",)


@dataclass(frozen=True, slots=True)
class Options:
    """What `depal run` was asked for.

    Attributes:
        delivery: a reference, "case2", or "" for the one that is run by default.
        cell: a cell file or the name of one that ships.
        requests: a file of requests, "none", or "" for what the delivery brings.
        w: the weight of Eq. (3).
        policy: which boxes may be taken.
        perception: where boxes come from.
        seed: of every random number.
        speed: share of the arm's full speed.
        record: the folder to keep a record in.
        cone: whether motions respect the suction's limits; only tests switch it off.
    """

    delivery: str = ""
    cell: str = "default"
    requests: str = ""
    w: float = 0.5
    policy: str = "paper"
    perception: str = "truth"
    seed: int = 0
    speed: float = 1.0
    record: Path | None = None
    cone: bool = True


@dataclass(frozen=True, slots=True)
class Job:
    """Everything that a run needs, read and checked.

    Attributes:
        layout: the cell.
        delivery: with its stack, or a bare note.
        requests: known from their own times on.
        settings: of the controller.
        seed: of every random number.
        sight: how good the perception is.
        cone: whether motions respect the suction's limits.
        impossible: products that the arm cannot handle, and why; their cases go to a person.
    """

    layout: CellLayout
    delivery: Delivery
    requests: tuple[Request, ...]
    settings: Settings
    seed: int = 0
    sight: SightSettings = field(default_factory=SightSettings)
    cone: bool = True
    impossible: Mapping[Gtin, str] = field(default_factory=dict)


def run_delivery(
    options: Options, *, watch: bool = False, say: Callable[[str], None] = lambda _: None
) -> Report:
    """Reads everything, runs, and sums up.

    Args:
        options: what was asked for.
        watch: whether somebody watches in the terminal.
        say: told before anything moves what this cell cannot do with this delivery.

    Raises:
        InputError: something that was given cannot be used; nothing has moved.
    """
    job = prepared(options)
    for reason in job.impossible.values():
        say(reason)
    outcome = run_job(job, record=options.record, watch=watch)
    report = run_report(outcome, options.perception)
    if options.record is not None:
        write_json(options.record / RESULT, report.fields)
    return report


def prepared(options: Options) -> Job:
    """Reads and checks what a run needs.

    Raises:
        InputError: with everything that is wrong with the first input that is wrong.
    """
    if options.perception not in PERCEPTIONS:
        what = f"{options.perception!r} is not there yet"
        exists = did_you_mean(options.perception, PERCEPTIONS)
        raise SettingError("--perception", what, exists=exists)
    layout = cell_of(options.cell)
    delivery, requests = _delivery_and_requests(options)
    findings = refuse_what_cannot_work(layout, delivery)
    impossible = {Gtin(finding.gtin): str(finding.problem) for finding in findings}
    settings = Settings(
        w=checked_share("--w", options.w),
        policy=policy_of(options.policy),
        speed=checked_speed(options.speed),
    )
    recognised = SightSettings(unrecognised=0.0) if options.delivery == CASE2 else SightSettings()
    return Job(
        layout,
        delivery,
        requests,
        settings,
        options.seed,
        recognised,
        options.cone,
        impossible,
    )


def _delivery_and_requests(options: Options) -> tuple[Delivery, tuple[Request, ...]]:
    if options.delivery == CASE2:
        delivery, requests = case2_delivery(), case2_requests()
    else:
        delivery, requests = read_delivery(options.delivery or DEFAULT), ()
    if options.requests == NONE:
        return delivery, ()
    if options.requests:
        return delivery, read_requests(Path(options.requests), delivery)
    return delivery, requests


def run_job(job: Job, *, record: Path | None = None, watch: bool = False) -> Outcome:
    """Runs in simulated time.

    Args:
        job: what to do.
        record: the folder to keep a record in.
        watch: whether somebody watches in the terminal.
    """
    began = time.perf_counter()
    tasks = read_shipped_tasks()
    with LocalStore() as store, Keeper.open(record, tasks) as keeper:
        outcome, film = run_simulated(_run(job, store, keeper, tasks, watch=watch))
        keeper.write_choices()
    seconds = time.perf_counter() - began
    if record is not None:
        with progress_bar("Pictures") as progress:
            film.save(record, progress)
    return replace(outcome, wall_seconds=seconds)


async def _run(
    job: Job, store: LocalStore, keeper: Keeper, tasks: Repository, *, watch: bool
) -> tuple[Outcome, Film]:
    clock = LoopClock()
    cell = build(job.layout, job.delivery, job.seed, clock=clock, sight=job.sight)
    places = by_storage(job.layout.places, without=job.layout.aside)
    store.seed_places([job.delivery], places, seed=job.seed)
    times = Timekeeper(clock)
    ports = timed(_ports(cell, store, clock), times)
    questions = Questions(ports.person, clock)
    work = Workplace(job.layout, job.delivery, ports, job.settings, questions, job.impossible)
    planner = Planner(work, times, cone=job.cone, seed=job.seed, stopwatch=time.perf_counter)
    desk = Desk(work, planner)
    notes = Journalist()
    controller = Controller(work, desk, notes, tasks, keeper.journal)
    keeper.listen_to(notes)
    Onlooker(cell.witness).listen_to(notes)
    view = LiveView(work, len(job.delivery.boxes))
    view.listen_to(notes)
    keys = store.accept(job.requests, source=f"run of {job.delivery.id}, seed {job.seed}")
    film = Film(cell, view.caption)
    filming = asyncio.get_running_loop().create_task(film.record())
    with watched(view) if watch else nullcontext():
        await controller.empty_pallet(job.requests)
    filming.cancel()
    film.take()
    _close_books(store, keeper, controller, dict(zip(keys, work.wishes, strict=True)))
    return _outcome(job, work, desk, cell, keeper, times), film


def _close_books(
    store: LocalStore, keeper: Keeper, controller: Controller, wishes: Mapping[str, Wish]
) -> None:
    """Brings the store's data up to date: requests have ended, the stock follows the journal."""
    state = controller.runtime.engine.state
    for key, wish in wishes.items():
        if wish.served is not None:
            store.settle(key, RequestState.SERVED, wish.served, f"by {wish.box}")
        else:
            store.settle(key, RequestState.REJECTED, state.now, "no case of it was left")
    stock = StockProjection(store.database, lambda record: movements_in(record, state.facts))
    stock.catch_up(keeper.journal)


def _ports(cell: SimulatedCell, store: LocalStore, clock: LoopClock) -> Ports:
    if cell.reader is None:
        raise MissingPartError("the simulated cell has no barcode reader")
    return Ports(
        arm=cell.arm,
        gripper=cell.gripper,
        reader=cell.reader,
        bays=cell.bays,
        safety=cell.safety,
        person=cell.person,
        store=store,
        sight=cell.sight,
        clock=clock,
    )


def _outcome(
    job: Job, work: Workplace, desk: Desk, cell: SimulatedCell, keeper: Keeper, times: Timekeeper
) -> Outcome:
    boxes = len(cell.world.cases)
    sequence = work.departures.sequence
    left = left_behind(work, sequence, cell.witness, boxes)
    stack = meant(cell.witness.indices, left, cell.referee, boxes)
    shares = times.shares(work.now)
    return Outcome(
        delivery=job.delivery.id,
        boxes=boxes,
        stack=stack,
        departures=sequence,
        left=left,
        wishes=tuple(work.wishes),
        questions=work.questions.all,
        referee=cell.referee.summary(),
        disagreements=disagreements(cell.referee, sequence, left, stack),
        sim_seconds=work.now,
        waiting_seconds=shares[WAITING],
        wall_seconds=0.0,
        shares=shares,
        plan_seconds=tuple(desk.planner.spent),
        policy=job.settings.policy.value,
        w=job.settings.w,
        seed=job.seed,
        speed=job.settings.speed,
        events_sha256=keeper.events_sha256,
    )
