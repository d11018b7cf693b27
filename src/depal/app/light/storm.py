"""Crash cuts and a long shift in light worlds: runs by the thousand, summed up."""

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from depal.app.light.cuts import Cut, Kind, Moment
from depal.app.light.referee import Count
from depal.app.light.run import LightJob, LightOutcome, run_light
from depal.cell.files import shipped_cell
from depal.cell.tasks import read_shipped_tasks
from depal.domain import CellLayout
from depal.executive.schema import Repository
from depal.simulation.light import NO_FAULTS, SOAK, Rates
from depal.studies.kept import Kept, sweep_kept
from depal.studies.sweep import Progress, no_progress

BOXES = 10
"""In the runs that are cut."""

PALLET = 24
"""Boxes on each pallet of a shift."""

MOST = 3
"""So many controllers of one run are ended at random moments, at the most."""

AGAIN = 0.3
"""So often the next controller is ended while it still brings itself and the world together."""

EARLY = 25.0
"""It is ended within so long of its start then [s]."""

CONTROLS = 0.02
"""So many runs of the control for each random cut."""


@dataclass(frozen=True, slots=True)
class Storm:
    """What is to be run.

    Attributes:
        cuts: at random moments, beside those at every write of a run; 0 for no cuts at all.
        shift: boxes of a long shift; 0 for none.
        seed: of every random number.
    """

    cuts: int = 0
    shift: int = 0
    seed: int = 0


@dataclass(frozen=True, slots=True)
class Stormed:
    """What came of it.

    Attributes:
        positions: runs with one cut, one for each moment before or after a write.
        random: runs with cuts at random moments.
        control: runs of the control that were cut at random moments.
        shift: pallets of the shift.
    """

    positions: tuple[LightOutcome, ...] = ()
    random: tuple[LightOutcome, ...] = ()
    control: tuple[LightOutcome, ...] = ()
    shift: tuple[LightOutcome, ...] = ()


def storm(
    asked: Storm,
    executor: Executor | None = None,
    progress: Progress = no_progress,
    keep: Path | None = None,
) -> Stormed:
    """Runs everything; the same seed gives the same.

    Args:
        asked: what is to be run.
        executor: where the runs are done; None for this process.
        progress: told after each run.
        keep: a folder for finished runs; those that it has already are not run again.

    Raises:
        SettingError: the folder cannot be used.
    """
    kept = Kept.of(keep, _name, LightOutcome)
    jobs: list[tuple[str, LightJob]] = []
    if asked.cuts:
        whole = run_one(LightJob(BOXES, asked.seed))
        jobs += [("positions", job) for job in at_every_write(whole)]
        random = at_random(asked.cuts, asked.seed, whole.sim_seconds)
        jobs += [("random", job) for job in random]
        count = max(round(CONTROLS * asked.cuts), 10)
        control = at_random(count, asked.seed + 1, whole.sim_seconds, naive=True)
        jobs += [("control", job) for job in control]
    jobs += [("shift", job) for job in shift_of(asked.shift, asked.seed)]
    outcomes = sweep_kept(run_one, [job for _, job in jobs], kept, executor, progress)
    found = {
        name: tuple(o for (kind, _), o in zip(jobs, outcomes, strict=True) if kind == name)
        for name in ("positions", "random", "control", "shift")
    }
    return Stormed(**found)


def _name(job: LightJob) -> str:
    return f"light-{job.boxes}-{job.seed}"


def run_one(job: LightJob) -> LightOutcome:
    """One run, in whatever process; one that breaks down is a result, and has lost every box."""
    try:
        return run_light(job, *_cell())
    except Exception as error:  # noqa: BLE001 - whatever it is, it is what we report
        wrong = f"no end: {type(error).__name__}: {error}"
        return LightOutcome(job, Count(job.boxes, lost=job.boxes), (wrong,))


@lru_cache(maxsize=1)
def _cell() -> tuple[CellLayout, Repository]:
    return shipped_cell(), read_shipped_tasks()


def at_every_write(whole: LightOutcome) -> list[LightJob]:
    """The same run, ended before and after each of its writes; and with the power gone as well."""
    jobs = []
    for kind, count in sorted(whole.writes.items(), key=lambda item: item[0].value):
        for number in range(1, count + 1):
            for moment in Moment:
                jobs += [(Cut(kind, number, moment),)]
            if kind is Kind.JOURNAL:
                jobs += [(Cut(kind, number, Moment.AFTER, power=True),)]
    return [LightJob(whole.job.boxes, whole.job.seed, whole.job.rates, cuts) for cuts in jobs]


def at_random(cuts: int, seed: int, seconds: float, *, naive: bool = False) -> list[LightJob]:
    """Runs with so many cuts together, at random moments, some of them soon after a restart.

    Args:
        cuts: how many.
        seed: of the moments, the deliveries and the faults.
        seconds: a run takes about so long [s].
        naive: whether the control is run.
    """
    random, jobs = np.random.default_rng([seed, 31]), list[LightJob]()
    while cuts > 0:
        moments = []
        for number in range(min(int(random.integers(1, MOST + 1)), cuts)):
            early = number > 0 and random.random() < AGAIN
            reach = EARLY if early else seconds / MOST
            power = bool(random.random() < 1 / 2)
            moments.append(Cut(Kind.TIME, round(float(random.uniform(0.0, reach)), 4), power=power))
        rates = SOAK if random.random() < 1 / 2 else NO_FAULTS
        jobs.append(LightJob(BOXES, seed * 100_003 + len(jobs), rates, tuple(moments), naive))
        cuts -= len(moments)
    return jobs


def shift_of(boxes: int, seed: int, rates: Rates = SOAK) -> list[LightJob]:
    """Pallets of a long shift; the last one holds what is left."""
    full, rest = divmod(boxes, PALLET)
    sizes = [PALLET] * full + ([rest] if rest else [])
    return [LightJob(size, seed * 1_000_003 + k, rates) for k, size in enumerate(sizes)]


def wrongs_of(outcomes: Sequence[LightOutcome]) -> list[str]:
    """Every breach, with what runs it again."""
    return [
        f"{', '.join(map(str, outcome.job.cuts)) or 'no cut'}, seed {outcome.job.seed}: {wrong}"
        for outcome in outcomes
        for wrong in outcome.wrongs
    ]
