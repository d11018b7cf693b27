"""What the cell believes stands on the pallet, and what has left it."""

from hypothesis import given
from hypothesis import strategies as st

from depal.cell.departures import Departure, Departures, Fate
from depal.cell.pile import MISSED, Pile
from depal.domain import BoxId, Detection, Gtin, Recognition
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
