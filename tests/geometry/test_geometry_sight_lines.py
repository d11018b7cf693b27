"""What stands between an eye and a point, against many points along the line."""

import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st

from depal.geometry import Blockers, OrientedBox

Point = tuple[float, float, float]
points = st.tuples(*[st.floats(-2, 2)] * 3)


@given(points, points, points, points, st.floats(0.05, 0.5))
@example((-1.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.1, 0.0), (0.0, 0.1, 0.0), 0.2)
@example((-1.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.6, 0.0), (0.0, 0.6, 0.0), 0.2)
def test_a_line_hits_a_capsule_exactly_when_a_point_of_it_lies_inside(
    start: Point, end: Point, one: Point, other: Point, radius: float
) -> None:
    """Against many points along both."""
    if np.linalg.norm(np.subtract(end, start)) < 0.01:
        return
    along = np.linspace(0, 1, 150)[:, None]
    line = np.array(start) + along * np.subtract(end, start)
    bone = np.array(one) + along * np.subtract(other, one)
    nearest = np.linalg.norm(line[:, None] - bone[None], axis=2).min()
    capsule = Blockers.of((), np.array([[*one, *other, radius]]))
    (hit,) = capsule.between(np.array([start]), np.array([end]))
    if nearest < radius:
        assert hit
    if nearest > radius + 0.05:
        assert not hit


@given(points, points, points, st.floats(-3, 3))
def test_a_line_hits_a_box_exactly_when_a_point_of_it_lies_inside(
    start: Point, end: Point, centre: Point, yaw: float
) -> None:
    """Against many points along it."""
    box = OrientedBox.upright(centre, (0.6, 0.4, 0.8), yaw)
    line = np.array(start) + np.linspace(0, 1, 400)[:, None] * np.subtract(end, start)
    inside = np.abs((line - np.array(centre)) @ np.array(box.pose.rotation))
    (hit,) = Blockers.of([box]).between(np.array([start]), np.array([end]))
    if (inside < np.array((0.29, 0.19, 0.39))).all(axis=1).any():
        assert hit
    if not (inside < np.array((0.33, 0.23, 0.43))).all(axis=1).any():
        assert not hit


def test_where_nothing_stands_every_line_is_free() -> None:
    """No box, no capsule."""
    ends = np.array([(1.0, 0.0, 0.0), (0.0, 2.0, 0.0)])
    assert not Blockers.of(()).between(np.zeros((2, 3)), ends).any()
