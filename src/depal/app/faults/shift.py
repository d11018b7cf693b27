"""`depal study faults --shift`: a long shift at published rates of faults, over a light world."""

from collections import Counter
from collections.abc import Sequence
from concurrent.futures import Executor

import numpy as np

from depal.app.faults.cuts import BOXES, PIECE, fields_of, run_piece, wrongs_of
from depal.app.files import Json
from depal.app.light import LightJob, LightOutcome
from depal.app.light.run import summed
from depal.app.reports.report import Report, plain_table, verdict
from depal.simulation.light import SOAK
from depal.studies.sweep import Progress, no_progress, sweep

RESAMPLES = 2_000
"""Of deliveries, for the interval."""


def shift_runs(
    boxes: int, seed: int, executor: Executor | None = None, progress: Progress = no_progress
) -> list[LightOutcome]:
    """Deliveries of ten boxes one after the other, until there were so many.

    Args:
        boxes: at the least.
        seed: of the first delivery; each has its own.
        executor: any; None works in this process.
        progress: called after each piece.
    """
    jobs = [LightJob(BOXES, seed + number, SOAK) for number in range(-(-boxes // BOXES))]
    pieces = [tuple(jobs[k : k + PIECE]) for k in range(0, len(jobs), PIECE)]
    return [run for piece in sweep(run_piece, pieces, executor, progress) for run in piece]


def interventions(runs: Sequence[LightOutcome], seed: int = 0) -> tuple[float, float, float]:
    """Questions to people per 1,000 boxes, with a 95 % interval by resampling deliveries."""
    asked = np.array([len(run.asked) for run in runs], dtype=float)
    boxes = sum(run.count.boxes for run in runs)
    random = np.random.default_rng([seed, 27])
    sums = [
        float(asked[random.integers(len(asked), size=len(asked))].sum()) for _ in range(RESAMPLES)
    ]
    low, high = np.quantile(sums, [0.025, 0.975]).tolist()
    scale = 1_000 / max(boxes, 1)
    return float(asked.sum()) * scale, low * scale, high * scale


def shift_report(runs: Sequence[LightOutcome], seed: int, seconds: float) -> Report:
    """The report of a shift; it holds where nothing was lost and nothing silently misplaced."""
    count = summed(runs)
    rate, low, high = interventions(runs, seed)
    wrong = wrongs_of(runs)
    holds = not (count.lost or count.doubled or count.misplaced or wrong)
    struck: Counter[str] = Counter()
    for run in runs:
        struck.update(run.struck)
    table = plain_table("A shift", "", "")
    for name, value in fields_of(count).items():
        table.row(name, str(value))
    table.row("interventions per 1,000", f"{rate:.1f} ({low:.1f} to {high:.1f})")
    table.row("", verdict(holds, "met", "missed"))
    fields: dict[str, Json] = {
        "seed": seed,
        "seconds": seconds,
        **fields_of(count),
        "interventions": rate,
        "interventions_ci95": [low, high],
        "struck": dict(struck),
        "asked": dict(Counter(each.split("/")[0] for run in runs for each in run.asked)),
        "sim_seconds": sum(run.sim_seconds for run in runs),
        "wrong": wrong,
    }
    return Report(fields, [table], holds=holds)
