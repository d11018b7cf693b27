"""Where the time of a run goes: each second counts once."""

import asyncio
from collections.abc import Awaitable, Callable

import pytest
from cells_at_work import Cell, gtin
from hypothesis import given
from hypothesis import strategies as st

from depal.cell.charges import Charges
from depal.cell.timekeeping import (
    LOOKING,
    MOTION,
    ORDER,
    PLANNING,
    READING,
    REST,
    SUCTION,
    WAITING,
    Timekeeper,
)
from depal.cell.workplace import Settings
from depal.executive.clock import LoopClock, run_simulated
from depal.ports.fakes import FakeReader

STEP = 0.25
"""Times are multiples of it, so that a grid of this width is exact [s]."""

quarters = st.integers(0, 40)
spans = st.lists(st.tuples(st.sampled_from(ORDER), quarters, quarters), max_size=14)


class HandClock:
    """A clock that is set by hand."""

    def __init__(self) -> None:
        """At zero."""
        self.time = 0.0

    def now(self) -> float:
        """The time [s]."""
        return self.time


def kept(intervals: list[tuple[str, int, int]]) -> Timekeeper:
    """A timekeeper that has seen these, by simulated tasks that run side by side."""
    times = Timekeeper(LoopClock())

    async def one(what: str, start: float, end: float) -> None:
        await asyncio.sleep(start)
        with times.during(what):
            await asyncio.sleep(end - start)

    async def everything() -> None:
        await asyncio.gather(
            *(one(what, STEP * min(a, b), STEP * max(a, b)) for what, a, b in intervals)
        )

    run_simulated(everything())
    return times


@given(spans, st.integers(0, 20))
def test_shares_are_what_a_grid_counts(intervals: list[tuple[str, int, int]], rest: int) -> None:
    """Brute force: every cell of a fine grid goes to the first that went on in it."""
    end = max((max(a, b) for _, a, b in intervals), default=0) + rest
    expected = dict.fromkeys([*ORDER, REST], 0.0)
    for cell in range(end):
        going_on = {what for what, a, b in intervals if min(a, b) <= cell < max(a, b)}
        first = next((what for what in ORDER if what in going_on), REST)
        expected[first] += STEP
    shares = kept(intervals).shares(STEP * end)
    assert shares == pytest.approx(expected)
    assert sum(shares.values()) == pytest.approx(STEP * end)
    assert list(shares) == [*ORDER, REST]


def test_a_time_ends_also_where_what_went_on_breaks_off() -> None:
    """An error ends it like any end."""
    clock = HandClock()
    times = Timekeeper(clock)

    def break_off() -> None:
        with times.during(READING):
            clock.time = 2.0
            raise RuntimeError

    with pytest.raises(RuntimeError):
        break_off()
    assert times.shares(3.0)[READING] == 2.0


def test_the_arms_motion_counts_before_all_and_waiting_last() -> None:
    """What is done in the shadow of a motion costs nothing."""
    assert ORDER == (MOTION, SUCTION, READING, LOOKING, PLANNING, WAITING)


# Charges


def planning(cell: Cell) -> float:
    """Seconds of planning outside the shadow of motions."""
    return cell.works().times.shares(cell.ended)[PLANNING]


def test_only_the_first_plan_is_charged_when_the_arm_moves_ever_after() -> None:
    """A pick and a place for every box; all but the first pick are planned during motions."""
    cell = Cell(3)
    assert planning(cell) == pytest.approx(0.2)
    assert cell.desk.planner.planned == 6
    assert len(cell.desk.planner.spent) == 6


def test_a_dearer_plan_makes_the_run_longer_by_what_is_not_in_the_shadow() -> None:
    """Twice the charge, once more of it; as long as motions last longer than plans."""
    cheap, dear = Cell(3), Cell(3, settings=Settings(charges=Charges(plan=0.4)))
    cheap.works()
    dear.works()
    assert dear.ended - cheap.ended == pytest.approx(0.2, abs=1e-6)


def test_planning_for_a_box_that_was_just_read_is_charged_in_full() -> None:
    """The arm stands with it before the reader: nothing is in the shadow.

    Of the sides that may be shown only the first is planned before the arm moves.
    """
    cell = Cell(1, unknown=(1,), reader=FakeReader([(gtin(1),)]))
    cell.sight.time = 0.0  # else the look after the box has left hides some of it
    pick, show, place = 0.2, 0.2, 0.2
    assert planning(cell) == pytest.approx(pick + show + place)
    assert cell.times.shares(cell.ended)[READING] == pytest.approx(cell.reader.time)


def test_a_charge_is_slept_once_for_each_motion() -> None:
    """And nothing for none."""
    cell = Cell(1)
    took: list[float] = []

    async def charged(motions: int) -> None:
        began = asyncio.get_running_loop().time()
        await cell.desk.planner.charge(motions)
        took.append(asyncio.get_running_loop().time() - began)

    calls: list[Callable[[], Awaitable[None]]] = [lambda n=n: charged(n) for n in (0, 1, 3)]

    async def everything() -> None:
        for call in calls:
            await call()

    run_simulated(everything())
    assert took == pytest.approx([0.0, 0.2, 0.6])
