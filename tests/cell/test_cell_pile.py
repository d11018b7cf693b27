"""What the cell believes stands on the pallet, and what has left it."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.cell.departures import Departure, Departures, Fate
from depal.cell.pile import COARSE, FINE, MISSED, Deck, Pile, settled
from depal.domain import BoxId, Detection, Gtin, Perceived, Recognition
from depal.geometry import OrientedBox
from depal.ports import View


def detection(name: str, x: float = 1.6) -> Detection:
    """A box somewhere."""
    return Detection(BoxId(name), OrientedBox.upright((x, 0.0, 0.5), (0.3, 0.3, 0.3)))


def test_a_box_that_looks_miss_is_remembered_and_then_given_up() -> None:
    """The arm may hide a box for a while."""
    pile = Pile()
    pile.see(View(0.0, (detection("b1"), detection("b2", 2.0))))
    for _ in range(MISSED - 1):
        pile.see(View(1.0, (detection("b1"),)))
        assert [box.id for box in pile.boxes] == ["b1", "b2"]
    pile.see(View(2.0, (detection("b1"),)))
    assert [box.id for box in pile.boxes] == ["b1"]


def test_a_taken_box_does_not_come_back_by_a_late_picture() -> None:
    """The picture may show it in the gripper."""
    pile = Pile()
    pile.see(View(0.0, (detection("b1"),)))
    pile.take(BoxId("b1"))
    pile.see(View(1.0, (detection("b1"),)))
    assert len(pile) == 0
    pile.put_back(detection("b1"))
    assert pile.get(BoxId("b1")) is not None


def test_a_box_that_was_read_stays_recognised() -> None:
    """Though the camera still cannot tell it."""
    pile = Pile()
    pile.see(View(0.0, (detection("b1"),)))
    pile.identify(BoxId("b1"), Gtin("g"))
    pile.see(View(1.0, (detection("b1"),)))
    assert isinstance(pile.get(BoxId("b1")), Recognition)


@given(st.permutations([f"b{n}" for n in range(6)]))
def test_departures_come_in_the_order_of_leaving(order: list[str]) -> None:
    """Whatever the order in which their ends become known; each box ends once."""
    departures = Departures()
    for step, name in enumerate(order):
        departures.leaves(BoxId(name), float(step))
    ends = sorted(order, key=hash)
    for name in [*ends, *ends]:
        departures.ends(Departure(BoxId(name), None, None, None, Fate.STORED, "", 99.0))
    assert [d.box for d in departures.sequence] == order
    assert [d.at for d in departures.sequence] == [float(step) for step in range(len(order))]


@given(
    st.lists(
        st.tuples(st.floats(1.5, 2.1), st.floats(-0.5, 0.5), st.floats(0.2, 1.2)),
        min_size=1,
        max_size=8,
    )
)
def test_a_box_is_never_believed_far_from_where_it_was_seen(
    centres: list[tuple[float, float, float]],
) -> None:
    """Standing level and square corrects errors of the picture, and invents nothing."""
    boxes = [
        Detection(BoxId(f"b{number}"), OrientedBox.upright(centre, (0.3, 0.2, 0.25), 0.01))
        for number, centre in enumerate(centres)
    ]
    for before, after in zip(boxes, settled(boxes, Deck(0.144, 0.0)), strict=True):
        assert after.shape.centre[:2] == before.shape.centre[:2]
        assert abs(after.shape.centre[2] - before.shape.centre[2]) <= FINE.level
        assert after.shape.pose.rotation[1][0] == pytest.approx(0.0)


def test_of_two_things_that_could_carry_a_box_the_nearer_does() -> None:
    """Not the higher one: the cups would stop short of the box."""
    low = Detection(BoxId("low"), OrientedBox.upright((1.6, 0.0, 0.244), (0.3, 0.3, 0.2)))
    high = Detection(BoxId("high"), OrientedBox.upright((1.9, 0.0, 0.250), (0.3, 0.3, 0.212)))
    upon = Detection(BoxId("upon"), OrientedBox.upright((1.75, 0.0, 0.446), (0.4, 0.3, 0.2)))
    *_, after = settled((low, high, upon), Deck(0.144, 0.0))
    assert after.shape.centre[2] == pytest.approx(0.444)


def from_cameras(taken: float, *boxes: Perceived, unsized: frozenset[BoxId] = frozenset()) -> View:
    """What a sight with a memory of its own shows."""
    return View(taken, boxes, remembered=True, unsized=unsized)


def test_a_box_that_only_the_last_look_has_shown_is_fresh() -> None:
    """The first look has nothing older to offer; a sight that does not err is never waited for."""
    pile, exact = Pile(), Pile()
    pile.see(from_cameras(0.0, detection("b1")))
    assert not pile.is_fresh(BoxId("b1"))
    pile.see(from_cameras(1.0, detection("b1"), detection("b2", 2.0)))
    assert [pile.is_fresh(BoxId(name)) for name in ("b1", "b2")] == [False, True]
    pile.see(from_cameras(2.0, detection("b1"), detection("b2", 2.0)))
    assert not pile.is_fresh(BoxId("b2"))
    exact.see(View(0.0, (detection("b1"),)))
    exact.see(View(1.0, (detection("b1"), detection("b2", 2.0))))
    assert not exact.is_fresh(BoxId("b2"))


@given(st.floats(0.011, 0.024), st.sampled_from((-1.0, 1.0)))
def test_only_a_box_without_a_name_is_set_on_what_is_far_from_its_bottom(
    gap: float, side: float
) -> None:
    """What carries a box may be hidden; one with a name is measured well enough to say so."""
    pile = Pile(Deck(0.35 + side * gap, 0.0))
    box = detection("b1")
    pile.see(from_cameras(0.0, box))
    assert pile.boxes[0].shape.centre[2] == pytest.approx(0.5 + side * gap)
    pile.see(from_cameras(1.0, Recognition(box.id, box.shape, Gtin("g"))))
    assert pile.boxes[0].shape.centre[2] == pytest.approx(0.5)


@given(st.floats(-0.78, 0.78), st.floats(-0.5, 0.5))
def test_a_box_without_a_name_stands_square_unless_it_is_clearly_askew(
    askew: float, pallet: float
) -> None:
    """A print tells how its box is turned; edges without one may be a shadow's."""
    pile = Pile(Deck(0.35, pallet))
    shape = OrientedBox.upright((1.6, 0.0, 0.5), (0.3, 0.2, 0.3), pallet + askew)
    box = Detection(BoxId("b1"), shape)
    for seen, slack in ((box, COARSE), (Recognition(box.id, shape, Gtin("g")), FINE)):
        pile.see(from_cameras(0.0, seen))
        expected = pallet + (0.0 if abs(askew) < slack.square else askew)
        rotation = pile.boxes[0].shape.pose.rotation
        assert math.atan2(rotation[1][0], rotation[0][0]) == pytest.approx(expected)


@given(st.floats(-0.024, 0.024))
def test_a_box_whose_height_is_a_guess_is_not_set_on_anything(error: float) -> None:
    """Its top is what was seen; of a box that is known the bottom tells more."""
    pile = Pile(Deck(0.35 + error, 0.0))
    box = detection("b1")  # its bottom is at 0.35 m
    pile.see(from_cameras(0.0, box, unsized=frozenset({box.id})))
    assert pile.boxes[0].shape.centre[2] == pytest.approx(0.5)
    pile.see(from_cameras(1.0, box))
    assert pile.boxes[0].shape.centre[2] == pytest.approx(0.5 + error)
