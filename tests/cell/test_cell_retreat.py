"""The way out of a place from where the arm really rests: straight, whatever the wrist does."""

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st

from depal.cell.files import shipped_cell
from depal.cell.planning.timing import rebased, straight_to_end
from depal.motion.collision.values import Array
from depal.motion.kinematics import Kinematics
from depal.motion.planning.straight import straight

ARM = Kinematics(shipped_cell("default").robot)
LOW = np.array([1.46, -0.45, 0.52, 2.11, 0.13, -2.12])
"""With a box in a trolley, the wrist nearly stretched [rad]."""


def swing(path: Array, end: Array) -> float:
    """How far the flange turns away from the orientation at the end, at the most [rad]."""
    goal = ARM.frames(end)[6][:, :3]
    turns = [np.trace(goal.T @ ARM.frames(q)[6][:, :3]) for q in path]
    return float(np.arccos(np.clip((min(turns) - 1.0) / 2.0, -1.0, 1.0)))


def ways(low: Array, off: float) -> tuple[Array, Array] | None:
    """A planned way out, and where the arm rests so much higher [m]."""
    planned = straight(ARM, low, (0.0, 0.35, 0.0))
    rest = straight(ARM, low, (0.0, 0.0, off), pitch=0.001)
    return None if planned is None or rest is None else (planned, rest[-1])


@given(
    st.lists(st.floats(-0.15, 0.15), min_size=6, max_size=6),
    st.floats(-0.008, 0.02),
)
def test_the_tool_does_not_swing_and_the_end_is_the_planned_one(
    turns: list[float], off: float
) -> None:
    """Near a stretched wrist too."""
    found = ways(LOW + np.array(turns), off)
    assume(found is not None)
    assert found is not None
    planned, rest = found
    path = straight_to_end(ARM, planned, rest)
    assert np.array_equal(path[0], rest)
    assert np.allclose(path[-1], planned[-1], atol=1e-12)
    if not np.array_equal(path, rebased(planned, rest)):
        assert swing(path, planned[-1]) < 1e-2


def test_a_difference_that_fades_out_swings_the_tool() -> None:
    """What a rest 6 mm too high has done: the tool met the side of its trolley."""
    found = ways(LOW, 0.006)
    assert found is not None
    planned, rest = found
    assert swing(rebased(planned, rest), planned[-1]) > 2 * swing(
        straight_to_end(ARM, planned, rest), planned[-1]
    )
