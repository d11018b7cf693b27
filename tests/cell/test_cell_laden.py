"""What unknown surfaces above a box mean: it may carry them."""

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from depal.cell.laden import ENDS, HIGHER, OVER, OWN, is_laden, may_reach_under, raised
from depal.cell.pile import COARSE, HANGING, Deck, props
from depal.domain import BoxId, Detection
from depal.geometry import OrientedBox

SIZE = (0.4, 0.2, 0.2)
BOX = OrientedBox.upright((1.6, 0.0, 0.4), SIZE)
TOP = 0.5


def solid(reach: float, above: float) -> OrientedBox:
    """Behind the box, over its back by `reach`, its top `above` the box's top [m]."""
    return OrientedBox.from_corner((1.8 - reach, -0.1, TOP + above - 0.03), (0.3, 0.2, 0.03))


@given(st.floats(OVER + 0.001, 0.3), st.floats(HIGHER + 0.001, 0.5))
def test_what_reaches_over_a_box_and_is_higher_may_stand_on_it(reach: float, above: float) -> None:
    """However little of it does: a strip at the back carries as well."""
    assert is_laden(BOX, [solid(reach, above)])


@given(st.floats(-0.2, OVER - 0.001), st.floats(-0.2, 0.5))
def test_what_stands_beside_a_box_does_not_stand_on_it(reach: float, above: float) -> None:
    """Flush, with the errors of a depth picture."""
    assert not is_laden(BOX, [solid(reach, above)])


@given(st.floats(-0.2, 0.3), st.floats(-0.2, HIGHER - 0.001))
def test_what_is_not_higher_than_a_box_does_not_stand_on_it(reach: float, above: float) -> None:
    """It is its own top, a bit off, or what it stands beside."""
    assert not is_laden(BOX, [solid(reach, above)])
    assert not is_laden(BOX, [])


@given(st.floats(-0.2, 0.3), st.floats(-0.2, 0.5), st.floats(0.0, 0.2))
def test_what_stands_on_a_box_a_little_higher_may_be_its_own_top(
    reach: float, above: float, room: float
) -> None:
    """A hand keeps clear up to there, all over it (dev-009); what is much higher is another one.

    Of the room that the box may take otherwise nothing is lost.
    """
    assume(min(abs(above - HIGHER), abs(above - OWN), abs(reach - OVER)) > 0.001)
    around = OrientedBox.from_corner((1.38, -0.15, 0.3), (0.44, 0.3, 0.2 + room))
    out = raised(around, BOX, [solid(reach, above)])
    own = reach > OVER and HIGHER < above < OWN
    (least, most), (low, high) = (
        (each.corners.min(axis=0), each.corners.max(axis=0)) for each in (around, out)
    )
    assert low == pytest.approx(least)
    assert high[:2] == pytest.approx(most[:2])
    assert high[2] == pytest.approx(max(most[2], TOP + above) if own else most[2])
    assert raised(around, BOX, []) == around


@given(st.floats(-0.3, 0.3), st.floats(HIGHER + 0.001, 0.5))
def test_what_ends_where_something_higher_begins_may_go_on_below_it(
    reach: float, above: float
) -> None:
    """Of a large box under another one a strip is seen, which looks like a small box."""
    if abs(reach + ENDS) > 0.001:
        assert may_reach_under(BOX, [solid(reach, above)]) == (reach > -ENDS)


@given(st.floats(-0.2, 0.3), st.floats(-0.2, HIGHER - 0.001))
def test_nothing_goes_on_below_what_is_not_higher(reach: float, above: float) -> None:
    """It stands beside."""
    assert not may_reach_under(BOX, [solid(reach, above)])


@given(st.floats(0.0, 0.3), st.floats(0.0, 0.3), st.floats(HIGHER + 0.001, 0.5))
def test_what_may_be_longer_than_it_looks_may_go_on_below_what_stands_farther_off(
    gap: float, longer: float, above: float
) -> None:
    """The strip that is free of a covered box ends before the one on it, in its shadow."""
    if abs(gap - longer - ENDS) > 0.001:
        under = may_reach_under(BOX, [solid(-gap, above)], (longer, 0.0, 0.0))
        assert under == (gap < longer + ENDS)
    assert may_reach_under(BOX, [solid(-gap, above)], (0.0, longer, 0.0)) == (gap < ENDS)


def standing(bottom: float, height: float, name: str = "b1") -> Detection:
    """A box in the middle of the pallet."""
    return Detection(
        BoxId(name), OrientedBox.upright((1.6, 0.0, bottom + height / 2), (0.3, 0.2, height))
    )


@given(st.floats(0.0, 1.2), st.floats(0.08, 0.4), st.floats(0.0, 0.4))
def test_what_hangs_in_the_air_stands_on_something_that_nobody_has_seen(
    gap: float, height: float, lower: float
) -> None:
    """From its bottom down to what was seen below it; a box that is carried tells nothing."""
    deck = Deck(0.144, 0.0)
    below = [standing(deck.height, lower, "b2")] if lower > HANGING else []
    floor = deck.height + (lower if below else 0.0)
    found = props([standing(floor + gap, height), *below], deck)
    if gap < HANGING - 0.001:
        assert found == ()
    elif gap > HANGING + 0.001:
        (prop,) = found
        corners = prop.corners
        assert abs(corners[:, 2].min() - floor) < 1e-9
        assert abs(corners[:, 2].max() - floor - gap) < 1e-9


def test_of_what_reaches_into_what_carries_it_nothing_hangs() -> None:
    """Heights are measured with an error."""
    deck = Deck(0.144, 0.0)
    lower, upper = standing(0.144, 0.3), standing(0.444 - COARSE.level + 0.001, 0.3, "b2")
    assert props([lower, upper], deck) == ()
