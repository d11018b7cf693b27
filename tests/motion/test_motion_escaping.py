"""An arm that rests a little too near to something gets away from it, and from nothing else."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from test_motion_free import BEFORE_PILE, BEFORE_TROLLEY, EMPTY, PLANNER, Floats, free_ones

from depal.motion.collision import Checker, Margins
from depal.motion.planning.escaping import SLIGHT, STEPS, escaped
from depal.motion.planning.free import Effort

FREE = free_ones(EMPTY, np.concatenate((BEFORE_PILE, BEFORE_TROLLEY)))


def beside_something(start: Floats, way: Floats) -> tuple[Floats, Floats] | None:
    """The last free and the first touching configuration on a straight joint line."""
    line = start + np.linspace(0.0, 1.2, 2400)[:, None] * way
    row = EMPTY.first_hit(line)
    return None if row is None or row == 0 else (line[row - 1], line[row])


@given(st.integers(0, len(FREE) - 1), st.lists(st.floats(-1.0, 1.0), min_size=6, max_size=6))
def test_a_hair_too_near_is_got_away_from(number: int, way: list[float]) -> None:
    """By a small turn to where it is free, never deeper in than a little."""
    found = beside_something(FREE[number], np.array(way))
    assume(found is not None)
    assert found is not None
    _, touching = found
    assert not EMPTY.free(touching)
    free = escaped(EMPTY, touching)
    assert free is not None
    assert EMPTY.free(free)
    assert np.abs(free - touching).max() <= max(STEPS)
    near = Margins(*(margin - SLIGHT for margin in EMPTY.case.margins))
    assert EMPTY.with_margins(near).edge_free(touching, free)


def test_a_free_arm_stays_and_one_that_is_deep_in_has_no_way_out() -> None:
    """What really touches is not moved through."""
    start = FREE[0]
    assert escaped(EMPTY, start) is start
    huge: Checker = EMPTY.with_margins(Margins(arm=0.3, tool=0.3, held=0.3, pile=0.3, floor=0.3))
    assert escaped(huge, start) is None


@pytest.mark.parametrize("how", ["quick", "search"])
def test_plans_begin_where_the_arm_stands_and_are_free_from_their_second_corner_on(
    how: str,
) -> None:
    """Before this nothing could be planned from there."""
    start, goals = free_ones(EMPTY, BEFORE_PILE)[0], free_ones(EMPTY, BEFORE_TROLLEY)
    ways = np.concatenate((np.eye(6), -np.eye(6)))
    found = next(each for way in ways if (each := beside_something(start, way)) is not None)
    _, touching = found
    if how == "quick":
        planned = PLANNER.quick(EMPTY, touching, goals, Effort())
    else:
        planned = PLANNER.search(EMPTY, touching, goals, Effort(), level=False)
    assert planned is not None
    assert np.array_equal(planned.path[0], touching)
    assert EMPTY.path_free(planned.path[1:])
