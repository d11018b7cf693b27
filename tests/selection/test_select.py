"""Algorithm 1: the right box, and a reason for every other."""

import itertools
import math
from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from piles import X_MAX, box, cut, cut_piles, cycle_of_four, slow_edges, slow_h, slow_reach

from depal.domain import BoxId, Detection, Gtin, Perceived, Recognition, Request
from depal.errors import PileError
from depal.geometry import prisms_of
from depal.selection import (
    EXACT,
    Aim,
    Blocker,
    BlockingGraph,
    Decision,
    Fate,
    LeafAlone,
    Outcome,
    Refused,
    Relation,
    ScoreRule,
    geometric_rank,
    leaf_alone,
    link_prisms,
    position_priority,
    select,
)
from depal.selection.links import NONE
from depal.selection.unload import unload as run

BEANS, RICE = Gtin("12000823098180"), Gtin("12000807013116")


def choose(
    boxes: Sequence[Perceived], requests: Sequence[Request] = (), w: float = 0.5
) -> Decision[LeafAlone]:
    """One selection over exact boxes."""
    return select(BlockingGraph(boxes, EXACT), requests, ScoreRule(w, X_MAX), leaf_alone)


def unload(
    boxes: Sequence[Perceived], requests: Sequence[Request] = (), w: float = 0.5
) -> list[BoxId]:
    """All selections of a pile, until none is possible."""
    graph = BlockingGraph(boxes, EXACT)
    order: list[BoxId] = []
    while True:
        target = select(graph, requests, ScoreRule(w, X_MAX), leaf_alone).target
        if target is None:
            return order
        order.append(target.id)
        graph.remove(target.id)


@st.composite
def requested(draw: st.DrawFn, most: int = 4) -> tuple[list[Detection], list[Request]]:
    """A pile and some of its boxes requested."""
    boxes = draw(cut_piles())
    wanted = draw(st.lists(st.sampled_from(boxes), max_size=most, unique_by=lambda b: b.id))
    return boxes, [Request(priority=draw(st.floats(0.01, 1)), box=seen.id) for seen in wanted]


@given(requested())
def test_l_is_the_maximum_over_the_requests_that_a_box_blocks(
    case: tuple[list[Detection], list[Request]],
) -> None:
    """Eq. (2), by its definition; and Eqs. (1) and (3) beside it."""
    boxes, requests = case
    edges = slow_edges(boxes)
    reach = {request.box: slow_reach(edges, request.box) for request in requests if request.box}
    for verdict in choose(boxes, requests, w=0.3).verdicts:
        pulls = [r.priority for r in requests if r.box and verdict.box.id in reach[r.box]]
        assert verdict.l == max(pulls, default=0.0)
        assert verdict.h == pytest.approx(slow_h(verdict.box), abs=1e-12)
        assert verdict.s == pytest.approx(0.3 * verdict.l + 0.7 * verdict.h, abs=1e-12)


@given(requested())
def test_the_target_is_the_best_scored_leaf(case: tuple[list[Detection], list[Request]]) -> None:
    """Lines 14-22."""
    boxes, requests = case
    decision = choose(boxes, requests)
    assert decision.outcome is Outcome.CHOSEN
    assert decision.target is not None
    leaves = [v for v in decision.verdicts if not v.blockers]
    assert decision.verdict(decision.target.id).s == max(v.s for v in leaves)
    assert decision.grasp == LeafAlone()


@given(requested())
def test_verdicts_come_by_falling_score_and_give_a_reason_each(
    case: tuple[list[Detection], list[Request]],
) -> None:
    """And exactly one box is chosen."""
    boxes, requests = case
    decision = choose(boxes, requests)
    scores = [verdict.s for verdict in decision.verdicts]
    assert all(a >= b - 1e-12 for a, b in itertools.pairwise(scores))
    assert len(decision.verdicts) == len(boxes)
    fates = [verdict.fate for verdict in decision.verdicts]
    assert fates.count(Fate.CHOSEN) == 1
    for verdict in decision.verdicts:
        assert verdict.reason
        assert (verdict.fate is Fate.BLOCKED) == bool(verdict.blockers)


@given(requested(), st.randoms(use_true_random=False))
def test_neither_names_nor_order_change_the_order_of_storing(
    case: tuple[list[Detection], list[Request]], random: object
) -> None:
    """Ties included: the middle box of a symmetrical pile is not decided by its name."""
    boxes, requests = case
    names = {seen.id: BoxId(f"x{hash(seen.id) % 97}-{i}") for i, seen in enumerate(boxes)}
    renamed = [Detection(names[seen.id], seen.shape) for seen in boxes]
    random.shuffle(renamed)  # type: ignore[attr-defined]
    asked = [Request(priority=r.priority, box=names[r.box]) for r in requests if r.box]
    random.shuffle(asked)  # type: ignore[attr-defined]
    assert unload(renamed, asked) == [names[name] for name in unload(boxes, requests)]


def test_where_requests_leave_no_room_h_still_decides() -> None:
    """At w = 1 all that nobody wants scores 0."""
    boxes = cut(11, 25)
    assert unload(boxes, w=1.0) == unload(boxes, w=0.0)


def test_ties_go_higher_then_nearer_then_outward_then_left() -> None:
    """All with the same h."""
    wide = [box(f"y{y}", (1.4, y, 0.0), (0.2, 0.2, 0.2)) for y in (-0.8, 0.6)]
    assert unload(wide) == ["y0.6", "y-0.8"]
    high = box("high", (1.7, -0.1, 0.35), (0.2, 0.2, 0.2))
    near = box("near", (1.0, -0.1, 0.0), (0.2, 0.2, 0.2))
    assert slow_h(high) == pytest.approx(slow_h(near))
    assert unload([near, high]) == ["high", "near"]


@given(cut_piles(), st.floats(0.05, 0.95), st.floats(0.05, 1), st.data())
def test_equal_beta_gives_equal_runs(
    boxes: list[Detection], w: float, priority: float, data: st.DataObject
) -> None:
    """Only beta = w p / (1 - w) counts."""
    beta = w * priority / (1 - w)
    other = data.draw(st.floats(beta / (1 + beta), 0.99))
    assume(beta * (1 - other) / other <= 1)
    name = data.draw(st.sampled_from(boxes)).id
    first = unload(boxes, [Request(priority=priority, box=name)], w)
    second = unload(boxes, [Request(priority=beta * (1 - other) / other, box=name)], other)
    assert first == second


@given(cut_piles(), st.floats(0, 1), st.data())
def test_with_one_request_no_count_rises_when_w_rises(
    boxes: list[Detection], priority: float, data: st.DataObject
) -> None:
    """And none is below |T(r)| - 1."""
    name = data.draw(st.sampled_from(boxes)).id
    low, high = sorted((data.draw(st.floats(0, 1)), data.draw(st.floats(0, 1))))
    request = [Request(priority=priority, box=name)]
    before = unload(boxes, request, low).index(name)
    after = unload(boxes, request, high).index(name)
    assert after <= before
    assert after >= len(slow_reach(slow_edges(boxes), name)) - 1


@given(cut_piles())
def test_everything_is_stored_and_nothing_before_what_lies_on_it(boxes: list[Detection]) -> None:
    """Over the whole run."""
    edges = slow_edges(boxes)
    order = unload(boxes)
    assert sorted(order) == sorted(seen.id for seen in boxes)
    for position, name in enumerate(order):
        assert edges[name] <= set(order[:position])


def test_a_cycle_without_a_leaf_ends_in_its_named_outcome() -> None:
    """The paper's loop would not end."""
    decision = choose(cycle_of_four())
    assert decision.outcome is Outcome.NOTHING_CAN_BE_GRASPED
    assert decision.target is None
    assert decision.cycle == ("d", "a", "b", "c")
    reasons = {v.box.id: (v.fate, v.reason) for v in decision.verdicts}
    chain = "d is blocked by a is blocked by b is blocked by c is blocked by d"
    assert reasons[BoxId("d")] == (Fate.IN_CYCLE, chain)
    assert all(fate is Fate.IN_CYCLE for fate, _ in reasons.values())


def test_nothing_perceived_has_an_outcome_of_its_own() -> None:
    """An empty pallet is not a failure to grasp."""
    decision = choose([])
    assert decision.outcome is Outcome.NOTHING_PERCEIVED
    assert decision.verdicts == ()


def test_boxes_without_a_reachable_grasp_are_passed_over_with_the_reason() -> None:
    """Each is asked for once, by falling score, until one can be grasped."""
    boxes = [box(f"b{i}", (1.4, 0.3 * i - 0.45, 0.0), (0.2, 0.2, 0.2 + 0.2 * i)) for i in range(4)]
    boxes.append(box("under", (1.4, -0.45, -0.1), (0.2, 0.2, 0.1)))
    asked: list[BoxId] = []

    def grasp_for(seen: Perceived) -> str | Refused:
        asked.append(seen.id)
        return Refused("beyond the arm") if seen.id in {"b3", "b2"} else f"suction on {seen.id}"

    decision = select(BlockingGraph(boxes, EXACT), (), ScoreRule(0.5, X_MAX), grasp_for)
    assert asked == ["b3", "b2", "b1"]
    assert decision.grasp == "suction on b1"
    reasons = {v.box.id: (v.fate, v.reason) for v in decision.verdicts}
    assert reasons == {
        "b3": (Fate.UNREACHABLE, "beyond the arm"),
        "b2": (Fate.UNREACHABLE, "beyond the arm"),
        "b1": (Fate.CHOSEN, "the best score of all boxes that can be grasped"),
        "b0": (Fate.NOT_TRIED, "scored lower than b1"),
        "under": (Fate.BLOCKED, "b0 on top"),
    }


def test_when_nothing_is_reachable_every_box_says_why() -> None:
    """The exit that the paper's loop lacks."""
    boxes = [
        box("low", (1.4, 0.0, 0.0), (0.2, 0.2, 0.2)),
        box("high", (1.4, 0.0, 0.2), (0.2, 0.2, 0.2)),
        box("back", (1.6, 0.0, 0.0), (0.2, 0.2, 0.2)),
    ]
    graph = BlockingGraph(boxes, EXACT)
    decision = select(graph, (), ScoreRule(0.5, X_MAX), lambda _: Refused("no pose"))
    assert decision.outcome is Outcome.NOTHING_CAN_BE_GRASPED
    assert decision.outcome.value == "nothing can be grasped"
    assert {v.box.id: v.reason for v in decision.verdicts} == {
        "high": "no pose",
        "low": "high on top",
        "back": "low in front",
    }
    assert decision.verdict(BoxId("back")).blockers == {Blocker(BoxId("low"), Relation.OCCLUDES)}


def test_a_decision_is_not_changed_by_what_happens_later() -> None:
    """It can be printed and saved when the box is long gone."""
    boxes = cut(5, 12)
    graph = BlockingGraph(boxes, EXACT)
    decision = select(graph, (), ScoreRule(0.5, X_MAX), leaf_alone)
    before = decision.verdicts
    assert decision.target is not None
    graph.remove(decision.target.id)
    graph.add(box("new", (1.4, 2.0, 0.0), (0.1, 0.1, 0.1)))
    assert decision.verdicts == before
    with pytest.raises(PileError, match="decision: no box 'new' was perceived"):
        decision.verdict(BoxId("new"))


def tower(gtins: Sequence[Gtin | None]) -> list[Perceived]:
    """Boxes on one another, b0 at the bottom."""
    shapes = [box(f"b{i}", (1.4, 0.0, 0.2 * i), (0.3, 0.3, 0.2)) for i in range(len(gtins))]
    return [
        seen if gtin is None else Recognition(seen.id, seen.shape, gtin)
        for seen, gtin in zip(shapes, gtins, strict=True)
    ]


def test_a_product_request_aims_at_the_case_with_the_fewest_blockers() -> None:
    """And its priority goes to that case's blockers alone."""
    aside = Recognition(BoxId("aside"), box("aside", (1.4, 0.6, 0.0), (0.3, 0.3, 0.2)).shape, RICE)
    boxes = [*tower([BEANS, RICE, None, BEANS, None]), aside]
    wish = Request(priority=0.8, gtin=BEANS)
    decision = choose(boxes, [wish])
    assert decision.aims == (Aim(wish, BoxId("b3"), 1, 1),)
    assert {v.box.id for v in decision.verdicts if v.l > 0} == {"b3", "b4"}


def test_a_product_request_among_equals_is_settled_by_geometry() -> None:
    """Both free: the higher one."""
    low = Recognition(BoxId("low"), box("low", (1.4, 0.6, 0.0), (0.3, 0.3, 0.2)).shape, BEANS)
    high = Recognition(BoxId("high"), box("high", (1.4, 0.0, 0.0), (0.3, 0.3, 0.4)).shape, BEANS)
    for boxes in ([low, high], [high, low]):
        assert choose(boxes, [Request(priority=0.5, gtin=BEANS)]).aims[0].box == "high"


def test_several_product_requests_each_find_their_case() -> None:
    """And a box takes the highest priority of those that it blocks."""
    boxes = tower([BEANS, RICE, None])
    wishes = [Request(priority=0.2, gtin=RICE), Request(priority=0.9, gtin=BEANS)]
    decision = choose(boxes, wishes)
    assert [(aim.box, aim.removals) for aim in decision.aims] == [("b1", 1), ("b0", 2)]
    assert {v.l for v in decision.verdicts} == {0.9}


def test_requests_for_what_nothing_has_seen_wait_and_then_count() -> None:
    """They take effect as soon as the box is perceived, and stop when withdrawn."""
    wish, product = Request(priority=1.0, box=BoxId("b0")), Request(priority=0.5, gtin=RICE)
    boxes = tower([RICE, None, None])
    graph = BlockingGraph(boxes[1:], EXACT)
    rule = ScoreRule(0.5, X_MAX)
    before = select(graph, [wish, product], rule, leaf_alone)
    assert before.pending == (wish, product)
    assert before.aims == ()
    assert all(v.l == 0 for v in before.verdicts)
    graph.add(boxes[0])
    after = select(graph, [wish, product], rule, leaf_alone)
    assert after.pending == ()
    assert all(v.l == 1.0 for v in after.verdicts)
    withdrawn = select(graph, [product], rule, leaf_alone)
    assert all(v.l == 0.5 for v in withdrawn.verdicts)


def test_a_request_can_pull_a_box_forward_and_never_past_its_blockers() -> None:
    """The paper's Fig. 5, in small."""
    front = box("front", (1.4, 0.3, 0.0), (0.2, 0.2, 0.2))
    wanted = box("wanted", (1.6, 0.3, 0.0), (0.2, 0.2, 0.2))
    tall = box("tall", (1.4, -0.3, 0.0), (0.2, 0.2, 0.8))
    assert unload([front, wanted, tall], w=0.9) == ["tall", "front", "wanted"]
    request = [Request(priority=1.0, box=wanted.id)]
    assert unload([front, wanted, tall], request, w=0.9) == ["front", "wanted", "tall"]


@given(cut_piles(), st.floats(0.25, 8))
def test_scaling_the_pile_keeps_the_order(boxes: list[Detection], scale: float) -> None:
    """Lengths and priorities alike; here by a power of two, so that no rounding enters."""
    scale = 2.0 ** round(math.log2(scale))
    larger = [
        Detection(
            seen.id,
            type(seen.shape).upright(
                (
                    scale * seen.shape.centre[0],
                    scale * seen.shape.centre[1],
                    scale * seen.shape.centre[2],
                ),
                (
                    scale * seen.shape.size[0],
                    scale * seen.shape.size[1],
                    scale * seen.shape.size[2],
                ),
            ),
        )
        for seen in boxes
    ]
    graph = BlockingGraph(larger, EXACT)
    order = []
    while target := select(graph, (), ScoreRule(0.0, scale * X_MAX), leaf_alone).target:
        order.append(target.id)
        graph.remove(target.id)
    assert order == unload(boxes, w=0.0)


def test_the_compiled_run_of_a_whole_pallet_is_algorithm_1_step_by_step() -> None:
    """The kernel behind the studies and the function behind the cell choose alike."""
    rng = np.random.default_rng(7)
    for seed in range(20):
        boxes = cut(seed, int(rng.integers(1, 40)))
        wanted = rng.permutation(len(boxes))[:3].astype(np.int32)
        priorities = -np.sort(-rng.random(len(wanted)))
        w = float(rng.random())
        prisms = prisms_of(seen.shape for seen in boxes)
        links, _ = link_prisms(prisms, EXACT)
        order = np.full(len(boxes), NONE, np.int32)
        h = position_priority(prisms, X_MAX)
        rank = geometric_rank(prisms, h)
        stored = run(links, h, rank, wanted, priorities, w, NONE, order)
        requests = [
            Request(priority=float(p), box=boxes[slot].id)
            for slot, p in zip(wanted.tolist(), priorities, strict=True)
        ]
        assert stored == len(boxes)
        assert [boxes[slot].id for slot in order.tolist()] == unload(boxes, requests, w)


def test_the_compiled_run_stops_before_a_box_and_at_a_cycle() -> None:
    """Both ends of its loop."""

    def stored(boxes: list[Detection], until: int) -> int:
        prisms = prisms_of(seen.shape for seen in boxes)
        links, _ = link_prisms(prisms, EXACT)
        none, order = np.zeros(0, np.int32), np.zeros(len(boxes), np.int32)
        h = position_priority(prisms, X_MAX)
        rank = geometric_rank(prisms, h)
        return run(links, h, rank, none, np.zeros(0), 0.5, until, order)

    assert stored([box("a", (1.4, 0, 0), (1, 1, 1))], until=0) == 0
    assert stored([box("a", (1.4, 0, 0), (1, 1, 1))], until=NONE) == 1
    assert stored(cycle_of_four(), until=NONE) == 0
