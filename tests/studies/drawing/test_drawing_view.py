"""Projection, and what is seen of a cuboid."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.studies.drawing.sight import seen_share
from depal.studies.drawing.solids import outline
from depal.studies.drawing.view import FROM_THE_ROBOT, View

views = st.builds(View, st.floats(-1.3, 1.3), st.floats(0.05, 1.4))
lengths = st.floats(-3.0, 3.0)
points = st.tuples(lengths, lengths, lengths).map(np.array)


@given(views)
def test_the_picture_has_no_distortion(view: View) -> None:
    """Right, up and towards the viewer are of length 1 and at right angles."""
    frame = np.vstack((view.plane, view.towards))
    np.testing.assert_allclose(frame @ frame.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(frame) == pytest.approx(1.0)


@given(views, points, st.floats(-2.0, 2.0))
def test_points_along_the_line_of_sight_fall_together(
    view: View, point: np.ndarray, step: float
) -> None:
    """A step towards the viewer does not move a point in the picture."""
    moved = view.flat(point + step * view.towards)
    np.testing.assert_allclose(moved, view.flat(point), atol=1e-9)


@given(views, points, points)
def test_parallel_lines_stay_parallel(view: View, point: np.ndarray, way: np.ndarray) -> None:
    """The same way is the same way in the picture, wherever it starts."""
    np.testing.assert_allclose(view.flat(point + way) - view.flat(point), view.flat(way), atol=1e-9)


@given(views)
def test_the_vertical_stays_upright(view: View) -> None:
    """Higher in the cell is higher in the picture, straight up."""
    across, up = view.flat((0.0, 0.0, 1.0))
    assert across == pytest.approx(0.0, abs=1e-12)
    assert up > 0


def test_without_a_turn_the_robots_left_is_on_the_left() -> None:
    """+y is drawn to the left, as the robot sees it."""
    np.testing.assert_allclose(View(0.0, 0.3).flat((0.0, 1.0, 0.0)), (-1.0, 0.0), atol=1e-12)


def test_the_usual_view_sees_the_front_the_top_and_the_right_side() -> None:
    """The viewer stands on the robot's side (-x), to its right (-y), above (+z)."""
    assert np.sign(FROM_THE_ROBOT.towards).tolist() == [-1, -1, 1]


def test_nine_edges_of_a_cuboid_are_seen() -> None:
    """The three that meet in the farthest corner are not."""
    view = FROM_THE_ROBOT
    lines = outline(view, (0.0, 0.0, 0.0), (2.0, 2.0, 2.0))
    farthest = view.flat(-np.sign(view.towards))
    assert len(lines) == 9
    assert all(np.abs(end - farthest).max() > 1e-9 for line in lines for end in line)
    assert len({tuple(np.round(line, 9).ravel()) for line in lines}) == 9


def test_all_is_seen_of_a_cuboid_that_stands_alone() -> None:
    """Nothing before it: a share of 1."""
    assert seen_share(0, [(0, 0, 0)], [(1, 1, 1)], FROM_THE_ROBOT.towards) == 1.0


def test_two_thirds_are_seen_of_a_cuboid_with_one_of_three_sides_covered() -> None:
    """Along the diagonal the three sides take the same room in the picture."""
    towards = np.full(3, -1 / math.sqrt(3)) * (1, 1, -1)
    lower = [(0, 0, 0), (-1, 0, 0)]
    upper = [(1, 1, 1), (0, 1, 1)]
    assert seen_share(0, lower, upper, towards) == pytest.approx(2 / 3)


def test_nothing_is_seen_of_a_cuboid_behind_a_wall() -> None:
    """A wall that is large enough hides it."""
    lower, upper = [(0, 0, 0), (-2, -9, -9)], [(1, 1, 1), (-1, 9, 9)]
    assert seen_share(0, lower, upper, View(-0.3, 0.3).towards) == 0.0
