"""On top of, and in front of: exact, and with tolerances for wrong poses."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from piles import box, cut_piles, loose_piles, slow_edges

from depal.domain import BoxId, Detection
from depal.errors import PileError, SettingError
from depal.geometry import OrientedBox, footprint_overlap, prisms_of
from depal.selection import EXACT, PERCEIVED, Blocker, BlockingGraph, Relation, Tolerances

A, B = BoxId("a"), BoxId("b")


def blockers_of_a(b: Detection, tolerances: Tolerances = EXACT) -> set[Relation]:
    """How b blocks a box of 0.4 m at (1.4, 0, 0)."""
    graph = BlockingGraph([box("a", (1.4, 0, 0), (0.4, 0.4, 0.4)), b], tolerances)
    return {blocker.relation for blocker in graph.blockers(A) if blocker.box == B}


@pytest.mark.parametrize(
    ("low", "expected"),
    [
        ((1.4, 0.0, 0.4), {Relation.ON_TOP}),
        ((1.7, 0.3, 0.4), {Relation.ON_TOP}),
        ((1.4, 0.0, 0.9), {Relation.ON_TOP}),  # above, though not touching
        ((1.0, 0.0, 0.0), {Relation.OCCLUDES}),
        ((0.5, 0.3, 0.3), {Relation.OCCLUDES}),  # in front, though not touching
        ((1.8, 0.0, 0.0), set()),  # behind
        ((1.4, 0.4, 0.0), set()),  # beside
        ((1.0, 0.0, 0.4), set()),  # in front and above: neither seen before nor carried
        ((1.4, 0.4, 0.4), set()),
    ],
)
def test_exact_boxes_block_as_the_paper_says(
    low: tuple[float, float, float], expected: set[Relation]
) -> None:
    """Boxes of equal size around a box."""
    assert blockers_of_a(box("b", low, (0.4, 0.4, 0.4))) == expected


def test_one_box_can_block_in_both_ways() -> None:
    """An L of a pile: on top within the tolerance and in front of it."""
    over = box("b", (1.0, 0.0, 0.385), (0.405, 0.4, 0.4))
    assert blockers_of_a(over, PERCEIVED) == {Relation.OCCLUDES}
    deeper = box("b", (1.0, 0.0, 0.385), (0.415, 0.4, 0.4))
    assert blockers_of_a(deeper, PERCEIVED) == {Relation.ON_TOP | Relation.OCCLUDES}


@pytest.mark.parametrize("sunk", [0.0, 0.01, 0.019])
def test_a_box_that_seems_to_sink_in_still_lies_on_top(sunk: float) -> None:
    """Up to the slack."""
    assert blockers_of_a(box("b", (1.4, 0, 0.4 - sunk), (0.4, 0.4, 0.4)), PERCEIVED) == {
        Relation.ON_TOP
    }


def test_a_neighbour_that_seems_to_overlap_does_not_block() -> None:
    """8 mm into each other sideways, one higher than the other."""
    assert blockers_of_a(box("b", (1.4, 0.392, 0.0), (0.4, 0.4, 0.8)), PERCEIVED) == set()


@pytest.mark.parametrize("degrees", [-5.0, -1.0, 1.0, 5.0])
def test_a_row_of_turned_boxes_keeps_its_order(degrees: float) -> None:
    """A long box right in front of another occludes it, both turned alike."""
    yaw = math.radians(degrees)
    size = (0.2, 0.6, 0.3)
    reach = 0.2 / math.cos(yaw)
    front = Detection(B, OrientedBox.upright((1.5, 0, 0.15), size, yaw))
    back = Detection(A, OrientedBox.upright((1.5 + reach, 0, 0.15), size, yaw))
    graph = BlockingGraph([front, back], EXACT)
    assert graph.blockers(A) == {Blocker(B, Relation.OCCLUDES)}
    assert graph.blockers(B) == frozenset()


@given(cut_piles())
def test_the_graph_of_exact_boxes_is_its_definition(boxes: list[Detection]) -> None:
    """Edge by edge, against the definition written out."""
    graph = BlockingGraph(boxes, EXACT)
    edges = slow_edges(boxes)
    for name, expected in edges.items():
        assert {blocker.box for blocker in graph.blockers(name)} == expected
    assert graph.edges == sum(map(len, edges.values()))


@given(loose_piles())
def test_no_two_boxes_block_each_other_in_one_way(boxes: list[Detection]) -> None:
    """On top of each other, or in front of each other, is impossible."""
    graph = BlockingGraph(boxes)
    for one in boxes:
        for blocker in graph.blockers(one.id):
            for back in graph.blockers(blocker.box):
                assert back.box != one.id or not back.relation & blocker.relation


@given(st.floats(max_value=-1e-9) | st.just(math.nan) | st.just(math.inf))
def test_a_tolerance_must_be_a_length(value: float) -> None:
    """One clear error."""
    with pytest.raises(SettingError, match=r"tolerance overlap: .* expected a length of 0 m"):
        Tolerances(overlap=value, slack=0.0)
    with pytest.raises(SettingError, match=r"tolerance slack: .* expected a length of 0 m"):
        Tolerances(overlap=0.0, slack=value)


@pytest.mark.parametrize("sunk", [0.021, 0.05, 0.1, 0.19])
def test_a_box_that_seems_to_sink_in_deeply_still_lies_on_top(sunk: float) -> None:
    """No wrong pose frees a box that carries another; beyond its centre it is a clash."""
    assert blockers_of_a(box("b", (1.4, 0, 0.4 - sunk), (0.4, 0.4, 0.4)), PERCEIVED) == {
        Relation.ON_TOP
    }


@pytest.mark.parametrize("deep", [0.021, 0.05, 0.1, 0.19])
def test_a_box_that_seems_to_reach_into_the_one_behind_still_occludes_it(deep: float) -> None:
    """The same along x."""
    assert blockers_of_a(box("b", (1.0 + deep, 0, 0), (0.4, 0.4, 0.4)), PERCEIVED) == {
        Relation.OCCLUDES
    }


@given(loose_piles())
def test_boxes_that_reach_into_each_other_are_related_unless_they_stand_side_by_side(
    boxes: list[Detection],
) -> None:
    """Whatever a bad picture says, who lies over whom or before whom is decided somehow."""
    graph = BlockingGraph(boxes)
    prisms = prisms_of([seen.shape for seen in boxes])
    for i, one in enumerate(boxes):
        for j, two in enumerate(boxes[:i]):
            ground = footprint_overlap(prisms, i, j)
            rise = abs(prisms[i, 2] - prisms[j, 2])
            height = prisms[i, 5] + prisms[j, 5] - rise
            if rise > 0 and ground > 0.01 and height <= ground:
                related = {b.box for b in graph.blockers(one.id)} | {
                    b.box for b in graph.blockers(two.id)
                }
                assert {one.id, two.id} & related


@pytest.mark.parametrize(
    ("centre", "size"),
    [
        ((math.nan, 0, 0), (1, 1, 1)),
        ((0, 0, 0), (1, -1, 1)),
        ((0, 0, math.inf), (1, 1, 1)),
        ((0, 0, 0), (0, 1, 1)),
    ],
)
def test_what_has_no_place_or_no_size_is_no_box(
    centre: tuple[float, float, float], size: tuple[float, float, float]
) -> None:
    """Refused when the graph is made, when it comes, and when it moves."""
    bad = Detection(A, OrientedBox.upright(centre, size))
    with pytest.raises(PileError, match=r"box 'a' has centre .* sizes above 0 m"):
        BlockingGraph([bad])
    graph = BlockingGraph([box("a", (5, 5, 0), (0.1, 0.1, 0.1))])
    with pytest.raises(PileError, match=r"box 'a' has centre"):
        graph.move(bad)
    graph.remove(A)
    with pytest.raises(PileError, match=r"box 'a' has centre"):
        graph.add(bad)
    assert len(graph) == 0


def test_boxes_exactly_abreast_do_not_hide_each_other() -> None:
    """However far they seem to reach into each other sideways."""
    graph = BlockingGraph(
        [box("a", (1.4, 0.0, 0.0), (0.4, 1.0, 1.0)), box("b", (1.4, 0.55, 0.0), (0.4, 1.0, 1.0))]
    )
    assert graph.edges == 0
