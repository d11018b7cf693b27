"""Poses are a group, and boxes keep their shape in every frame."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.geometry import OrientedBox, Pose

lengths = st.floats(-5, 5)
points = st.tuples(lengths, lengths, lengths)
angles = st.floats(-math.pi, math.pi)


@st.composite
def poses(draw: st.DrawFn) -> Pose:
    """Poses turned about all three axes."""
    a, b, c = draw(angles), draw(angles), draw(angles)
    about_z = Pose.from_yaw((0, 0, 0), a)
    about_x = Pose(
        rotation=((1, 0, 0), (0, math.cos(b), -math.sin(b)), (0, math.sin(b), math.cos(b)))
    )
    return Pose(draw(points)) @ about_z @ about_x @ Pose.from_yaw((0, 0, 0), c)


@given(poses(), points)
def test_the_inverse_takes_a_point_back(pose: Pose, point: tuple[float, float, float]) -> None:
    """`a_from_b` undoes `b_from_a`."""
    assert pose.inverse.apply(pose.apply(point)) == pytest.approx(point, abs=1e-9)


@given(poses(), poses(), points)
def test_composition_is_one_after_the_other(
    first: Pose, second: Pose, point: tuple[float, float, float]
) -> None:
    """`c_from_b @ b_from_a` applied once is both applied in turn."""
    expected = second.apply(first.apply(point))
    assert (second @ first).apply(point) == pytest.approx(expected, abs=1e-9)


@given(poses(), poses(), poses())
def test_composition_is_associative(a: Pose, b: Pose, c: Pose) -> None:
    """Brackets do not matter."""
    left, right = (a @ b) @ c, a @ (b @ c)
    assert np.allclose(left.rotation, right.rotation, atol=1e-9)
    assert left.translation == pytest.approx(right.translation, abs=1e-9)


def test_the_default_pose_changes_nothing() -> None:
    """The identity."""
    assert Pose().apply((1.0, 2.0, 3.0)) == (1.0, 2.0, 3.0)


@given(poses(), points)
def test_a_box_keeps_its_edges_in_every_frame(
    pose: Pose, centre: tuple[float, float, float]
) -> None:
    """Corners move rigidly."""
    box = OrientedBox.upright(centre, (0.4, 0.3, 0.2), yaw=0.3)
    moved = box.seen_from(pose)
    expected = [pose.apply(tuple(corner)) for corner in box.corners.tolist()]
    assert np.allclose(moved.corners, expected, atol=1e-9)
    assert moved.size == box.size


def test_a_box_from_its_corner_has_that_corner() -> None:
    """The corner with the smallest coordinates."""
    box = OrientedBox.from_corner((1.0, 2.0, 3.0), (0.2, 0.4, 0.6))
    assert box.centre == pytest.approx((1.1, 2.2, 3.3))
    assert box.corners.min(axis=0).tolist() == pytest.approx([1.0, 2.0, 3.0])
    assert box.corners.max(axis=0).tolist() == pytest.approx([1.2, 2.4, 3.6])


def test_an_upright_box_without_yaw_is_not_turned() -> None:
    """No rounding enters."""
    assert OrientedBox.upright((0, 0, 0), (1, 1, 1)).pose.rotation == Pose().rotation
