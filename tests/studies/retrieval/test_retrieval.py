"""The study of retrieval: limits from SELECTION, a second program, real deliveries."""

import numpy as np
import pytest

from depal.cell.files import find_cell
from depal.logistics import shipped_deliveries
from depal.selection import EXACT, geometric_rank, position_priority
from depal.selection.access import Removal, fewest_removals, free_ways
from depal.studies.case1 import draw_trial
from depal.studies.pallets import GENERATORS, generator_named
from depal.studies.retrieval import (
    StackPiece,
    checked,
    random_rows,
    real_rows,
    stack_rows,
)
from depal.studies.retrieval.referee import least_in_line
from depal.studies.retrieval.runs import by_access, carried_out

LIMITS = {0.0: 3.29, 0.25: 4.78, 0.5: 5.77, 0.75: 6.55, 1.0: 7.16}
"""Of `guillotine` pallets by the share of side-only boxes (SELECTION, "Beyond the paper")."""


@pytest.mark.slow
def test_access_is_at_the_limits_and_the_paper_is_where_table_1_has_it() -> None:
    """Within three standard errors of SELECTION's figures."""
    rows = random_rows("guillotine", 1_000, seed=3)
    for row in rows:
        slack = 3 * row.actions.error
        if row.policy == "access":
            assert row.gap.mean == 0
            assert row.actions.mean <= LIMITS[row.side_only] + 0.2 + slack
        else:
            assert abs(row.actions.mean - 7.31) <= 0.2 + slack
            assert row.gap.mean <= 0.3
        assert row.never == row.unproven == 0


@pytest.mark.slow
def test_another_program_proves_the_same_minimum_where_ways_leave_a_choice() -> None:
    """It knows nothing of closures and cuts."""
    found = checked(("dropped", 11, 60))
    assert found.equal == found.compared == 60
    assert found.chosen > 0


@pytest.mark.parametrize("generator", sorted(GENERATORS))
def test_planning_anew_before_every_step_takes_no_step_more(generator: str) -> None:
    """Following one plan and making a new one each time are equal."""
    for index in range(5):
        trial = draw_trial(generator_named(generator), 5, index)
        prisms = trial.pallet.prisms
        ways = free_ways(prisms, EXACT)
        rank = geometric_rank(prisms, position_priority(prisms, trial.pallet.x_max)).tolist()
        whole = by_access(ways, trial.requested, rank)
        steps, left = 0, ways
        while True:
            plan = fewest_removals(left, 1 << trial.requested)
            assert isinstance(plan, Removal)
            first = carried_out(left, plan, rank)[0]
            if first == trial.requested:
                break
            left, steps = left.without(1 << first), steps + 1
        assert steps == whole.actions == whole.least == least_in_line(ways, trial.requested)


def test_on_real_stacks_access_is_never_above_the_paper() -> None:
    """Request by request, with and without the tool."""
    deliveries = shipped_deliveries()[:2]
    layout = find_cell("default")
    for place in (None, layout):
        found = [stack_rows(StackPiece(delivery, place)) for delivery in deliveries]
        assert all(stack.above == 0 for stack, _ in found)
        paper, access = real_rows(found)
        assert access.actions.mean < paper.actions.mean
        assert paper.clearance == (place is not None)
        assert not np.isnan(paper.actions.mean)


@pytest.mark.slow
def test_in_the_cell_both_policies_face_the_same_tool() -> None:
    """And the tool's extent never makes it easier."""
    paper, access = random_rows("guillotine", 4, 0, (0.0,), find_cell("default"))
    assert access.gap.mean == 0
    assert access.actions.mean <= paper.actions.mean
    free = random_rows("guillotine", 4, 0, (0.0,))[1]
    assert free.actions.mean <= access.actions.mean
