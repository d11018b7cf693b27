"""A site over a fake cell, with people of every role and something of everything."""

import hashlib
import json
from dataclasses import dataclass, replace
from pathlib import Path

from argon2 import PasswordHasher

from depal.cell.files import shipped_cell
from depal.domain import BoxId, Request
from depal.logistics import shipped_deliveries
from depal.logistics.store import Database, by_storage
from depal.server.api import Exposure
from depal.server.cellstate import CellState, Mode, QuestionState, QueueLine, Solid, StandingBox
from depal.server.events import PER_RUN, Event
from depal.server.fakes import FakeCell
from depal.server.roles import Role
from depal.server.site import Site

PASSWORD = "ten letters at least"  # noqa: S105 - of nobody

PEOPLE = {Role.VIEWER: "vera", Role.OPERATOR: "otto", Role.INTEGRATOR: "ines"}

REACHED = Exposure(frozenset({"testserver"}))
"""By the name that a test client asks for."""

QUICK = PasswordHasher(time_cost=1, memory_cost=8, parallelism=1)
"""Guessing is not what these tests are about."""


class Held:
    """Time and secrets in a test's hand."""

    def __init__(self) -> None:
        """On some day."""
        self.time, self._count = 1_700_000_000.0, 0

    def now(self) -> float:
        """The time that was set."""
        return self.time

    def secret(self, size: int = 32) -> str:
        """Another one each time, the same ones in every test."""
        self._count += 1
        return hashlib.sha256(f"{self._count}".encode()).hexdigest()[: max(size, 12)]


@dataclass
class FakeEvents:
    """A journal of some events."""

    events: tuple[Event, ...] = ()

    @property
    def last(self) -> int:
        """The number of the newest."""
        return self.events[-1].sequence if self.events else 0

    def after(self, sequence: int, limit: int) -> tuple[Event, ...]:
        """Those after a number."""
        return tuple(event for event in self.events if event.sequence > sequence)[:limit]


SOLID = Solid((1.6, 0.0, 0.4), (0.3, 0.2, 0.25), 0.0)

DELIVERY = shipped_deliveries()[0]

LINE = DELIVERY.lines[0]


def site_over(folder: Path, *, busy: bool = True) -> Site:
    """A site in a folder.

    Args:
        folder: for its database.
        busy: whether a delivery is worked on, and another one waits.
    """
    database = Database(f"sqlite:///{folder / 'store.db'}")
    layout = shipped_cell("default")
    cell = FakeCell(layout)
    events = tuple(Event(PER_RUN + n, 1, float(n), "Ticked", {"at": float(n)}) for n in range(1, 6))
    site = Site.over(database, cell, FakeEvents(events), Held(), folder / "runs", QUICK)
    for role, name in PEOPLE.items():
        site.accounts.add(name, role, PASSWORD)
    site.store.seed_places([DELIVERY], by_storage(layout.places, without=layout.aside))
    if busy:
        _work(site, cell)
    return site


def _work(site: Site, cell: FakeCell) -> None:
    for number in range(3):
        site.queue.add(replace(DELIVERY, id=f"d-{number}"), "otto")
    run = site.runs.begin("d-0", "otto")
    site.queue.mark("d-0", "running")
    (site.folder / str(run)).mkdir(parents=True)
    question = QuestionState(
        "1/product/b1/0-1", "Which product is it?", ("this", "that"), "b1", 0.0
    )
    site.questions.asked(run, question)
    line = QueueLine("b1", LINE.product.gtin, "", SOLID, 0.1, 0.0, 0.1, "chosen", "it is free")
    cell.tell(
        CellState(
            mode=Mode.EXECUTE,
            run=run,
            delivery="d-0",
            boxes=20,
            queue=(line,),
            standing=(StandingBox("b2", LINE.product.gtin, "trolley_1/level_1", SOLID),),
            questions=(question,),
        )
    )
    site.requests.add("r-1", Request(0.5, box=BoxId("b1")), by="otto", run=run, due=None)
    site.pictures.put(LINE.product.gtin, "front", b"\xff\xd8\xff\xd9", "ines")


def upload(name: str) -> str:
    """A delivery's document under a name."""
    from depal.server.records.documents import document_of  # noqa: PLC0415

    return json.dumps(document_of(replace(DELIVERY, id=name)))
