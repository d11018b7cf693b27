"""`depal run`: from options to a report."""

import asyncio
import time
from collections.abc import Callable, Mapping
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path

from depal.app.files import write_json
from depal.app.progress import progress_bar
from depal.app.reports.report import Report
from depal.app.run.accounting import Onlooker, left_behind, meant
from depal.app.run.assembly import Assembly, Wiring, assemble
from depal.app.run.case2 import NAME as CASE2
from depal.app.run.case2 import case2_delivery, case2_names, case2_requests
from depal.app.run.eyes import camera_sight
from depal.app.run.film import Film
from depal.app.run.inputs import cell_of, checked_speed, one_of, policy_of, refuse_what_cannot_work
from depal.app.run.inspecting import Inspector
from depal.app.run.live import LiveView, watched
from depal.app.run.record import RESULT, Keeper
from depal.app.run.recovering import RecoveryTimes, TimedWorld
from depal.app.run.request_ends import wrong_ends
from depal.app.run.scoring import ScoreKeeper
from depal.app.run.summary import Outcome, disagreements, run_report
from depal.app.run.tasks import tasks_of
from depal.app.run.values import PERCEPTIONS, TRUTH, Job, Options
from depal.cell.controller import Controller
from depal.cell.planning.desk import Desk, MotionDesk
from depal.cell.sight import CameraSight
from depal.cell.stock import movements_in
from depal.cell.tasks import read_shipped_tasks
from depal.cell.timekeeping import WAITING, Timekeeper
from depal.cell.wishes import Wish
from depal.cell.workplace import Ports, Settings, Workplace
from depal.domain import Delivery, Gtin, Request, checked_share
from depal.executive.clock import Clock, LoopClock, run_simulated
from depal.executive.schema import Repository
from depal.logistics import read_delivery, read_requests
from depal.logistics.store import LocalStore, RequestState, StockProjection, by_storage
from depal.ports import Sight
from depal.simulation.cell import SimulatedCell, build
from depal.simulation.faults import FaultPlan, Injection, read_faults
from depal.simulation.imaging.severity import Severity
from depal.simulation.truth_sight import SightSettings

DEFAULT = "dev-035"
"""The delivery that is run when none is named: real, and the smallest that ships."""

NONE = "none"

Seeing = Callable[[Job, SimulatedCell, Clock, Injection], Sight]
"""What the cell sees with."""


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
    perception = one_of("--perception", options.perception, PERCEPTIONS)
    severity = Severity(one_of("--severity", options.severity, [each.value for each in Severity]))
    layout = cell_of(options.cell)
    tasks = tasks_of(options.tasks, layout) if options.tasks else None
    delivery, note, requests = _delivery_and_requests(options)
    findings = refuse_what_cannot_work(layout, delivery if note is None else note)
    impossible = {Gtin(finding.gtin): str(finding.problem) for finding in findings}
    settings = Settings(
        w=checked_share("--w", options.w),
        policy=policy_of(options.policy),
        speed=checked_speed(options.speed),
        guard=options.guard,
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
        perception,
        severity,
        case2_names() if options.delivery == CASE2 else (),
        note,
        read_faults(Path(options.faults)) if options.faults else FaultPlan(),
        tasks=tasks,
    )


def _delivery_and_requests(
    options: Options,
) -> tuple[Delivery, Delivery | None, tuple[Request, ...]]:
    note = read_delivery(options.note) if options.note else None
    if options.delivery == CASE2:
        delivery, requests = case2_delivery(), case2_requests()
    else:
        delivery, requests = read_delivery(options.delivery or DEFAULT), ()
    if options.requests == NONE:
        requests = ()
    elif options.requests:
        requests = read_requests(Path(options.requests), note or delivery)
    return delivery, note, requests


def seeing_of(job: Job, cell: SimulatedCell, clock: Clock, faults: Injection) -> Sight:
    """What the job asks for."""
    if job.perception == TRUTH:
        return faults.sight(cell.sight)
    return camera_sight(job, cell, clock, faults.cameras)


def run_job(
    job: Job, *, record: Path | None = None, watch: bool = False, seeing: Seeing = seeing_of
) -> Outcome:
    """Runs in simulated time.

    Args:
        job: what to do.
        record: the folder to keep a record in.
        watch: whether somebody watches in the terminal.
        seeing: what the cell sees with.
    """
    began = time.perf_counter()
    tasks = job.tasks or read_shipped_tasks()
    with LocalStore() as store, Keeper.open(record, tasks) as keeper:
        outcome, film = run_simulated(_run(job, store, keeper, tasks, seeing, watch=watch))
        keeper.write_choices()
    seconds = time.perf_counter() - began
    if record is not None:
        with progress_bar("Pictures") as progress:
            film.save(record, progress)
        if outcome.scores is not None:
            outcome.scores.save(record)
    return replace(outcome, wall_seconds=seconds)


async def _run(
    job: Job,
    store: LocalStore,
    keeper: Keeper,
    tasks: Repository,
    seeing: Seeing,
    *,
    watch: bool,
) -> tuple[Outcome, Film]:
    clock = LoopClock()
    cell = build(
        job.layout,
        job.delivery,
        job.seed,
        clock=clock,
        sight=job.sight,
        severity=job.severity,
        kind=TimedWorld,
    )
    places = by_storage(job.layout.places, without=job.layout.aside)
    store.seed_places([job.told], places, seed=job.seed)
    injection = Injection.into(cell, job.faults, job.seed, clock)
    sight = seeing(job, cell, clock, injection)
    wired = _wired(job, tasks, keeper, injection, _ports(cell, injection, store, sight))
    work, desk, notes, controller = wired.work, wired.desk, wired.notes, wired.controller
    keeper.listen_to(notes)
    Onlooker(cell.witness).listen_to(notes)
    view = LiveView(work, len(job.told.boxes))
    view.listen_to(notes)
    keys = store.accept(job.requests, source=f"run of {job.delivery.id}, seed {job.seed}")
    scores = ScoreKeeper(work, lambda: sight.frames if isinstance(sight, CameraSight) else ())
    scores.listen_to(notes)
    inspector, recoveries = Inspector(work, cell, injection.arm.fell), RecoveryTimes(cell.world)
    if job.inspected:
        if isinstance(cell.world, TimedWorld):
            cell.world.stopwatch = time.perf_counter
        for looks_on in (inspector, recoveries):
            looks_on.listen_to(notes)
            injection.arm.watchers.append(looks_on.moves)
    film = Film(cell, view.caption)
    filming = asyncio.get_running_loop().create_task(film.record())
    with watched(view) if watch else nullcontext():
        async with asyncio.timeout(job.horizon):
            working = controller.empty_pallet(job.requests)
            await (inspector.over(working) if job.inspected else working)
    filming.cancel()
    film.take()
    wishes = dict(zip(keys, work.wishes, strict=True))
    _close_books(store, keeper, controller, wishes)
    outcome = _outcome(job, work, desk, cell, keeper, wired.times)
    outcome = replace(
        outcome,
        struck=injection.struck,
        motions=tuple(injection.arm.began),
        most_held=injection.arm.most_held,
        broken=inspector.broken,
        ends_amiss=tuple(wrong_ends(store.requests(), wishes, outcome.stack, cell.referee)),
        fell=dict(injection.arm.fell),
        checks=inspector.checks,
        recoveries=tuple(recoveries.seconds),
    )
    return replace(outcome, scores=scores.scores), film


def _wired(
    job: Job, tasks: Repository, keeper: Keeper, injection: Injection, ports: Ports
) -> Assembly:
    """The controller of a run; planner, journal and ledger may fail as the job says."""
    wiring = Wiring(
        job.layout,
        job.told,
        job.settings,
        tasks,
        injection.journal(keeper.journal),
        seed=job.seed,
        impossible=job.impossible,
        cone=job.cone,
    )
    wired = assemble(wiring, ports)
    if isinstance(wired.desk, MotionDesk):
        wired.desk.planner.mover = injection.mover(wired.desk.planner.mover)
    wired.work.keep = wired.controller.books.keeping(injection.page)
    return wired


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


def _ports(cell: SimulatedCell, faults: Injection, store: LocalStore, sight: Sight) -> Ports:
    return Ports(
        arm=faults.arm,
        gripper=faults.gripper,
        reader=faults.reader,
        bays=faults.bays,
        safety=cell.safety,
        person=faults.person,
        store=faults.store(store),
        sight=sight,
        clock=faults.clock,
        override=cell.arm,
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
        differences=work.note_differences(),
        disagreements=disagreements(
            cell.referee, sequence, left, stack, {each.gtin for each in work.note_differences()}
        ),
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
