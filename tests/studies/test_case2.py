"""Case study 2: b1 is 10th without the request and 8th with it."""

import pytest

from depal.errors import SettingError
from depal.studies.case2 import LAYOUTS, boxes_of, case2, layout_named, run_both


@pytest.mark.parametrize("name", sorted(LAYOUTS))
def test_b1_is_tenth_without_and_eighth_with_the_request(name: str) -> None:
    """In every layout, as in Fig. 10."""
    run = run_both(boxes_of(layout_named(name)), w=0.2, priority=0.2)
    assert run.rank_without == 10
    assert run.rank_with == 8
    assert sorted(run.before) == sorted(run.after) == sorted(box.id for box in run.boxes)


@pytest.mark.parametrize("pitch", [0.18, 0.22, 0.26, 0.30, 0.34])
def test_the_papers_ranks_hold_over_a_range_of_sizes(pitch: float) -> None:
    """5-5 from 18 to 34 cm."""
    layout = type(LAYOUTS["5-5"])((5, 5), pitch)
    run = run_both(boxes_of(layout), w=0.2, priority=0.2)
    assert (run.rank_without, run.rank_with) == (10, 8)


def test_the_ranks_hold_under_jitter() -> None:
    """At least 95 % of the draws, 2 cm on each width and each row's height."""
    for result in case2(("5-5", "3-3-2-2"), draws=150):
        assert result.robust >= 0.95


def test_the_request_lifts_b1_by_w_times_p() -> None:
    """S after minus s before: w p on T(b1), nothing elsewhere."""
    run = run_both(boxes_of(LAYOUTS["5-5"]), w=0.2, priority=0.2)
    lifted = {name for name in run.h if run.s[name] != run.h[name]}
    assert lifted == {"b1", "b8"}
    assert run.s["b1"] - run.h["b1"] == pytest.approx(0.04)


def test_without_weight_the_request_changes_nothing() -> None:
    """W = 0."""
    run = run_both(boxes_of(LAYOUTS["5-5"]), w=0.0, priority=0.2)
    assert run.before == run.after


def test_an_unknown_layout_is_answered_with_what_exists() -> None:
    """Did you mean."""
    with pytest.raises(SettingError) as caught:
        case2(("5-5-5",), draws=0)
    assert str(caught.value) == "layout: unknown layout '5-5-5'; did you mean '5-5'?"
