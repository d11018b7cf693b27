"""Weights from choices: what was put in comes out, and what is not there is not made up."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from piles import X_MAX, box, cut, cut_piles

from depal.domain import BoxId, Gtin, Recognition, Request
from depal.errors import PileError
from depal.selection import EXACT, PAPER_WEIGHTS, BlockingGraph, ScoreRule, leaf_alone, select
from depal.selection.learning import (
    Choice,
    Choices,
    Departure,
    Estimate,
    Finding,
    Order,
    Unloading,
    draw_departures,
    learn,
    probabilities,
    steps_of,
)
from depal.selection.learning.consistent import agreeing, extremes
from depal.selection.learning.fit import climbed, most_likely
from depal.selection.learning.likelihood import likelihood

PAPER = (PAPER_WEIGHTS.side, PAPER_WEIGHTS.depth, PAPER_WEIGHTS.height)


def theta_of(w: float, weights: tuple[float, float, float], temperature: float) -> np.ndarray:
    """Of a known policy."""
    return np.array([w, *((1 - w) * a for a in weights)]) / temperature


def drawn(seed: int, theta: np.ndarray, count: int, boxes: int = 5) -> list[Choice]:
    """Choices between boxes anywhere, every other time with one that is wanted."""
    rng = np.random.default_rng(seed)
    choices = []
    for number in range(count):
        features = rng.random((boxes, 4)) * (0.0, 0.8, 0.8, 1.0)
        if number % 2:
            features[rng.integers(boxes), 0] = rng.random()
        noise = rng.gumbel(size=boxes)
        choices.append(Choice(features, int(np.argmax(features @ theta + noise))))
    return choices


@st.composite
def sets_of_choices(draw: st.DrawFn) -> Choices:
    """A few choices of a few pallets."""
    seed, count = draw(st.integers(0, 2**32 - 1)), draw(st.integers(2, 12))
    theta = theta_of(0.5, PAPER, draw(st.floats(0.02, 1.0)))
    choices = drawn(seed, theta, count, draw(st.integers(2, 5)))
    return Choices.of([choices[: count // 2], choices[count // 2 :]])


@given(sets_of_choices(), st.integers(0, 2**32 - 1))
@settings(deadline=None, max_examples=30)
def test_the_derivatives_are_those_of_the_likelihood(choices: Choices, seed: int) -> None:
    """Against differences."""
    theta = np.random.default_rng(seed).random(4) * 5
    here, step = likelihood(choices, theta), 1e-5
    for row in range(4):
        nudge = np.eye(4)[row] * step
        more, less = likelihood(choices, theta + nudge), likelihood(choices, theta - nudge)
        slope = (more.value - less.value) / (2 * step)
        assert here.gradient[row] == pytest.approx(slope, abs=1e-5)
        bend = (more.gradient - less.gradient) / (2 * step)
        assert here.information[row] == pytest.approx(-bend, abs=1e-5)
    chances = probabilities(choices, theta)
    assert np.add.reduceat(chances, choices.starts) == pytest.approx(1.0)


@given(sets_of_choices(), st.integers(0, 2**32 - 1))
@settings(deadline=None, max_examples=30)
def test_no_other_weights_are_more_likely(choices: Choices, seed: int) -> None:
    """The maximum is the maximum, and the slope there points out of what is allowed."""
    theta, best = most_likely(choices, 4)
    assert (theta >= 0).all()
    rng = np.random.default_rng(seed)
    for scale in (1e-3, 0.1, 10.0):
        other = np.maximum(theta + scale * rng.normal(size=4), 0.0)
        assert likelihood(choices, other).value <= best.value + 1e-6
    assert (best.gradient <= 1e-3).all()


@given(sets_of_choices())
@settings(deadline=None, max_examples=25)
def test_whatever_is_learned_is_a_policy(choices: Choices) -> None:
    """Weights add up to 1, ends are in order, a value lies in its interval."""
    learned = learn(choices)
    for share in (learned.w, learned.side, learned.depth, learned.height):
        assert 0.0 <= share.low <= share.high <= 1.0
        assert not share.known or share.holds(share.value)
    if learned.weights is not None and learned.side.known:
        total = learned.side.value + learned.depth.value + learned.height.value
        assert total == pytest.approx(1.0)
    assert learned.temperature.low <= learned.temperature.high
    assert learned.log_likelihood >= learned.by_chance - 1e-9
    assert learned.pallets <= 2


def test_a_known_policy_is_recovered() -> None:
    """Each weight within its interval's reach, and the interval is narrow."""
    learned = learn(Choices.of([drawn(3, theta_of(0.6, (0.2, 0.3, 0.5), 0.02), 3000)]))
    assert learned.finding is Finding.ESTIMATED
    assert learned.notes == ()
    for share, true in (
        (learned.w, 0.6),
        (learned.side, 0.2),
        (learned.depth, 0.3),
        (learned.height, 0.5),
        (learned.temperature, 0.02),
    ):
        assert share.value == pytest.approx(true, rel=0.1)
        assert share.low < share.value < share.high < share.low + 0.1


@pytest.mark.slow
def test_intervals_hold_the_truth_as_often_as_they_say() -> None:
    """95 of 100, within what 100 draws can tell."""
    truth = {"w": 0.5, "side": PAPER[0], "depth": PAPER[1], "height": PAPER[2]}
    held = dict.fromkeys([*truth, "temperature"], 0)
    for seed in range(100):
        learned = learn(Choices.of([drawn(seed, theta_of(0.5, PAPER, 0.1), 400)]))
        for name, value in {**truth, "temperature": 0.1}.items():
            held[name] += getattr(learned, name).holds(value)
    assert all(88 <= count <= 100 for count in held.values()), held


def test_without_requests_w_is_unknown_and_the_rest_is_not() -> None:
    """Nothing is made up."""
    theta = theta_of(0.0, PAPER, 0.05)
    choices = [Choice(c.features * (0, 1, 1, 1), c.chosen) for c in drawn(1, theta, 1000)]
    learned = learn(Choices.of([choices]))
    assert not learned.w.known
    assert (learned.w.low, learned.w.high) == (0.0, 1.0)
    assert learned.height.value == pytest.approx(PAPER[2], rel=0.2)
    assert learned.temperature.value == pytest.approx(0.05, rel=0.3)
    assert "w is unknown: no request made a difference" in learned.notes[0]


def test_what_the_boxes_do_not_differ_in_is_named() -> None:
    """A wall of boxes at one depth; and depth that always goes with height."""
    theta = theta_of(0.3, PAPER, 0.05)
    flat = [
        Choice(c.features * (1, 1, 0, 1) + (0, 0, 0.4, 0), c.chosen) for c in drawn(1, theta, 500)
    ]
    learned = learn(Choices.of([flat]))
    assert not learned.depth.known
    assert "to tell the weight of depth" in learned.notes[0]
    assert learned.weights is None
    tied = []
    for choice in drawn(2, theta, 500):
        features = choice.features.copy()
        features[:, 2] = features[:, 3]
        tied.append(Choice(features, choice.chosen))
    assert "to tell the weight of depth from height" in learn(Choices.of([tied])).notes[0]


def test_choices_between_equals_tell_nothing() -> None:
    """And no choices at all."""
    equal = learn(Choices.of([[Choice(np.ones((3, 4)), 1)]]))
    assert equal.finding is Finding.SILENT
    assert equal.by_chance == pytest.approx(-math.log(3))
    assert learn(Choices.of([])).choices == 0
    assert equal.weights is None


def test_a_policy_without_noise_is_known_to_a_region_that_holds_it() -> None:
    """Its temperature is at the lower bound."""
    theta = theta_of(0.5, PAPER, 1e-9)
    learned = learn(Choices.of([drawn(5, theta, 800)]))
    assert learned.finding is Finding.NOISELESS
    for share, true in zip(
        (learned.w, learned.side, learned.depth, learned.height), (0.5, *PAPER), strict=True
    ):
        assert share.low - 1e-9 <= true <= share.high + 1e-9
        assert share.high - share.low < 0.05
        assert share.holds(share.value)
    assert (learned.temperature.value, learned.temperature.low) == (0.0, 0.0)
    assert 0.0 < learned.temperature.high < 0.01
    assert "rule without noise" in learned.notes[0]


def test_few_choices_without_noise_leave_much_open() -> None:
    """One choice: the region is wide; without requests w stays unknown."""
    one = Choice(np.array([[0.0, 0.4, 0.1, 0.2], [0.0, 0.1, 0.2, 0.5]]), 1)
    learned = learn(Choices.of([[one, one]]))
    assert learned.finding in {Finding.NOISELESS, Finding.ESTIMATED}
    assert not learned.w.known
    wide = [c for seed in range(3) for c in drawn(seed, theta_of(0.5, PAPER, 1e-9), 2)]
    region = learn(Choices.of([wide]))
    assert region.finding is Finding.NOISELESS
    assert region.height.high - region.height.low > 0.1


def test_requests_that_are_always_followed_bound_w_from_below() -> None:
    """While the order of the others has noise."""
    choices = drawn(4, np.array([1e4, 2.0, 4.0, 8.0]), 600)
    learned = learn(Choices.of([choices]))
    assert learned.finding is Finding.ONE_SIDED
    assert learned.w.high == pytest.approx(1.0, abs=1e-3)
    assert 0.4 < learned.w.low < 1.0
    assert learned.height.holds(8 / 14)
    assert "their intervals" in learned.notes[0]


def test_weights_that_speak_against_the_choices_rest_at_zero() -> None:
    """A policy that likes low boxes is none of ours: its weight of height is 0, and said so."""
    learned = learn(Choices.of([drawn(6, np.array([10.0, 3.0, 6.0, -5.0]), 800)]))
    assert learned.height.value == 0.0
    assert "the weight of height is at its bound of 0" in learned.notes
    against = learn(Choices.of([drawn(6, np.array([-9.0, -9.0, -9.0, -9.0]), 800)]))
    assert against.temperature.value == math.inf
    assert against.weights is None
    assert against.theta == (0.0, 0.0, 0.0, 0.0)


@given(cut_piles(20), st.integers(0, 2**32 - 1), st.floats(0.0, 1.0))
@settings(deadline=None, max_examples=20)
def test_at_temperature_zero_the_best_box_of_algorithm_1_is_taken(
    boxes: list, seed: int, w: float
) -> None:
    """Step for step, requests that are served included."""
    rule = ScoreRule(w, X_MAX)
    rng = np.random.default_rng(seed)
    names = [each.id for each in boxes]
    wanted = [Request(priority=0.7, box=names[int(rng.integers(len(names)))])]
    departures = draw_departures(Unloading(boxes, wanted, X_MAX, EXACT), rule, 0.0, rng)
    assert len(departures) == len(boxes)
    graph = BlockingGraph(boxes, EXACT)
    for departure in departures:
        decision = select(graph, [r for r in wanted if r.box in graph], rule, leaf_alone)
        assert decision.target is not None
        scores = {v.box.id: v.s for v in decision.verdicts}
        assert scores[departure.box] == pytest.approx(scores[decision.target.id], abs=1e-9)
        graph.remove(departure.box)


def test_an_order_becomes_its_choices() -> None:
    """Forced steps and boxes that were dragged out from below are no choices of the model."""
    boxes = (
        box("low", (1.4, 0.0, 0.0), (0.4, 0.3, 0.2)),
        box("high", (1.4, 0.0, 0.2), (0.4, 0.3, 0.2)),
        box("aside", (1.4, -0.5, 0.0), (0.4, 0.3, 0.7)),
    )
    wish = Request(priority=0.8, box=BoxId("low"), arrived=5.0)
    order = Order(
        "p", boxes, (wish,), (Departure(BoxId("aside"), 1.0), Departure(BoxId("high"), 9.0)), X_MAX
    )
    steps = steps_of(order)
    assert [choice.chosen for choice in steps.choices] == [0]
    assert (steps.forced, steps.blocked) == (1, ())
    early = steps.choices[0].features
    assert early[:, 0].tolist() == [0.0, 0.0]
    assert early[0] == pytest.approx([0.0, 0.35, X_MAX - 1.6, 0.35])
    late = Order("p", boxes, (wish,), (Departure(BoxId("low"), 9.0),), X_MAX)
    assert steps_of(late).blocked == ("low",)
    with pytest.raises(PileError, match="no box 'lwo' is perceived"):
        steps_of(Order("p", boxes, (), (Departure(BoxId("lwo")),), X_MAX))


def test_a_request_counts_until_a_box_has_served_it() -> None:
    """A product request by the first of its cases, the most important first."""
    tea = Gtin("12000900000013")
    boxes = [
        Recognition(BoxId(each.id), each.shape, tea) if each.id in {"b0", "b1"} else each
        for each in cut(3, 6)
    ]
    wishes = [Request(priority=0.4, gtin=tea), Request(priority=0.9, gtin=tea)]
    unloading = Unloading(boxes, wishes, X_MAX, EXACT)
    pulls = []
    while len(unloading):
        takeable, features = unloading.takeable(0.0)
        pulls.append(float(features[:, 0].max()))
        unloading.take(takeable[int(np.argmax(features[:, 0]))].id, 0.0)
    assert pulls[0] == 0.9
    assert pulls == sorted(pulls, reverse=True)
    assert pulls.count(0.0) == sum(pull == 0.0 for pull in pulls)
    assert 0.4 in pulls


def test_pallets_can_be_picked_and_counted_twice() -> None:
    """As a bootstrap does."""
    choices = Choices.of(
        [drawn(1, theta_of(0.5, PAPER, 0.1), 3), [], drawn(2, theta_of(0.5, PAPER, 0.1), 2)]
    )
    twice = choices.at([2, 2, 1])
    assert len(twice) == 4
    assert twice.pallets.tolist() == [0, 0, 1, 1]
    assert twice.features[:5].tolist() == choices.features[15:20].tolist()
    assert len(choices.kept(np.zeros(len(choices.features), np.bool_))) == 0
    assert len(Choices.of([]).kept(np.zeros(0, np.bool_))) == 0


def test_an_estimate_of_nothing_is_open() -> None:
    """From 0 to 1."""
    assert Estimate.unknown().holds(0.5)
    assert not Estimate.unknown().known


def test_a_step_that_is_too_long_is_halved_and_one_downhill_is_none() -> None:
    """Until the likelihood rises."""
    choices = Choices.of([drawn(1, theta_of(0.5, PAPER, 0.1), 50)])
    start = np.ones(4)
    now = likelihood(choices, start)
    higher = climbed(choices, start, now, 1e4 * now.gradient)
    assert higher is not None
    assert higher[1].value > now.value
    best, there = most_likely(choices, 4)
    assert climbed(choices, best, there, np.zeros(4)) is None


def test_where_nothing_differs_no_rule_is_named() -> None:
    """And where no rule agrees there are no extremes."""
    assert agreeing(np.zeros((3, 4))) is None
    one = np.array([[0.0, 1.0, 0.0, 0.0], [0.0, -1.0, 0.0, 0.0]])
    against = np.vstack((one, -np.eye(4)))
    assert agreeing(against) is None
    assert extremes(against, np.eye(4)[1], np.ones(4)) is None
