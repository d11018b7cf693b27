"""Straight moves: a line of the flange at constant orientation."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from depal.cell.files import shipped_cell
from depal.geometry import Pose, Vector3
from depal.motion.kinematics import Kinematics
from depal.motion.planning.straight import JUMP, moved, straight, straight_as_far

ARM = Kinematics(shipped_cell("default").robot)

starts = st.tuples(
    st.floats(-2.5, 2.5),
    st.floats(-1.8, 0.2),
    st.floats(0.2, 2.0),
    st.floats(-3.0, 3.0),
    st.floats(-1.8, 1.8),
    st.floats(-3.0, 3.0),
)
shifts = st.tuples(st.floats(-0.4, 0.4), st.floats(-0.4, 0.4), st.floats(-0.4, 0.4))


@given(starts, shifts)
def test_the_flange_stays_on_the_line_and_keeps_its_orientation(
    q: tuple[float, ...], shift: Vector3
) -> None:
    """Every configuration of the path, evenly spaced."""
    start = np.array(q)
    path = straight_as_far(ARM, start, shift)
    count = max(1, math.ceil(math.dist((0, 0, 0), shift) / 0.01))
    begin = ARM.frames(start)[6]
    assert np.array_equal(path[0], start)
    for row, joints in enumerate(path):
        frame = ARM.frames(joints)[6]
        assert np.allclose(frame[:, :3], begin[:, :3], atol=1e-9)
        assert np.allclose(frame[:, 3], begin[:, 3] + np.array(shift) * row / count, atol=1e-9)


@given(starts, shifts)
def test_axes_neither_jump_nor_leave_their_limits(q: tuple[float, ...], shift: Vector3) -> None:
    """One branch all along."""
    path = straight_as_far(ARM, np.array(q), shift)
    assert (np.abs(np.diff(path, axis=0)) <= JUMP).all()
    assert (path[1:] >= ARM.lower - 1e-8).all()
    assert (path[1:] <= ARM.upper + 1e-8).all()


@given(starts, shifts)
def test_a_whole_move_is_the_move_as_far_as_it_goes(q: tuple[float, ...], shift: Vector3) -> None:
    """All or nothing, and the part."""
    part, whole = straight_as_far(ARM, np.array(q), shift), straight(ARM, np.array(q), shift)
    if whole is None:
        frame = ARM.frames(part[-1])[6]
        end = ARM.frames(np.array(q))[6][:, 3] + np.array(shift)
        assert np.abs(frame[:, 3] - end).max() > 1e-6
    else:
        assert np.array_equal(whole, part)


@given(starts, shifts)
def test_a_move_there_and_back_ends_where_it_began(q: tuple[float, ...], shift: Vector3) -> None:
    """Where nothing is singular on the way."""
    there = straight(ARM, np.array(q), shift)
    assume(there is not None and (np.abs(np.sin(there[:, 4])) > 0.1).all())
    x, y, z = shift
    back = straight(ARM, there[-1], (-x, -y, -z))
    assert back is not None
    assert np.allclose(back[-1], np.array(q), atol=1e-6)


def test_beyond_the_reach_there_is_no_whole_move() -> None:
    """The arm is not 5 m long."""
    start = np.radians((0.0, -60.0, 80.0, 0.0, -20.0, 0.0))
    assert straight(ARM, start, (5.0, 0.0, 0.0)) is None
    part = straight_as_far(ARM, start, (5.0, 0.0, 0.0))
    assert 1 < len(part) < 200


def test_a_pose_is_shifted_in_the_frame_that_it_leads_to() -> None:
    """Whatever its own axes are."""
    pose = Pose.from_yaw((1.0, 2.0, 3.0), 0.7)
    assert moved(pose, (0.1, 0.2, 0.3)).translation == pytest.approx((1.1, 2.2, 3.3))
    assert moved(pose, (0.1, 0.2, 0.3)).rotation == pose.rotation
