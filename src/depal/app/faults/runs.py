"""The runs of the study, in worker processes."""

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace

from depal.app.faults.verdicts import Verdict, verdict_of
from depal.app.run.job import run_job
from depal.app.run.values import Job
from depal.cell.files import find_cell
from depal.cell.workplace import Settings
from depal.domain import EURO_PALLET, Delivery, DeliveryLine, Gtin, Product, StackedCase
from depal.errors import SettingError, did_you_mean
from depal.geometry import Vector3
from depal.simulation.faults import CATALOGUE, Fault, FaultPlan
from depal.simulation.truth_sight import SightSettings
from depal.studies.sweep import Progress, no_progress, sweep

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


@dataclass(frozen=True, slots=True)
class FaultsAsked:
    """The options of the study.

    Attributes:
        faults: ids with commas between them; "" for all.
        seeds: runs of each.
        seed: the first.
    """

    faults: str = ""
    seeds: int = 3
    seed: int = 0

    @property
    def ids(self) -> tuple[str, ...]:
        """The faults.

        Raises:
            SettingError: the catalogue has none of that name.
        """
        names = [name.strip() for name in self.faults.split(",") if name.strip()]
        for name in names:
            if name not in CATALOGUE:
                exists = did_you_mean(name, CATALOGUE)
                raise SettingError("--faults", f"unknown fault {name!r}", exists=exists)
        return tuple(names or CATALOGUE)


@dataclass(frozen=True, slots=True)
class Ran:
    """One run.

    Attributes:
        fault: which was to strike.
        seed: of the run.
        verdict: on it; None where the run came to no end.
        reason: why it came to none.
    """

    fault: str
    seed: int
    verdict: Verdict | None
    reason: str = ""


def faults_rows(
    asked: FaultsAsked, executor: Executor | None = None, progress: Progress = no_progress
) -> list[Ran]:
    """Every fault with every seed: three boxes, one fault, at a step and in a phase of the seed.

    Raises:
        SettingError: a fault that is not in the catalogue.
    """
    pieces = [
        (name, seed) for name in asked.ids for seed in range(asked.seed, asked.seed + asked.seeds)
    ]
    return sweep(run_one, pieces, executor, progress)


def run_one(piece: tuple[str, int]) -> Ran:
    """One run, in whatever process; a run that breaks down is a result of the study.

    Where the fault found no chance at its step, it takes the first that it gets.
    """
    fault_id, seed = piece
    job = job_of(fault_id, seed)
    try:
        verdict = verdict_of(fault_id, run_job(job))
        if not verdict.struck:
            first = replace(job, faults=FaultPlan((Fault(fault_id),)))
            verdict = verdict_of(fault_id, run_job(first))
    except Exception as error:  # noqa: BLE001 - whatever it is, it is what we report
        return Ran(fault_id, seed, None, f"{type(error).__name__}: {error}")
    return Ran(fault_id, seed, verdict)


def job_of(
    fault_id: str, seed: int, cases: Sequence[tuple[Vector3, Vector3, float]] = CASES
) -> Job:
    """A small delivery in the default cell, and one fault."""
    sight = SightSettings(sigma=0.001, unrecognised=UNRECOGNISED.get(fault_id, SOME))
    return Job(
        find_cell("default"),
        delivery_of(cases),
        (),
        Settings(),
        seed,
        sight,
        faults=FaultPlan.at_random(fault_id, seed, len(cases)),
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
