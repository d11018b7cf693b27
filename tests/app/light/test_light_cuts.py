"""A controller that ends anywhere, over a light world: nothing lost, nothing doubled."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.app.light import Cut, Kind, LightJob, LightOutcome, Moment, run_light
from depal.cell.files import shipped_cell
from depal.cell.tasks import read_shipped_tasks
from depal.simulation.light import NO_FAULTS, SOAK, Rates

LAYOUT, TASKS = shipped_cell("default"), read_shipped_tasks()


def ran(
    boxes: int, *cuts: Cut, seed: int = 0, naive: bool = False, rates: Rates = NO_FAULTS
) -> LightOutcome:
    """A run in the default cell."""
    return run_light(LightJob(boxes, seed, rates, cuts, naive), LAYOUT, TASKS)


def holds(outcome: LightOutcome) -> None:
    """Every box is where the books say, once."""
    count = outcome.count
    assert not outcome.wrongs
    assert count.lost == count.doubled == count.misplaced == 0
    total = count.stored + count.aside + count.by_person + count.dropped + count.left
    assert total == count.boxes


def test_a_run_without_cuts_and_faults_stores_everything_and_asks_nobody() -> None:
    """The control."""
    outcome = ran(10)
    holds(outcome)
    assert outcome.count.stored == 10
    assert outcome.asked == outcome.found == ()


def test_the_same_job_gives_the_same_journal() -> None:
    """To the byte."""
    one, other = ran(6, seed=3, rates=SOAK), ran(6, seed=3, rates=SOAK)
    assert one.sha256 == other.sha256


@pytest.mark.parametrize("moment", Moment)
@pytest.mark.parametrize("write", range(2, 8))
def test_a_cut_at_each_page_of_the_first_box_loses_and_doubles_nothing(
    write: int, moment: Moment
) -> None:
    """A box that still hangs when its spot was written gets that spot, not one upon its own."""
    holds(ran(3, Cut(Kind.LEDGER, write, moment)))


@settings(max_examples=25, deadline=None, derandomize=True)
@given(
    st.integers(0, 50),
    st.lists(st.tuples(st.floats(0.0, 40.0), st.booleans()), min_size=1, max_size=4),
)
def test_several_random_cuts_lose_and_double_nothing(
    seed: int, cuts: list[tuple[float, bool]]
) -> None:
    """Some of them in the middle of the reconciling, some with the power gone."""
    at = [Cut(Kind.TIME, round(time, 3), power=power) for time, power in cuts]
    holds(ran(4, *at, seed=seed))


@pytest.mark.parametrize(
    ("seed", "rates", "cuts"),
    [
        # A page that is written before the recovery begins tells of the box in the hand.
        (637, NO_FAULTS, ((27.8975, True), (2.9925, True))),
        # What a first restart has withdrawn is not waited for after a second one.
        (748, SOAK, ((25.8921, False), (10.6449, True), (9.4927, True))),
        # A restart that ends before the arm has left a place leaves word of which.
        (1213, SOAK, ((16.9361, False), (27.117, True), (2.2008, False))),
        # Two boxes that weigh like one: where the code tells, a person takes out what hangs there.
        (996, SOAK, ((17.4993, False), (12.4955, False))),
        (2592, SOAK, ((3.9938, False), (28.7338, True), (21.5746, True))),
        # A worker who is asked where a box is that hangs where it could stand says that it hangs.
        (2464, SOAK, ((8.7272, False), (12.593, False))),
    ],
)
def test_what_storms_have_found_stays_mended(
    seed: int, rates: Rates, cuts: tuple[tuple[float, bool], ...]
) -> None:
    """Runs of ten boxes in which something was lost, doubled or waited for without end."""
    holds(ran(10, *(Cut(Kind.TIME, at, power=power) for at, power in cuts), seed=seed, rates=rates))


def test_the_control_that_runs_everything_again_is_found_out() -> None:
    """At least once: the referee sees what exactly one placement prevents."""
    outcomes = [ran(2, Cut(Kind.LEDGER, write, Moment.AFTER), naive=True) for write in range(2, 8)]
    wrong = [out.count.lost + out.count.doubled + out.count.misplaced for out in outcomes]
    assert sum(wrong) > 0
