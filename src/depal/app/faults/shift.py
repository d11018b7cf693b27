"""A long shift with physics: real deliveries one after the other, faults at published rates."""

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path

from rich.console import RenderableType
from rich.text import Text

from depal.app.faults.verdicts import broken_in
from depal.app.files import Json
from depal.app.reports.report import Report, plain_table, verdict
from depal.app.run.job import run_job
from depal.app.run.values import Job
from depal.cell.files import find_cell
from depal.cell.workplace import Settings
from depal.domain import Delivery
from depal.logistics import shipped_deliveries
from depal.simulation.faults import Fault, FaultPlan, When
from depal.simulation.light import SOAK
from depal.studies.kept import Kept, sweep_kept
from depal.studies.statistics import Share
from depal.studies.sweep import Progress, no_progress

RATES = FaultPlan(
    (
        Fault("G1", When(p=SOAK.missed)),
        Fault("G4", When(p=SOAK.double)),
        Fault("M3", When(p=SOAK.infeasible)),
    )
)
"""Missed picks and double picks at each suction, infeasible ones at each plan of a pick."""

HORIZON = 100_000.0
"""A run that has not ended by then never will [s]."""


@dataclass(frozen=True, slots=True)
class Pallet:
    """One delivery of a shift.

    Attributes:
        number: of the delivery among those that ship with a stack.
        seed: of every random number.
    """

    number: int
    seed: int


@dataclass(frozen=True, slots=True)
class Emptied:
    """What came of it.

    Attributes:
        pallet: which.
        delivery: its name.
        boxes: on it.
        stored: of them.
        lost: of them, by the referee.
        asked: how often a person was asked, exchanges of trolleys left out.
        struck: how many faults did.
        wrong: what was broken, in words; why it came to no end.
    """

    pallet: Pallet
    delivery: str
    boxes: int
    stored: int = 0
    lost: int = 0
    asked: int = 0
    struck: int = 0
    wrong: tuple[str, ...] = ()


def stacks() -> list[Delivery]:
    """The deliveries that ship with a stack."""
    return [delivery for delivery in shipped_deliveries() if delivery.stack]


def pallets_for(boxes: int, seed: int) -> list[Pallet]:
    """Deliveries in turn until there are at least so many boxes."""
    sizes, pallets, there = [len(each.stack or ()) for each in stacks()], list[Pallet](), 0
    while there < boxes:
        number = len(pallets) % len(sizes)
        pallets.append(Pallet(number, seed * 1_000 + len(pallets)))
        there += sizes[number]
    return pallets


def shift_with_physics(
    boxes: int,
    seed: int,
    executor: Executor | None = None,
    progress: Progress = no_progress,
    keep: Path | None = None,
) -> list[Emptied]:
    """Empties pallets with at least so many boxes together; those that `keep` has are not again.

    Raises:
        SettingError: the folder `keep` cannot be used.
    """
    kept = Kept.of(keep, _name, Emptied)
    return sweep_kept(empty, pallets_for(boxes, seed), kept, executor, progress)


def _name(pallet: Pallet) -> str:
    return f"shift-{pallet.number}-{pallet.seed}"


def empty(pallet: Pallet) -> Emptied:
    """Empties one; a run that breaks down is a result of the study."""
    delivery = stacks()[pallet.number]
    settings, cell = Settings(), find_cell("default")
    job = Job(
        cell, delivery, (), settings, pallet.seed, faults=RATES, inspected=True, horizon=HORIZON
    )
    boxes = len(delivery.stack or ())
    try:
        outcome = run_job(job)
    except Exception as error:  # noqa: BLE001 - whatever it is, it is what we report
        reason = f"{type(error).__name__}: {error}"
        return Emptied(pallet, delivery.id, boxes, lost=boxes, wrong=(reason,))
    trolleys = {storage.id for storage in cell.storages}
    asked = sum(each.question.about not in trolleys for each in outcome.questions)
    return Emptied(
        pallet,
        delivery.id,
        boxes,
        outcome.stored,
        outcome.lost,
        asked,
        len(outcome.struck),
        tuple(broken_in(outcome)),
    )


def shift_report(done: Sequence[Emptied], seed: int, seconds: float) -> Report:
    """The report; it holds when nothing is lost and no invariant broken."""
    boxes, stored = sum(each.boxes for each in done), sum(each.stored for each in done)
    lost, struck = sum(each.lost for each in done), sum(each.struck for each in done)
    asked = Share(sum(each.asked for each in done), boxes)
    wrong = [
        f"{each.delivery}, seed {each.pallet.seed}: {line}" for each in done for line in each.wrong
    ]
    heads = ("pallets", "boxes", "faults", "stored", "lost", "asked in 1,000", "")
    table = plain_table("A shift with physics", *heads)
    low, high = (1000 * edge for edge in asked.ci95)
    holds = not lost and not wrong
    table.row(
        str(len(done)),
        str(boxes),
        str(struck),
        str(stored),
        str(lost),
        f"{1000 * asked.value:.1f} ({low:.1f} to {high:.1f})",
        verdict(holds, "met", "missed"),
    )
    shown: list[RenderableType] = [table, *(Text(line, style="red") for line in wrong)]
    fields: dict[str, Json] = {
        "shift_physics": {
            "seed": seed,
            "seconds": seconds,
            "pallets": len(done),
            "boxes": boxes,
            "struck": struck,
            "stored": stored,
            "lost": lost,
            "interventions_per_1000": {"value": 1000 * asked.value, "ci95": [low, high]},
            "wrong": list(wrong),
        }
    }
    return Report(fields, shown, holds=holds)
