"""The simulated worker does what the answer promises; the referee sees where things are."""

import asyncio

import pytest
from simulated_layouts import PARKED, delivery, layout

from depal.executive.clock import LoopClock, run_simulated
from depal.geometry import Pose
from depal.ports import Question
from depal.simulation import SimulatedCell, build

CELL = layout()
EXCHANGE = Question("q1", "Exchange trolley_1?", ("done", "not now"), "trolley_1")


def a_cell(policy: int = 0) -> SimulatedCell:
    """Two boxes on the pallet; the worker picks the choice of that number."""
    note = delivery(
        ((0.4, 0.2, 0.0), (0.3, 0.3, 0.3), 5.0), ((0.8, 0.4, 0.0), (0.2, 0.2, 0.2), 3.0)
    )
    return build(CELL, note, policy=lambda question: question.choices[policy])


def put_into_trolley(cell: SimulatedCell) -> None:
    """Box 1 stands in the lower level of trolley_1."""
    place = CELL.places[CELL.storages[0].places[0].id]
    cell.world.place_box(1, place.cell_from_place @ Pose((0.3, 0.0, 0.1)))


def test_the_referee_knows_where_every_box_is() -> None:
    """Pallet, place, floor, elsewhere, removed."""
    cell = a_cell()
    assert [truth.where for truth in cell.referee.boxes()] == ["pallet", "pallet"]
    put_into_trolley(cell)
    cell.world.place_box(0, Pose((1.0, -1.0, 0.15)))
    cell.world.advance(1.0)
    assert [truth.where for truth in cell.referee.boxes()] == ["floor", "trolley_1/level_1"]
    assert cell.referee.summary().astray == (0,)
    cell.world.place_box(0, Pose((-1.0, -1.0, 1.0)))
    assert cell.referee.where(0) == "elsewhere"
    assert cell.referee.summary().boxes == {"elsewhere": 1, "trolley_1/level_1": 1}


def test_a_box_on_top_of_a_trolley_is_in_none_of_its_places() -> None:
    """Above the clear height of the highest level."""
    cell = a_cell()
    place = CELL.storages[0].places[1]
    cell.world.place_box(1, place.cell_from_place @ Pose((0.3, 0.0, place.opening[1] + 0.01)))
    assert cell.referee.where(1) == "elsewhere"


def test_an_exchange_takes_the_boxes_away_and_brings_an_empty_trolley() -> None:
    """The bay is empty for a while, and its panels with it."""
    cell = a_cell()
    put_into_trolley(cell)
    panels = cell.world.model.storage_geoms["trolley_1"]
    seen: list[tuple[str | None, bool]] = []

    async def watch() -> None:
        for _ in range(80):
            await asyncio.sleep(1.0)
            there = bool(cell.world.model.mj.geom_contype[panels].any())
            seen.append((cell.bays.trolley("trolley_1"), there))

    async def work() -> tuple[str, float]:
        watcher = asyncio.ensure_future(watch())
        answer = await cell.person.ask(EXCHANGE)
        ended = LoopClock().now()
        await watcher
        return answer, ended

    answer, ended = run_simulated(work())
    assert answer == "done"
    assert 40.0 <= ended <= 60.0
    assert list(dict.fromkeys(seen)) == [("trolley_1", True), (None, False), ("trolley_1#2", True)]
    assert sum(bay is None for bay, _ in seen) in range(29, 32)
    assert cell.referee.where(1) == "removed"
    assert cell.world.removed == [1]


def test_a_worker_who_declines_changes_nothing() -> None:
    """The last choice is the careful one."""
    cell = a_cell(policy=1)
    put_into_trolley(cell)
    assert run_simulated(cell.person.ask(EXCHANGE)) == "not now"
    assert cell.bays.trolley("trolley_1") == "trolley_1"
    assert cell.referee.where(1) == "trolley_1/level_1"


@pytest.mark.parametrize(("about", "expected"), [("b1", "removed"), ("b2", "floor")])
def test_a_box_on_the_floor_is_picked_up_when_it_is_asked_about(about: str, expected: str) -> None:
    """And only that one."""
    cell = a_cell()
    cell.world.place_box(0, Pose((1.0, -1.0, 0.15)))
    run_simulated(cell.person.ask(Question("q2", "What now?", ("on", "leave it"), about)))
    assert cell.referee.where(0) == expected


def test_a_box_that_falls_before_the_worker_comes_is_taken_all_the_same() -> None:
    """Who has seen which one is meant looks for it where it has gone."""
    cell = a_cell()
    where = cell.world.box(0).translation
    question = Question("q3", "Take it?", ("taken", "wait"), "seen_7", at=where)

    async def falls() -> None:
        asked = asyncio.ensure_future(cell.person.ask(question))
        await asyncio.sleep(1.0)
        cell.world.place_box(0, Pose((1.0, -1.0, 0.15)))
        assert await asked == "taken"

    run_simulated(falls())
    assert cell.referee.where(0) == "removed"


def test_boxes_above_one_that_is_taken_away_fall() -> None:
    """Whoever slept on it wakes."""
    note = delivery(
        ((0.4, 0.2, 0.0), (0.3, 0.3, 0.3), 5.0), ((0.45, 0.25, 0.3), (0.2, 0.2, 0.2), 3.0)
    )
    cell = build(CELL, note)
    cell.world.advance(3.0)
    cell.world.place_box(0, Pose((40.0, 0.0, 0.15)))
    cell.world.advance(4.0)
    assert cell.world.box(1).translation[2] == pytest.approx(0.144 + 0.1, abs=0.002)


def test_a_snapshot_is_a_copy_of_where_everything_is() -> None:
    """It does not change when the world goes on."""
    cell = a_cell()
    before = cell.world.snapshot()
    cell.world.place_box(0, Pose((1.0, -1.0, 0.15)))
    after = cell.world.snapshot()
    assert before.arm.shape == (8, 7)
    assert before.boxes.shape == (2, 7)
    assert before.boxes[0, :3] == pytest.approx(CELL_BOX, abs=2e-3)
    assert after.boxes[0, :3] == pytest.approx((1.0, -1.0, 0.15))
    assert cell.arm is not None
    assert cell.world.joints() == pytest.approx(PARKED)


CELL_BOX = (1.4 + 0.35, 0.6 - 0.55, 0.144 + 0.15)
