"""Algorithm 1 on the ways that are open: the fewest removals, step by step."""

from depal.domain import Approach, BoxId, Detection, Gtin, Perceived, Recognition, Request
from depal.geometry import OrientedBox
from depal.selection import (
    EXACT,
    BlockingGraph,
    Fate,
    Outcome,
    Relation,
    ScoreRule,
    leaf_alone,
    select,
)
from depal.selection.access import (
    BEFORE,
    NO_WAY,
    OVER,
    RESTS,
    AccessGraph,
    Way,
    Ways,
    by_open_ways,
    free_ways,
    standings,
)

RULE = ScoreRule(w=0.5, x_max=3.0)
PRODUCT = Gtin("04006381333931")


def _box(name: str, corner: tuple[float, float, float], height: float = 1.0) -> Detection:
    return Detection(BoxId(name), OrientedBox.from_corner(corner, (1.0, 1.0, height)))


def _graph(boxes: list[Perceived], ways: Ways | None = None, **times: float) -> AccessGraph:
    graph = BlockingGraph(boxes, EXACT)
    codes = standings(graph.prisms, graph.used_slots, EXACT.overlap, EXACT.slack)
    return AccessGraph(graph, ways or free_ways(graph.prisms, EXACT), codes, **times)


ROW: list[Perceived] = [
    _box("front", (0, 0, 0), 2.0),
    _box("under", (1, 0, 0)),
    _box("top", (1, 0, 1)),
    _box("last", (2, 0, 0)),
]


def test_the_boxes_in_the_way_of_a_request_go_first_whatever_their_scores() -> None:
    """Even with a priority of next to nothing."""
    graph = _graph(ROW)
    decision = select(graph, [Request(0.01, box=BoxId("under"))], RULE, leaf_alone)
    assert decision.target == ROW[2]
    assert decision.aims[0].removals == decision.aims[0].least == 1
    assert [verdict.box.id for verdict in decision.verdicts][:2] == ["top", "under"]
    assert decision.verdict(BoxId("front")).fate is Fate.NOT_TRIED


def test_without_requests_the_score_decides_among_what_is_free() -> None:
    """As in the paper, with fewer boxes blocked."""
    graph = _graph(ROW)
    decision = select(graph, [], RULE, leaf_alone)
    assert decision.target in {ROW[0], ROW[2]}
    assert decision.verdict(BoxId("under")).fate is Fate.BLOCKED
    assert "top on top" in decision.verdict(BoxId("under")).reason
    assert graph.ahead(decision.aims) == ()


def test_what_has_no_way_is_refused_and_never_taken() -> None:
    """Though nothing blocks it."""
    ways = Ways.among(range(2), [Way(0, Approach.HORIZONTAL, 0)])
    graph = _graph(ROW[:2], ways)
    wish = Request(1.0, box=BoxId("under"))
    decision = select(graph, [wish], RULE, by_open_ways(graph, leaf_alone))
    assert decision.target == ROW[0]
    assert decision.aims[0].removals == decision.aims[0].least == 1
    alone = _graph(ROW[:1], Ways.among(range(1), []))
    stuck = select(alone, [], RULE, by_open_ways(alone, leaf_alone))
    assert stuck.outcome is Outcome.NOTHING_CAN_BE_GRASPED
    assert stuck.verdict(BoxId("front")).reason == NO_WAY
    assert graph.approaches(BoxId("front")) == {Approach.HORIZONTAL}
    assert graph.approaches(BoxId("nobody")) == frozenset()


def test_a_ring_of_waiting_is_named() -> None:
    """As a cycle of the paper's graph is."""
    ways = Ways.among(range(2), [Way(0, Approach.VERTICAL, 0b10), Way(1, Approach.VERTICAL, 0b01)])
    graph = _graph(ROW[:2], ways)
    decision = select(graph, [], RULE, leaf_alone)
    assert set(decision.cycle) == {"front", "under"}
    assert decision.target is None


def test_each_edge_says_how_the_blocker_stands() -> None:
    """On top, before it, or where the tool has to go."""
    boxes = [*ROW[:3], _box("aside", (1, 1, 0), 3.0)]
    codes = _codes(boxes)
    assert codes[1, 2] == OVER | RESTS
    assert codes[1, 0] == BEFORE
    ways = Ways.among(
        range(4),
        [
            Way(0, Approach.VERTICAL, 0),
            Way(1, Approach.HORIZONTAL, 0b1101),
            Way(2, Approach.VERTICAL, 0b1000),
            Way(3, Approach.VERTICAL, 0),
        ],
    )
    decision = select(_graph(boxes, ways), [], RULE, leaf_alone)
    under = {each.box: each.relation for each in decision.verdict(BoxId("under")).blockers}
    assert under == {
        "front": Relation.OCCLUDES,
        "top": Relation.ON_TOP,
        "aside": Relation.CROWDS,
    }
    assert "aside where the tool has to go" in decision.verdict(BoxId("top")).reason


def _codes(boxes: list[Perceived]) -> dict[tuple[int, int], int]:
    graph = BlockingGraph(boxes, EXACT)
    codes = standings(graph.prisms, graph.used_slots, EXACT.overlap, EXACT.slack)
    return {(a, b): int(codes[a, b]) for a in range(len(boxes)) for b in range(len(boxes))}


def test_a_product_is_served_by_the_case_with_the_fewest_removals() -> None:
    """Not by the one that is higher by h."""
    near = Recognition(BoxId("near"), OrientedBox.from_corner((1, 2, 0), (1, 1, 1)), PRODUCT)
    deep = Recognition(BoxId("deep"), ROW[1].shape, PRODUCT)
    graph = _graph([ROW[0], deep, ROW[2], near])
    decision = select(graph, [Request(0.5, gtin=PRODUCT)], RULE, leaf_alone)
    assert decision.target == near
    assert len(graph) == 4


def test_of_two_requests_the_one_that_is_due_goes_first() -> None:
    """Whatever their order in the list."""
    wishes = [
        Request(0.5, box=BoxId("last"), due=90.0),
        Request(0.5, box=BoxId("under"), due=3.0),
    ]
    graph = _graph(ROW, pace=1.0, now=1.0)
    assert select(graph, wishes, RULE, leaf_alone).target == ROW[2]
    swapped = [Request(0.5, box=BoxId("last"), due=2.0), Request(0.5, box=BoxId("under"), due=90.0)]
    assert select(graph, swapped, RULE, leaf_alone).target == ROW[3]


def test_a_request_for_what_nobody_has_seen_takes_its_turn_among_the_others() -> None:
    """The boxes to remove for it go ahead by its priority and due time."""
    boxes = BlockingGraph(ROW, EXACT)
    codes = standings(boxes.prisms, boxes.used_slots, EXACT.overlap, EXACT.slack)
    ways = free_ways(boxes.prisms, EXACT)
    hidden = Request(0.5, gtin=PRODUCT, due=1.0)
    aim = Request(0.5, box=BoxId("last"), due=90.0)
    pulled = AccessGraph(boxes, ways, codes, sought=[(hidden, 0b0001)])
    decision = select(pulled, [hidden, aim], RULE, leaf_alone)
    assert decision.target == ROW[0]
    assert decision.pending == (hidden,)
    waiting = AccessGraph(boxes, ways, codes)
    assert select(waiting, [hidden, aim], RULE, leaf_alone).target == ROW[3]
