"""A request that comes during a run counts at the next selection, by the selection's rule."""

import asyncio
import json
from dataclasses import replace
from pathlib import Path

import pytest
from served_runs import Hands, Notes, WorldHere
from tiny_runs import THREE, gtin, tiny

from depal.app.run.record import CHOICES
from depal.app.serve.seeing import Seen
from depal.app.serve.session import Session, Surroundings
from depal.cell.files import shipped_cell
from depal.domain import Request
from depal.executive.clock import LoopClock, run_simulated
from depal.logistics.store import LocalStore, by_storage
from depal.server.cell import Order, Settings
from depal.simulation.cell import build
from depal.simulation.truth_sight import SightSettings

SHARP = SightSettings(sigma=0.001, unrecognised=0.0)


async def run_with(folder: Path, wanted: Request | None, at: float) -> tuple[Session, Notes]:
    """A run of three boxes by requests alone (w = 1); one of them comes after so long [s]."""
    layout, clock, delivery = shipped_cell("default"), LoopClock(), tiny(*THREE)
    cell = build(layout, delivery, clock=clock, sight=SHARP)
    world, notes, store = WorldHere(cell, clock), Notes(), LocalStore()
    assert isinstance(world.deeds, Hands)
    store.seed_places([delivery], by_storage(layout.places, without=layout.aside))
    around = Surroundings(layout, world, store, notes, clock, Seen(world.truth_sight))
    session = Session(Order(1, delivery), around, Settings(w=1.0), folder, lambda: None)
    run = asyncio.create_task(session.run())
    await asyncio.sleep(at)
    if wanted is not None:
        session.add_request("late", replace(wanted, arrived=clock.now()))
    await run
    await session.close()
    return session, notes


def order(session: Session) -> list[str]:
    """The products in the order in which they left."""
    return [str(departure.gtin) for departure in session.wired.work.departures.sequence]


@pytest.mark.slow
@pytest.mark.parametrize("number", [0, 1])
def test_a_request_counts_at_the_next_selection_and_is_served_as_the_rule_says(
    tmp_path: Path, number: int
) -> None:
    """The case that lies on another comes first in any case; then the wanted one, whichever."""
    wanted = Request(1.0, gtin=gtin(number))
    plain, _ = run_simulated(run_with(tmp_path / "plain", None, 0.5))
    asked, notes = run_simulated(run_with(tmp_path / "asked", wanted, 0.5))
    choices = [
        json.loads(line) for line in (tmp_path / "asked" / CHOICES).read_text("utf-8").splitlines()
    ]
    counted = [choice["at"] for choice in choices if choice["requests"]]
    assert counted
    assert all(choice["requests"] for choice in choices if 0.5 < choice["at"] <= counted[0])
    left = order(asked)
    before = left.index(gtin(number))
    assert before <= order(plain).index(gtin(number))
    assert before == (1 if number == 0 else 0)  # case 2 lies on case 0, nothing on case 1
    (wish,) = asked.wired.work.wishes
    assert (wish.key, wish.boxes_before) == ("late", before)
    assert [(key, served) for key, served, _, _ in set(notes.requests)] == [("late", True)]
