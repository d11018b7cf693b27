"""Forward and inverse kinematics: closed form, all branches, within the limits."""

import math

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.domain import JOINT_AXES, ArmGeometry, JointLimits, Joints, Robot
from depal.errors import CellError
from depal.geometry import Pose
from depal.motion.kinematics import Kinematics, rows_of

KR60 = ArmGeometry(0.35, -0.145, 0.0, 0.815, 0.85, 0.82, 0.17)
SMALL = ArmGeometry(0.0, 0.1, 0.0, 0.4, 0.45, 0.42, 0.08)
STRAIGHT_ELBOW = ArmGeometry(0.2, 0.0, 0.0, 0.6, 0.7, 0.7, 0.1)
WIDE = math.radians(350)


def an_arm(geometry: ArmGeometry, limits: tuple[Joints, Joints] | None = None) -> Robot:
    """An arm whose axes turn nearly a whole turn either way, or as far as is said."""
    lower, upper = limits or ((-WIDE,) * 6, (WIDE,) * 6)
    speeds: Joints = (1.0,) * 6
    return Robot("arm", geometry, JointLimits(lower, upper, speeds, speeds), 60.0, (), (), lower)


def turn(axis: tuple[float, float, float], angle: float) -> npt.NDArray[np.float64]:
    """The rotation about an axis (Rodrigues), independent of the code under test."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    rotation: npt.NDArray[np.float64] = (
        np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    )
    return rotation


def composed(geometry: ArmGeometry, q: Joints) -> npt.NDArray[np.float64]:
    """The flange's pose by multiplying origins and turns, (4, 4)."""
    pose = np.eye(4)
    for k, origin in enumerate(geometry.joint_origins):
        step = np.eye(4)
        step[:3, 3] = origin
        if k < 6:
            step[:3, :3] = turn(JOINT_AXES[k], q[k])
        pose = pose @ step
    return pose


geometries = st.sampled_from([KR60, SMALL, STRAIGHT_ELBOW]) | st.builds(
    ArmGeometry,
    a1=st.floats(-0.1, 0.6),
    a2=st.floats(-0.3, 0.3),
    b=st.just(0.0),
    c1=st.floats(0.2, 1.2),
    c2=st.floats(0.3, 1.4),
    c3=st.floats(0.3, 1.4),
    c4=st.floats(0.0, 0.4),
)
angles = st.floats(-math.pi, math.pi) | st.sampled_from([0.0, math.pi / 2, -math.pi / 2, math.pi])
postures = st.tuples(angles, angles, angles, angles, angles, angles)


@given(geometries, postures)
def test_the_flange_is_where_origins_and_axes_put_it(geometry: ArmGeometry, q: Joints) -> None:
    """Against origins and turns multiplied one by one."""
    frame = Kinematics(an_arm(geometry)).frames(q)[6]
    assert np.allclose(frame, composed(geometry, q)[:3], atol=1e-12)


@given(geometries, postures)
def test_every_solution_brings_the_flange_to_its_pose(geometry: ArmGeometry, q: Joints) -> None:
    """FK(IK(pose)) = pose for arms of any size."""
    kinematics = Kinematics(an_arm(geometry))
    wanted = rows_of(kinematics.flange(q))
    for solution in kinematics.solve(kinematics.flange(q), q):
        off = np.abs(kinematics.frames(solution)[6] - wanted).max()
        assert off < 1e-7 if wrist_on_axis_2(kinematics, q) < 1e-3 else off < 1e-11


def wrist_on_axis_2(kinematics: Kinematics, q: Joints) -> float:
    """How far the wrist's centre is from axis 2 [m]: there the upper arm may turn at will."""
    frames = kinematics.frames(q)
    return float(np.linalg.norm(frames[4, :, 3] - frames[1, :, 3]))


@given(postures)
def test_a_posture_is_among_the_solutions_of_its_pose(q: Joints) -> None:
    """IK(FK(q)) holds q."""
    kinematics = Kinematics(an_arm(KR60))
    regular = abs(math.sin(q[4])) > 1e-4 and not shoulder_above_wrist(kinematics, q)
    solutions = kinematics.solve(kinematics.flange(q), q)
    assert len(solutions) > 0
    if regular and not stretched(q):
        assert np.abs(solutions - np.array(q)).max(axis=1).min() < 1e-6


def shoulder_above_wrist(kinematics: Kinematics, q: Joints) -> bool:
    """Whether the wrist's centre is next to axis 1, which may then turn at will."""
    wrist = kinematics.frames(q)[4, :, 3]
    return bool(np.hypot(wrist[0], wrist[1]) < 1e-4)


def stretched(q: Joints) -> bool:
    """Whether upper arm and forearm are in line, where two branches meet."""
    inline = math.atan2(KR60.a2, KR60.c3)
    return abs(math.sin(q[2] + inline)) < 1e-4


@given(postures, st.integers(0, 2**31))
def test_branches_are_distinct_and_eight_at_most(q: Joints, seed: int) -> None:
    """Two turns of the base, two elbows, two wrists."""
    kinematics = Kinematics(an_arm(KR60))
    near = np.random.default_rng(seed).uniform(-math.pi, math.pi, 6)
    solutions = kinematics.solve(kinematics.flange(q), near)
    assert 1 <= len(solutions) <= 8
    if abs(math.sin(q[4])) > 1e-4 and not stretched(q):
        apart = np.abs(solutions[:, None] - solutions[None, :]).max(axis=2)
        assert (apart + np.eye(len(solutions)) > 1e-6).all()


@given(postures, postures)
def test_of_all_turns_the_one_nearest_to_the_reference_is_taken(q: Joints, near: Joints) -> None:
    """Axes that turn more than once."""
    kinematics = Kinematics(an_arm(KR60))
    for solution in kinematics.solve(kinematics.flange(q), near):
        for axis in range(6):
            others = [solution[axis] + 2 * math.pi * turns for turns in (-1, 1)]
            allowed = [other for other in others if abs(other) <= WIDE]
            best = abs(solution[axis] - near[axis])
            assert all(best <= abs(other - near[axis]) + 1e-9 for other in allowed)


def test_solutions_beyond_a_limit_are_left_out() -> None:
    """A branch is lost where one axis is."""
    q = (0.3, -0.8, 1.1, 0.2, 0.6, -0.4)
    all_of_them = Kinematics(an_arm(KR60)).solve(Kinematics(an_arm(KR60)).flange(q), q)
    lower: Joints = (-WIDE, -WIDE, 0.0, -WIDE, -WIDE, -WIDE)
    upper: Joints = (WIDE, WIDE, 3.0, WIDE, WIDE, WIDE)
    limited = Kinematics(an_arm(KR60, (lower, upper)))
    kept = limited.solve(limited.flange(q), q)
    assert 0 < len(kept) < len(all_of_them)
    assert (kept[:, 2] >= 0.0).all()


def test_a_pose_out_of_reach_has_no_solution() -> None:
    """Too far away."""
    assert Kinematics(an_arm(KR60)).solve(Pose((4.0, 0.0, 1.0))).shape == (0, 6)


def test_a_stretched_arm_is_in_reach() -> None:
    """Where rounding could say otherwise."""
    kinematics = Kinematics(an_arm(STRAIGHT_ELBOW))
    assert len(kinematics.solve(kinematics.flange((0.1, -0.3, 0.0, 0.0, 0.5, 0.0)))) > 0


@given(
    st.floats(-3.0, 3.0),
    st.floats(-3.0, 3.0),
    st.sampled_from([0.0, 1e-13, 1e-11, 1e-9, 1e-7, 1e-4]),
)
def test_a_singular_wrist_keeps_axis_4_where_it_was_and_reaches_the_pose(
    q4: float, q6: float, bend: float
) -> None:
    """At and near q5 = 0."""
    kinematics = Kinematics(an_arm(KR60))
    q: Joints = (0.2, -0.9, 1.0, q4, bend, q6)
    pose = kinematics.flange(q)
    solutions = kinematics.solve(pose, q)
    offs = [np.abs(kinematics.frames(row)[6] - rows_of(pose)).max() for row in solutions]
    assert max(offs) < 1e-11
    if bend < 1e-12:
        assert np.abs(solutions - np.array(q)).max(axis=1).min() < 1e-6


@given(geometries, postures)
def test_the_jacobian_is_the_derivative_of_the_pose(geometry: ArmGeometry, q: Joints) -> None:
    """Against central differences."""
    kinematics = Kinematics(an_arm(geometry))
    jacobian, small = kinematics.jacobian(q), 1e-6
    frame = kinematics.frames(q)[6]
    for axis in range(6):
        ahead, behind = np.array(q), np.array(q)
        ahead[axis] += small
        behind[axis] -= small
        after, before = kinematics.frames(ahead)[6], kinematics.frames(behind)[6]
        assert np.allclose(
            jacobian[:3, axis], (after[:, 3] - before[:, 3]) / (2 * small), atol=1e-8
        )
        spin = (after[:, :3] - before[:, :3]) / (2 * small) @ frame[:, :3].T
        assert np.allclose(jacobian[3:, axis], (spin[2, 1], spin[0, 2], spin[1, 0]), atol=1e-8)


def test_an_arm_with_a_sideways_offset_is_refused() -> None:
    """It has no closed form here."""
    offset = ArmGeometry(0.35, -0.145, 0.05, 0.815, 0.85, 0.82, 0.17)
    with pytest.raises(CellError) as caught:
        Kinematics(an_arm(offset))
    assert str(caught.value) == ("arm: robot.geometry.b: 0.05 m; expected 0: no sideways offset")
