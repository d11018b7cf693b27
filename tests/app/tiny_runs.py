"""Runs in physics that take a second: a few cases on the default cell's pallet."""

from dataclasses import replace
from pathlib import Path

from depal.app.run.job import run_job
from depal.app.run.summary import Outcome
from depal.app.run.values import Job
from depal.cell.files import shipped_cell
from depal.cell.workplace import Policy, Settings
from depal.domain import (
    EURO_PALLET,
    Delivery,
    DeliveryLine,
    Gtin,
    Product,
    Request,
    StackedCase,
)
from depal.geometry import Vector3
from depal.simulation.faults import FaultPlan
from depal.simulation.truth_sight import SightSettings

Case = tuple[Vector3, Vector3, float]
"""Corner in the pallet's frame [m], size [m], mass [kg]."""

SHARP = SightSettings(sigma=0.001, unrecognised=0.0)
"""Knows every box, and to a millimetre."""

THREE: tuple[Case, ...] = (
    ((0.30, 0.0, 0.0), (0.28, 0.25, 0.22), 4.0),
    ((0.60, 0.0, 0.0), (0.25, 0.30, 0.20), 6.0),
    ((0.30, 0.0, 0.22), (0.28, 0.25, 0.20), 3.0),
)
"""Two cases side by side at the front, a third on the first."""


def gtin(number: int) -> Gtin:
    """The product of a case by its index."""
    return Gtin(f"1200090000{number:03d}0")


def tiny(*cases: Case) -> Delivery:
    """A delivery of these cases, each of a product of its own."""
    lines = [
        DeliveryLine(Product(gtin(n), f"case {n}", size, mass), 1)
        for n, (_, size, mass) in enumerate(cases)
    ]
    stack = [StackedCase(gtin(n), corner, size) for n, (corner, size, _) in enumerate(cases)]
    return Delivery("tiny", EURO_PALLET, tuple(lines), tuple(stack))


def run(  # noqa: PLR0913 - a run has many sides
    cases: tuple[Case, ...],
    *requests: Request,
    seed: int = 0,
    sight: SightSettings = SHARP,
    cone: bool = True,
    w: float = 0.5,
    policy: Policy = Policy.PAPER,
    guard: bool = False,
    faults: FaultPlan | None = None,
    record: Path | None = None,
) -> Outcome:
    """Empties a pallet of these cases."""
    layout = shipped_cell("default")
    settings = Settings(w=w, policy=policy, guard=guard)
    job = Job(layout, tiny(*cases), requests, settings, seed, sight, cone)
    job = replace(job, faults=faults or FaultPlan(), inspected=faults is not None)
    return run_job(job, record=record)
