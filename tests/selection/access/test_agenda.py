"""The order of service: as good as any order of the same requests."""

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.selection.access import Errand, lateness_of, planned
from depal.selection.access.agenda import MOST, by_urgency

errands = st.builds(
    Errand,
    priority=st.floats(0, 1),
    boxes=st.integers(1, (1 << 12) - 1),
    due=st.floats(0, 100),
)


@given(st.lists(errands, max_size=5), st.floats(0.1, 10), st.floats(0, 50))
def test_no_order_of_service_is_less_late(asked: list[Errand], pace: float, now: float) -> None:
    """Compared with every order."""
    agenda = planned(asked, pace, now)
    every = [
        lateness_of(asked, order, pace, now) for order in itertools.permutations(range(len(asked)))
    ]
    assert agenda.exact
    assert sorted(agenda.order) == list(range(len(asked)))
    assert agenda.lateness == pytest.approx(min(every))
    assert agenda.lateness == pytest.approx(lateness_of(asked, agenda.order, pace, now))


@given(st.lists(errands, min_size=MOST + 1, max_size=MOST + 3))
def test_many_requests_are_ordered_in_part_and_that_is_said(asked: list[Errand]) -> None:
    """The most urgent exactly, the others behind them."""
    agenda = planned(asked, 1.0)
    assert not agenda.exact
    assert sorted(agenda.order) == list(range(len(asked)))
    assert agenda.order[MOST:] == tuple(by_urgency(asked, 1.0)[MOST:])
    assert agenda.lateness == pytest.approx(lateness_of(asked, agenda.order, 1.0))


def test_a_request_that_costs_nothing_more_is_served_on_the_way() -> None:
    """Though its priority is lower."""
    big, within = Errand(1.0, 0b111, 0.0), Errand(0.1, 0b001, 0.0)
    assert planned([big, within], 1.0).order == (1, 0)


def test_what_is_due_first_goes_first_where_nothing_else_differs() -> None:
    """By the exact order and by urgency."""
    later, sooner = Errand(0.5, 0b0011, 4.0), Errand(0.5, 0b1100, 2.0)
    assert planned([later, sooner], 1.0).order == (1, 0)
    assert by_urgency([later, sooner], 1.0) == [1, 0]
