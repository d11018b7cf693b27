"""Why a box was chosen: what is said is what Algorithm 1 does when it is asked again."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from piles import X_MAX, box, cut, cut_piles, cycle_of_four

from depal.domain import BoxId, Detection, Perceived, Request
from depal.errors import PileError
from depal.selection import (
    EXACT,
    BlockingGraph,
    Decision,
    Fate,
    LeafAlone,
    Refused,
    ScoreRule,
    explain,
    leaf_alone,
    select,
)
from depal.selection.counterfactuals import BEYOND, Change, Kind, Side

Chosen = Decision[LeafAlone]


@st.composite
def situations(draw: st.DrawFn) -> tuple[list[Detection], list[Request], float, frozenset[BoxId]]:
    """A pile, requests, w, and boxes that cannot be grasped."""
    boxes = draw(cut_piles(16))
    names = [each.id for each in boxes]
    wanted = draw(st.lists(st.sampled_from(names), max_size=3, unique=True))
    requests = [Request(priority=draw(st.floats(0.01, 1.0)), box=name) for name in wanted]
    refused = draw(st.frozensets(st.sampled_from(names), max_size=2))
    w = draw(st.floats(0.0, 1.0))
    # A grasp that was not tried counts as one that is there.
    verdicts = choose(boxes, requests, w, refused).verdicts
    tried = frozenset(v.box.id for v in verdicts if v.fate is Fate.UNREACHABLE)
    return boxes, requests, w, tried


def choose(
    boxes: list[Detection], requests: list[Request], w: float, refused: frozenset[BoxId]
) -> Chosen:
    """One selection."""

    def grasp(each: Perceived) -> LeafAlone | Refused:
        return Refused("out of reach") if each.id in refused else leaf_alone(each)

    return select(BlockingGraph(boxes, EXACT), requests, ScoreRule(w, X_MAX), grasp)


def changed(
    boxes: list[Detection],
    requests: list[Request],
    w: float,
    refused: frozenset[BoxId],
    change: Change,
) -> BoxId | None:
    """What is chosen after a change, by a selection of its own."""
    value = change.value or 0.0
    value += {None: 0.0, Side.BELOW: -BEYOND, Side.ABOVE: BEYOND}[change.side]
    match change.kind:
        case Kind.W:
            w = value
        case Kind.PRIORITY:
            requests = [
                replace(r, priority=value) if r.wanted == change.subject else r for r in requests
            ]
        case Kind.WITHDRAWN:
            requests = [r for r in requests if r.wanted != change.subject]
        case Kind.WISH:
            name = BoxId(change.subject.removeprefix("box "))
            requests = [*requests, Request(priority=value, box=name)]
        case Kind.REMOVAL:
            gone = change.subject.split(" ", 1)[1].split(", ")
            boxes = [each for each in boxes if each.id not in gone]
    target = choose(boxes, requests, w, refused).target
    return None if target is None else target.id


@given(situations())
@settings(max_examples=25, deadline=None)
def test_each_change_of_the_chosen_box_comes_true(
    situation: tuple[list[Detection], list[Request], float, frozenset[BoxId]],
) -> None:
    """Asked again with the change made, Algorithm 1 chooses the box that was named."""
    decision = choose(*situation)
    told = explain(decision, tolerances=EXACT)
    if told is None:
        assert decision.target is None
        return
    assert decision.target is not None
    assert told.box == decision.target.id
    assert told.fate is Fate.CHOSEN
    for change in told.changes:
        assert change.then != told.box
        assert changed(*situation, change) == change.then, change.text


@given(situations())
@settings(max_examples=25, deadline=None)
def test_nothing_closer_than_a_named_value_changes_the_choice(
    situation: tuple[list[Detection], list[Request], float, frozenset[BoxId]],
) -> None:
    """Between w and the value at which it turns, the choice stays; and where none is named."""
    boxes, requests, w, refused = situation
    told = explain(choose(*situation), tolerances=EXACT)
    if told is None:
        return
    ends = {c.side: c.value or 0.0 for c in told.changes if c.kind is Kind.W}
    low, high = ends.get(Side.BELOW, 0.0), ends.get(Side.ABOVE, 1.0)
    for share in np.linspace(low + 2 * BEYOND, high - 2 * BEYOND, 5).tolist():
        if low < share < high:
            target = choose(boxes, requests, share, refused).target
            assert target is not None
            assert target.id == told.box
    for request in requests:
        ends = {
            c.side: c.value or 0.0
            for c in told.changes
            if c.kind is Kind.PRIORITY and c.subject == request.wanted
        }
        low, high = ends.get(Side.BELOW, 0.0), ends.get(Side.ABOVE, 1.0)
        for p in np.linspace(low + 2 * BEYOND, high - 2 * BEYOND, 4).tolist():
            if low < p < high:
                asked = [replace(r, priority=p) if r is request else r for r in requests]
                target = choose(boxes, asked, w, refused).target
                assert target is not None
                assert target.id == told.box


@given(situations())
@settings(max_examples=20, deadline=None)
def test_each_change_that_would_have_had_another_box_chosen_comes_true(
    situation: tuple[list[Detection], list[Request], float, frozenset[BoxId]],
) -> None:
    """For every box that was not chosen."""
    decision = choose(*situation)
    for verdict in decision.verdicts:
        told = explain(decision, verdict.box.id, EXACT)
        assert told is not None
        if told.fate is Fate.CHOSEN:
            continue
        assert told.rival == (decision.target.id if decision.target else None)
        for change in told.changes:
            assert change.then == told.box
            assert changed(*situation, change) == told.box, change.text


@given(situations())
@settings(max_examples=20, deadline=None)
def test_the_parts_add_up_and_what_must_leave_first_can_leave_in_that_order(
    situation: tuple[list[Detection], list[Request], float, frozenset[BoxId]],
) -> None:
    """Eq. (1) and Eq. (3), and T(b)."""
    boxes = situation[0]
    decision = choose(*situation)
    for verdict in decision.verdicts:
        told = explain(decision, verdict.box.id, EXACT)
        assert told is not None
        parts = told.parts
        assert parts.side + parts.depth + parts.height == pytest.approx(verdict.h, abs=1e-12)
        assert parts.w * parts.l + (1 - parts.w) * parts.h == pytest.approx(verdict.s, abs=1e-12)
        assert bool(parts.pulled_by) == (verdict.l > 0)
        graph = BlockingGraph(boxes, EXACT)
        for name in told.before:
            assert not graph.blockers(name)
            graph.remove(name)
        assert not graph.blockers(told.box)


LOW = box("low", (1.4, 0.0, 0.0), (0.4, 0.3, 0.2))
HIGH = box("high", (1.4, 0.0, 0.2), (0.4, 0.3, 0.2))
ASIDE = box("aside", (1.4, -0.5, 0.0), (0.4, 0.3, 0.7))


def test_the_explanation_in_words() -> None:
    """As a person reads it."""
    wish = Request(priority=0.8, box=LOW.id)
    decision = choose([LOW, HIGH, ASIDE], [wish], 0.5, frozenset())
    told = explain(decision)
    assert told is not None
    assert told.lines == (
        "high: chosen (the best score of all boxes that can be grasped)",
        (
            "s = 0.582 = 0.5 l + 0.5 h; l = 0.800 (request for box low); "
            "h = 0.364: side 0.021, depth 0.171, height 0.171"
        ),
        "0.371 above the runner-up aside",
        "with w below 0.067 aside is chosen",
        "with p of the request for box low below 0.057 aside is chosen",
        "without the request for box low aside is chosen",
        "with a request for box aside, p above 0.743, aside is chosen",
    )
    other = explain(decision, BoxId("low"))
    assert other is not None
    assert other.lines[2:] == (
        "must leave first: high",
        "0.057 below the chosen box high",
        "were box high gone, low is chosen",
    )


def test_a_choice_that_hangs_on_a_box_says_so() -> None:
    """A box that lies on a better one: were it gone, the better one would be free."""
    tower = box("tower", (1.4, 0.5, 0.0), (0.4, 0.3, 0.5))
    flat = box("flat", (1.4, 0.5, 0.5), (0.4, 0.3, 0.05))
    decision = choose([LOW, HIGH, tower, flat], [], 0.0, frozenset([flat.id]))
    told = explain(decision)
    assert told is not None
    assert told.lines[2:] == ("were box flat gone, tower is chosen",)
    lonely = explain(choose([LOW], [], 0.5, frozenset()))
    assert lonely is not None
    assert lonely.lines[-1].startswith("s = ")


def test_nothing_chosen_is_nothing_to_explain_but_each_box_can_be_asked_about() -> None:
    """A cycle of blockers, a refused grasp, an empty pallet."""
    stuck = choose(cycle_of_four(), [], 0.5, frozenset())
    assert explain(stuck) is None
    told = explain(stuck, BoxId("a"), EXACT)
    assert told is not None
    assert told.fate is Fate.IN_CYCLE
    assert set(told.before) == {"b", "c", "d"}
    refused = explain(choose([LOW], [], 0.5, frozenset([LOW.id])), LOW.id)
    assert refused is not None
    assert refused.lines[0] == "low: no reachable grasp (out of reach)"
    assert explain(choose([], [], 0.5, frozenset())) is None
    with pytest.raises(PileError, match="no box 'hgih' was perceived; did you mean 'high'"):
        explain(choose([LOW, HIGH], [], 0.5, frozenset()), BoxId("hgih"))


def test_a_decision_by_another_rule_gets_no_changes() -> None:
    """Where G would have chosen another box, nothing is guessed."""
    decision = choose([LOW, HIGH, ASIDE], [], 0.5, frozenset())
    for other in (replace(decision, target=LOW), replace(decision, by_score=False)):
        told = explain(other)
        assert told is not None
        assert told.changes == ()


def test_where_nothing_is_left_without_a_box_nothing_can_be_grasped() -> None:
    """The words for it."""
    assert Change(Kind.REMOVAL, None, "box a").text == "were box a gone, nothing can be grasped"


def test_an_explanation_of_forty_boxes_is_quick_enough_for_a_screen() -> None:
    """It tells the same twice."""
    boxes = cut(7, 40)
    decision = choose(boxes, [Request(priority=0.7, box=BoxId("b3"))], 0.4, frozenset())
    assert explain(decision, tolerances=EXACT) == explain(decision, tolerances=EXACT)


def test_of_equals_the_one_that_a_request_would_pull_stays_chosen() -> None:
    """Two boxes with one score now: on the side of the chosen one nothing turns."""
    twins = [
        box("left", (1.4, 0.2, 0.0), (0.4, 0.2, 0.2)),
        box("right", (1.4, -0.4, 0.0), (0.4, 0.2, 0.2)),
    ]
    wish = Request(priority=0.5, box=BoxId("left"))
    told = explain(choose(twins, [wish], 0.0, frozenset()))
    assert told is not None
    assert told.box == "left"
    assert told.lead == pytest.approx(0.0)
    assert [change.kind for change in told.changes] == []
    both = [wish, Request(priority=0.5, box=BoxId("right"))]
    tied = explain(choose(twins, both, 0.5, frozenset()))
    assert tied is not None
    for change in tied.changes:
        assert changed(twins, both, 0.5, frozenset(), change) == "right"
