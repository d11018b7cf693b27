"""Eqs. (1) and (3) by their tables, and the rule's refusals."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.errors import SettingError
from depal.selection import PAPER_WEIGHTS, PositionWeights, ScoreRule, position_priority
from depal.selection.score import mixed_score, stepped

X_MAX = 2.2


@pytest.mark.parametrize(
    ("centre", "h"),
    [
        ((2.2, 0.0, 0.0), 0.0),
        ((2.2, 0.7, 0.0), 0.1),
        ((2.2, -0.7, 0.0), 0.1),
        ((1.5, 0.0, 0.0), 0.2),
        ((2.2, 0.0, 0.7), 0.4),
        ((1.5, -0.7, 0.7), 0.7),
        ((1.8, 0.35, 1.05), 0.05 + 2 * 0.4 / 7 + 0.6),
    ],
)
def test_h_is_equation_1(centre: tuple[float, float, float], h: float) -> None:
    """|y| / 7 + 2 (x_max - x) / 7 + 4 z / 7."""
    assert position_priority(np.array([centre]), X_MAX)[0] == pytest.approx(h, abs=1e-12)


@pytest.mark.parametrize(
    ("h", "l", "w", "s"),
    [(0.4, 0.0, 0.0, 0.4), (0.4, 0.8, 0.5, 0.6), (0.4, 0.8, 1.0, 0.8), (0.7, 0.2, 0.2, 0.6)],
)
def test_s_is_equation_3(h: float, l: float, w: float, s: float) -> None:  # noqa: E741
    """W l + (1 - w) h."""
    assert mixed_score(np.array([h]), np.array([l]), w)[0] == pytest.approx(s)


def test_other_weights_of_h_can_be_given() -> None:
    """Learnt ones, later."""
    weights = PositionWeights(side=0.5, depth=0.5, height=0.0)
    assert position_priority(np.array([(1.2, -0.4, 9.0)]), X_MAX, weights)[0] == pytest.approx(0.7)


@given(st.floats(0.1, 10), st.floats(0, 1))
def test_scaling_lengths_and_priorities_alike_scales_the_score(scale: float, w: float) -> None:
    """S has the dimension of a length."""
    centres = np.array([(1.5, 0.2, 0.3), (2.0, -0.6, 0.9)])
    pull = np.array([0.0, 0.4])
    small = mixed_score(position_priority(centres, X_MAX), pull, w)
    large = mixed_score(position_priority(scale * centres, scale * X_MAX), scale * pull, w)
    assert large == pytest.approx(scale * small)


def test_scores_a_rounding_apart_are_equal() -> None:
    """Steps of a picometre."""
    steps = stepped(np.array([0.1 + 0.2, 0.3, 0.3 + 1e-11]))
    assert steps[0] == steps[1]
    assert steps[1] < steps[2]


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: ScoreRule(w=1.5, x_max=2.2),
            "w: 1.5 is out of range; expected a number in [0, 1]",
        ),
        (
            lambda: ScoreRule(w=math.nan, x_max=2.2),
            "w: nan is not a number; expected a number in [0, 1]",
        ),
        (
            lambda: ScoreRule(w=0.5, x_max=math.inf),
            "x_max: inf; expected the x of the pallet's far side in m",
        ),
        (
            lambda: PositionWeights(-0.1, 0.5, 0.6),
            "weight side of h: -0.1; expected 0 or more",
        ),
        (
            lambda: PositionWeights(0.5, math.nan, 0.5),
            "weight depth of h: nan; expected 0 or more",
        ),
        (
            lambda: PositionWeights(0.5, 0.5, 0.5),
            "weights of h: their sum is 1.5; expected 1",
        ),
    ],
)
def test_a_rule_out_of_range_is_refused(make: object, message: str) -> None:
    """One clear error each."""
    assert callable(make)
    with pytest.raises(SettingError) as caught:
        make()
    assert str(caught.value) == message


def test_the_papers_weights_are_sevenths() -> None:
    """1/7, 2/7, 4/7."""
    assert PositionWeights(1 / 7, 2 / 7, 4 / 7) == PAPER_WEIGHTS
