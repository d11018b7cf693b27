"""Crash cuts and long shifts: what is run, what is summed up, and what is called met."""

from hypothesis import given
from hypothesis import strategies as st

from depal.app.faults.shift import pallets_for, stacks
from depal.app.light import Count, Kind, LightJob, LightOutcome, Storm, Stormed, storm_report
from depal.app.light.storm import PALLET, at_every_write, at_random, shift_of

WHOLE = LightOutcome(LightJob(10, 7), Count(boxes=10, stored=10), writes={Kind.JOURNAL: 4})


def test_every_write_is_cut_before_and_after_it_and_with_the_power_gone() -> None:
    """Three runs for each write of the journal, each with one cut."""
    jobs = at_every_write(WHOLE)
    assert len({job.cuts for job in jobs}) == len(jobs) == 3 * 4
    assert {job.seed for job in jobs} == {7}


@given(cuts=st.integers(1, 300), seed=st.integers(0, 50))
def test_so_many_cuts_are_made_as_were_asked_for(cuts: int, seed: int) -> None:
    """No more, no fewer, and no run twice."""
    jobs = at_random(cuts, seed, 90.0)
    assert sum(len(job.cuts) for job in jobs) == cuts
    assert len({job.seed for job in jobs}) == len(jobs)
    assert jobs == at_random(cuts, seed, 90.0)


@given(boxes=st.integers(0, 500))
def test_a_shift_has_so_many_boxes(boxes: int) -> None:
    """The last pallet holds what is left."""
    sizes = [job.boxes for job in shift_of(boxes, 0)]
    assert sum(sizes) == boxes
    assert all(0 < size <= PALLET for size in sizes)


@given(boxes=st.integers(1, 2_000))
def test_a_shift_with_physics_has_at_least_so_many_boxes(boxes: int) -> None:
    """And no pallet more than it takes."""
    sizes = [len(each.stack or ()) for each in stacks()]
    numbers = [pallet.number for pallet in pallets_for(boxes, 0)]
    assert sum(sizes[number] for number in numbers[:-1]) < boxes
    assert sum(sizes[number] for number in numbers) >= boxes


def test_a_lost_box_or_a_control_that_loses_nothing_is_no_success() -> None:
    """The referee's word decides, and a referee that never finds anything is none."""
    lost = LightOutcome(LightJob(10, 1), Count(boxes=10, stored=9, lost=1), ("1.0 s: I1: gone",))
    asked = Storm(1, 10)
    assert storm_report(Stormed((WHOLE,), (WHOLE,), (lost,), (WHOLE,)), asked, 1.0).holds
    assert not storm_report(Stormed((lost,), (WHOLE,), (lost,)), asked, 1.0).holds
    assert not storm_report(Stormed((WHOLE,), (lost,), (lost,)), asked, 1.0).holds
    assert not storm_report(Stormed((WHOLE,), (WHOLE,), (WHOLE,)), asked, 1.0).holds
    assert not storm_report(Stormed(shift=(lost,)), asked, 1.0).holds
