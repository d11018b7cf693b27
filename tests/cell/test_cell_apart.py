"""Of two boxes that are believed in one place one is left out, and the cell goes on."""

from hypothesis import given
from hypothesis import strategies as st

from depal.cell.apart import standing_apart
from depal.cell.pile import Pile
from depal.domain import BoxId, Detection, Gtin, Perceived, Recognition
from depal.geometry import OrientedBox
from depal.ports import View
from depal.selection import BlockingGraph

SIZE = (0.3, 0.2, 0.2)
GTIN = Gtin("00000000000017")

places = st.tuples(st.floats(1.4, 2.0), st.floats(-0.5, 0.5), st.sampled_from((0.1, 0.3, 0.5)))


def box(name: str, at: tuple[float, float, float], *, named: bool = False) -> Perceived:
    """Upright."""
    shape = OrientedBox.upright(at, SIZE)
    return Recognition(BoxId(name), shape, GTIN) if named else Detection(BoxId(name), shape)


def seen(boxes: list[Perceived], hidden: frozenset[BoxId] = frozenset()) -> Pile:
    """By cameras."""
    pile = Pile()
    pile.see(View(0.0, tuple(boxes), remembered=True, hidden=hidden))
    return pile


@given(st.lists(places, min_size=1, max_size=12), st.integers(0, 11))
def test_what_stays_can_stand_in_one_world_and_nothing_is_left_out_for_nothing(
    at: list[tuple[float, float, float]], named: int
) -> None:
    """However wrong the sight is; and again with what was left out there is no such world."""
    boxes = [box(f"b{k:02}", each, named=k == named) for k, each in enumerate(at)]
    kept = standing_apart(seen(boxes))
    assert len(BlockingGraph(kept)) == len(kept) >= 1
    if named < len(boxes):
        assert boxes[named] in kept
    assert standing_apart(seen(list(kept))) == kept


def test_what_the_last_look_has_shown_goes_before_what_it_has_not() -> None:
    """Names alone decide nothing."""
    two = [box("b1", (1.6, 0.0, 0.1)), box("b2", (1.62, 0.0, 0.1))]
    assert [each.id for each in standing_apart(seen(two, frozenset({BoxId("b1")})))] == ["b2"]
    assert [each.id for each in standing_apart(seen(two))] == ["b1"]
