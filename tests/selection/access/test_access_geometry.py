"""The ways that geometry leaves, on stacks drawn at random and on a bridge."""

from random import Random

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from depal.domain import Approach, BoxId, Detection
from depal.geometry import OrientedBox, prisms_of
from depal.selection import EXACT, BlockingGraph
from depal.selection.access import crowding, fewest_removals, free_ways, masks, members

VERTICAL, HORIZONTAL = Approach.VERTICAL, Approach.HORIZONTAL


def _box(x: float, y: float, z: float, size: tuple[float, float, float]) -> OrientedBox:
    return OrientedBox.from_corner((x, y, z), size)


@st.composite
def grids(draw: st.DrawFn) -> list[OrientedBox]:
    """A packing without gaps: columns of boxes of any heights over a grid of 2 x 2."""
    boxes = []
    for x in range(2):
        for y in range(2):
            z = 0.0
            for height in draw(st.lists(st.integers(1, 3), min_size=1, max_size=3)):
                boxes.append(_box(x, y, z, (1.0, 1.0, float(height))))
                z += height
    return boxes


@given(grids())
def test_without_gaps_side_only_boxes_need_what_the_paper_says(boxes: list[OrientedBox]) -> None:
    """T(b), and never more with both ways."""
    named = [Detection(BoxId(f"b{k}"), box) for k, box in enumerate(boxes)]
    graph = BlockingGraph(named, EXACT)
    only = free_ways(graph.prisms, EXACT, allowed=[(HORIZONTAL,)] * len(boxes))
    both = free_ways(graph.prisms, EXACT)
    for k, box in enumerate(named):
        reachable = graph.reachable(box.id)
        side, any_way = fewest_removals(only, 1 << k), fewest_removals(both, 1 << k)
        assert side is not None
        assert any_way is not None
        assert side.boxes.bit_count() == len(reachable)
        assert any_way.actions <= side.actions


def test_a_box_with_nothing_on_it_leaves_upwards_whatever_stands_before_it() -> None:
    """The paper would wait for the front one."""
    boxes = [_box(0, 0, 0, (1, 1, 1)), _box(1, 0, 0, (1, 1, 1))]
    ways = free_ways(prisms_of(boxes), EXACT)
    assert ways.free() == 0b11
    assert [way.approach for way in ways.of[1]] == [VERTICAL]


@given(grids(), st.randoms(use_true_random=False))
def test_the_order_of_the_boxes_changes_nothing(boxes: list[OrientedBox], chance: Random) -> None:
    """Whoever is named first, the same boxes block the same."""
    order = list(range(len(boxes)))
    chance.shuffle(order)
    ways = free_ways(prisms_of(boxes), EXACT)
    mixed = free_ways(prisms_of(boxes[k] for k in order), EXACT)
    for place, k in enumerate(order):
        one = {(w.approach, frozenset(members(w.blockers))) for w in ways.of[k]}
        other = {
            (w.approach, frozenset(order[b] for b in members(w.blockers))) for w in mixed.of[place]
        }
        assert one == other


def test_a_box_under_a_bridge_leaves_forwards() -> None:
    """What is over it at a distance may stay."""
    low = _box(0, 1, 0, (1, 1, 1))
    piers = [_box(0, 0, 0, (1, 1, 2)), _box(0, 2, 0, (1, 1, 2))]
    bridge = _box(0, 0, 2, (1, 3, 1))
    ways = free_ways(prisms_of([low, *piers, bridge]), EXACT)
    assert ways.of[0][0].approach is HORIZONTAL
    assert ways.free() == 0b1001
    assert not ways.of[1][0].blockers & 1


def test_what_stands_where_the_tool_goes_is_found() -> None:
    """Touching, and reaching in by less than is allowed, do not count."""
    boxes = prisms_of([_box(0, 0, 0, (1, 1, 1)), _box(1, 0, 0, (1, 1, 3))])
    space = prisms_of([_box(0.5, 0.2, 1.5, (1.0, 0.5, 1.0))])
    rows = np.arange(2)
    assert masks(crowding(boxes, rows, space, 0.0)) == [0b10]
    assert masks(crowding(boxes, rows, space, 0.6)) == [0]
    assert masks(crowding(boxes, rows, prisms_of([_box(0, 0, 4, (1, 1, 1))]), 0.0)) == [0]
