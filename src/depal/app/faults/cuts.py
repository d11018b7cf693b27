"""`depal study faults --cuts`: controllers that end anywhere, over a light world."""

from collections import Counter
from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass

import numpy as np

from depal.app.files import Json
from depal.app.light import Count, Cut, Kind, LightJob, LightOutcome, Moment, run_light
from depal.app.light.run import summed
from depal.app.reports.report import Report, plain_table, verdict
from depal.cell.files import find_cell
from depal.cell.tasks import read_shipped_tasks
from depal.simulation.light import Rates
from depal.studies.sweep import Progress, no_progress, sweep

BOXES = 10
"""Of each run."""

LIVES = 4
"""So many cuts come in one run at the most."""

WINDOW = 40.0
"""A random cut comes within so long of the start of its controller [s]."""

RATES = Rates(missed=0.02, double=0.009, infeasible=0.045)

PIECE = 20
"""Runs in one piece of work."""


@dataclass(frozen=True, slots=True)
class CutRuns:
    """All runs of the study.

    Attributes:
        positions: one for each write of a run, before and after it, with and without power.
        random: with several cuts each, at random moments, faults included.
        control: each position again, by a controller that runs everything again.
    """

    positions: tuple[LightOutcome, ...]
    random: tuple[LightOutcome, ...]
    control: tuple[LightOutcome, ...]


def cut_runs(
    cuts: int, seed: int, executor: Executor | None = None, progress: Progress = no_progress
) -> CutRuns:
    """Every position of one run, and so many random cuts; then the control.

    Args:
        cuts: random ones, at the least.
        seed: of the first run.
        executor: any; None works in this process.
        progress: called after each piece.
    """
    (whole,) = run_piece((LightJob(BOXES, seed),))
    at = positions(whole, seed)
    control = [LightJob(BOXES, seed, cuts=job.cuts, naive=True) for job in at]
    jobs = [*at, *random_jobs(cuts, seed), *control]
    pieces = [tuple(jobs[k : k + PIECE]) for k in range(0, len(jobs), PIECE)]
    done = [run for piece in sweep(run_piece, pieces, executor, progress) for run in piece]
    first, last = len(at), len(done) - len(control)
    return CutRuns(tuple(done[:first]), tuple(done[first:last]), tuple(done[last:]))


def positions(whole: LightOutcome, seed: int) -> list[LightJob]:
    """A run for each write of a run that nobody cuts."""
    return [
        LightJob(BOXES, seed, cuts=(Cut(kind, number, moment, power),))
        for kind, count in whole.writes.items()
        for number in range(1, count + 1)
        for moment in Moment
        for power in (False, True)
    ]


def random_jobs(cuts: int, seed: int) -> list[LightJob]:
    """Runs with so many cuts together."""
    random = np.random.default_rng([seed, 26])
    jobs: list[LightJob] = []
    planned = 0
    while planned < cuts:
        lives = int(random.integers(1, LIVES + 1))
        at = tuple(
            Cut(
                Kind.TIME,
                round(float(random.uniform(0.0, WINDOW)), 3),
                power=bool(random.integers(2)),
            )
            for _ in range(lives)
        )
        jobs.append(LightJob(BOXES, seed + len(jobs), RATES, at))
        planned += lives
    return jobs


def run_piece(jobs: tuple[LightJob, ...]) -> list[LightOutcome]:
    """Some runs, in whatever process."""
    layout, tasks = find_cell("default"), read_shipped_tasks()
    return [run_light(job, layout, tasks) for job in jobs]


def cuts_report(runs: CutRuns, seed: int, seconds: float) -> Report:
    """The report of the cuts; it holds where nothing is wrong but in the control."""
    table = plain_table(
        "Cuts", "runs", "number", "cuts", "lost", "doubled", "misplaced", "wrong", ""
    )
    rows: list[Json] = []
    kinds = (("positions", runs.positions), ("random", runs.random), ("control", runs.control))
    holds = True
    for name, outcomes in kinds:
        count = summed(outcomes)
        wrong = sum(bool(run.wrongs) for run in outcomes)
        cuts = sum(run.cuts for run in outcomes)
        bad = count.lost + count.doubled + count.misplaced + wrong
        met = bad > 0 if name == "control" else bad == 0
        holds = holds and met
        table.row(
            name, str(len(outcomes)), str(cuts), str(count.lost), str(count.doubled),
            str(count.misplaced), str(wrong), verdict(met, "met", "missed"),
        )  # fmt: skip
        rows.append(
            {
                "runs": name,
                "number": len(outcomes),
                "cuts": cuts,
                **fields_of(count),
                "wrong": wrong,
                "found": dict(Counter(f for r in outcomes for f in r.found)),
            }
        )
    shown = [table]
    fields: dict[str, Json] = {
        "seed": seed,
        "seconds": seconds,
        "rows": rows,
        "wrong": wrongs_of((*runs.positions, *runs.random)),
    }
    return Report(fields, shown, holds=holds)


def fields_of(count: Count) -> dict[str, Json]:
    """A count as JSON."""
    return {
        "boxes": count.boxes,
        "stored": count.stored,
        "aside": count.aside,
        "by_person": count.by_person,
        "dropped": count.dropped,
        "left": count.left,
        "lost": count.lost,
        "doubled": count.doubled,
        "misplaced": count.misplaced,
    }


def wrongs_of(runs: Sequence[LightOutcome]) -> list[Json]:
    """What was wrong, with the run that shows it again."""
    return [
        f"seed {run.job.seed}, cuts {'; '.join(map(str, run.job.cuts)) or 'none'}: {line}"
        for run in runs
        for line in run.wrongs
    ]
