"""The runs of the study, in worker processes."""

import time
from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from depal.app.faults.pieces import Piece, known, pairs_of
from depal.app.faults.verdicts import Verdict, verdict_of
from depal.app.run.job import run_job
from depal.app.run.summary import Outcome
from depal.app.run.values import Job
from depal.cell.files import find_cell
from depal.cell.workplace import Settings
from depal.domain import (
    EURO_PALLET,
    BoxId,
    Delivery,
    DeliveryLine,
    Gtin,
    Product,
    Request,
    StackedCase,
)
from depal.errors import SettingError
from depal.geometry import Vector3
from depal.simulation.faults import CATALOGUE, FaultPlan
from depal.simulation.truth_sight import SightSettings
from depal.studies.kept import Kept, sweep_kept
from depal.studies.sweep import Progress, no_progress

CASES: tuple[tuple[Vector3, Vector3, float], ...] = (
    ((0.30, 0.0, 0.0), (0.28, 0.25, 0.22), 4.0),
    ((0.60, 0.0, 0.0), (0.25, 0.30, 0.20), 6.0),
    ((0.30, 0.0, 0.22), (0.28, 0.25, 0.20), 3.0),
)
"""Corner in the pallet's frame [m], size [m] and mass [kg]: one case stands on another."""

UNRECOGNISED = {"N1": 1.0, "N3": 1.0}
"""Where a fault needs the reader, the picture names no box."""

SOME = 0.3
"""The share of boxes that the picture does not name."""

HORIZON = 20_000.0
"""A run that has not ended by then never will [s]."""

SOON = 15.0
"""Requests come within this time [s]."""


@dataclass(frozen=True, slots=True)
class FaultsAsked:
    """The options of the study.

    Attributes:
        faults: ids with commas between them; "" for all.
        seeds: runs of each.
        seed: the first.
        pairs: runs with two random ones of them.
    """

    faults: str = ""
    seeds: int = 3
    seed: int = 0
    pairs: int = 0

    @property
    def ids(self) -> tuple[str, ...]:
        """The faults.

        Raises:
            SettingError: the catalogue has none of that name.
        """
        return known(self.faults.split(","), "--faults") or tuple(CATALOGUE)

    @property
    def pieces(self) -> list[Piece]:
        """Every fault with every seed, then the pairs.

        Raises:
            SettingError: the catalogue has none of a name, or pairs of one fault are asked for.
        """
        if self.pairs and len(self.ids) < 2:  # noqa: PLR2004 - a pair
            raise SettingError("--pairs", "one fault makes no pair", "two or more --faults")
        seeds = range(self.seed, self.seed + self.seeds)
        alone = [Piece((name,), seed) for name in self.ids for seed in seeds]
        return [*alone, *(pairs_of(self.ids, self.pairs, self.seed) if self.pairs else ())]


@dataclass(frozen=True, slots=True)
class Ran:
    """One run.

    Attributes:
        piece: which.
        verdict: on it; None where the run came to no end.
        reason: why it came to none.
        recoveries: real time from the notice of each fault to the next motion [s].
        checks: how often the invariants were checked.
        seconds: it took, of real time.
        events_sha256: of its event log.
    """

    piece: Piece
    verdict: Verdict | None
    reason: str = ""
    recoveries: tuple[float, ...] = ()
    checks: int = 0
    seconds: float = 0.0
    events_sha256: str = ""


def faults_rows(
    asked: FaultsAsked,
    executor: Executor | None = None,
    progress: Progress = no_progress,
    keep: Path | None = None,
) -> list[Ran]:
    """Every fault with every seed, then pairs: three boxes, at steps and in phases of the seed.

    Args:
        asked: the options.
        executor: where the runs are done; None for this process.
        progress: told after each run.
        keep: a folder for finished runs; those that it has already are not run again.

    Raises:
        SettingError: a fault that is not in the catalogue, or a folder that cannot be used.
    """
    kept = Kept.of(keep, name_of, Ran)
    return sweep_kept(run_one, asked.pieces, kept, executor, progress)


def name_of(piece: Piece) -> str:
    """Of the file that keeps a run."""
    return f"{piece.name}-{piece.seed}"


def run_one(piece: Piece, record: Path | None = None) -> Ran:
    """One run, in whatever process; a run that breaks down is a result of the study.

    Where the faults found no chance at their steps, they take the first that they get.

    Args:
        piece: which.
        record: a folder to keep its record in.
    """
    began, job = time.perf_counter(), job_of(piece)
    try:
        outcome = run_job(job)
        if not outcome.struck:
            job = replace(job, faults=FaultPlan.of(*piece.ids))
            outcome = run_job(job)
        if record is not None:
            outcome = run_job(job, record=record)
    except Exception as error:  # noqa: BLE001 - whatever it is, it is what we report
        return Ran(piece, None, f"{type(error).__name__}: {error}")
    return _ran(piece, outcome, time.perf_counter() - began)


def _ran(piece: Piece, outcome: Outcome, seconds: float) -> Ran:
    return Ran(
        piece,
        verdict_of(outcome, *piece.ids),
        recoveries=outcome.recoveries,
        checks=outcome.checks,
        seconds=seconds,
        events_sha256=outcome.events_sha256,
    )


def job_of(piece: Piece, cases: Sequence[tuple[Vector3, Vector3, float]] = CASES) -> Job:
    """A small delivery in the default cell, requests, and what is to strike."""
    unrecognised = max(UNRECOGNISED.get(fault_id, SOME) for fault_id in piece.ids)
    delivery = delivery_of(cases)
    return Job(
        find_cell("default"),
        delivery,
        requests_of(delivery, piece.seed),
        Settings(),
        piece.seed,
        SightSettings(sigma=0.001, unrecognised=unrecognised),
        faults=FaultPlan.at_random(piece.ids, piece.seed, len(cases)),
        inspected=True,
        horizon=HORIZON,
    )


def delivery_of(cases: Sequence[tuple[Vector3, Vector3, float]]) -> Delivery:
    """A delivery of these cases, each of a product of its own."""
    codes = [Gtin(f"1200090000{number:03d}0") for number in range(len(cases))]
    lines = [
        DeliveryLine(Product(code, f"case {number}", size, mass), 1)
        for number, (code, (_, size, mass)) in enumerate(zip(codes, cases, strict=True), start=1)
    ]
    stack = [
        StackedCase(code, corner, size)
        for code, (corner, size, _) in zip(codes, cases, strict=True)
    ]
    return Delivery("faults", EURO_PALLET, tuple(lines), tuple(stack))


def requests_of(delivery: Delivery, seed: int) -> tuple[Request, ...]:
    """Two wishes for products and one for a box, some of which nothing may serve."""
    random = np.random.default_rng([seed, 22])
    products = [line.product.gtin for line in delivery.lines]
    wanted = random.integers(len(products), size=3).tolist()
    priorities, times = random.random(3).tolist(), (SOON * random.random(3)).tolist()
    return (
        Request(priorities[0], gtin=products[wanted[0]], arrived=times[0]),
        Request(priorities[1], gtin=products[wanted[1]], arrived=times[1]),
        Request(priorities[2], box=BoxId(f"b{wanted[2] + 1}"), arrived=times[2]),
    )
