"""A box that nobody has seen: what is free is seen, and searching finds it sooner."""

import numpy as np
import pytest

from depal.selection.access import fewest_removals
from depal.studies.hidden import Looks, by_access, by_paper, draw_hidden, hidden_rows
from depal.studies.pallets import GENERATORS


@pytest.mark.parametrize("generator", sorted(GENERATORS))
def test_whatever_can_be_taken_has_been_seen(generator: str) -> None:
    """At every step, so no policy is ever stuck for want of sight."""
    for index in range(3):
        trial = draw_hidden(generator, 4, index)
        if trial is None:
            continue
        looks = Looks.first(trial.prisms)
        assert not looks.seen >> trial.requested & 1
        while free := trial.ways.free(looks.gone):
            assert free & ~looks.seen == 0
            looks.remove(free.bit_length() - 1)
            looks.look()
        assert looks.seen == 0


@pytest.mark.parametrize("generator", ["guillotine", "dropped"])
def test_no_policy_needs_fewer_removals_than_there_are(generator: str) -> None:
    """Of one who knows where the box is."""
    for index in range(3):
        trial = draw_hidden(generator, 6, index)
        if trial is None:
            continue
        plan = fewest_removals(trial.ways, 1 << trial.requested)
        assert plan is not None
        counts = [by_paper(trial), *(by_access(trial, searches=each) for each in (False, True))]
        assert all(count is not None and count >= plan.actions for count in counts)


@pytest.mark.slow
def test_searching_is_better_and_its_belief_is_calibrated() -> None:
    """The issue's figures, on fewer pallets: within three standard errors."""
    rows = hidden_rows(("columns", "dropped"), 15, 2)
    assert [row.policy for row in rows[-3:]] == ["paper", "waits", "searches"]
    paper, waits, searches = rows[-3:]
    assert searches.saved.ci95[0] > 0
    assert searches.actions.mean < waits.actions.mean < paper.actions.mean
    slack = 3 * searches.region.error
    assert 0.75 - slack <= searches.region.mean <= 0.85 + slack
    assert not np.isnan(searches.size.mean)
