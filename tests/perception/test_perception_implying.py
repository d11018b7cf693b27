"""What a front tells of the top of its box, and a top of the front."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.geometry import OrientedBox, Pose
from depal.perception.detecting import Expected, Implied, implied_by
from depal.perception.detecting.implying import SPEAKS, boxes_with, spoken_for
from depal.perception.faces import Face, Facing, Raster, Rectangle
from depal.perception.proposals.candidates import Candidates
from depal.perception.proposals.kernels import FEATURES
from depal.perception.rasters import Region

REGION = Region(Pose.from_yaw((1.2, 0.3, 0.1), 0.2), (1.4, 1.0, 1.9), 0.06)
"""Turned against the cell, so that nothing depends on the cell's own axes."""

edges = st.floats(0.1, 0.5)
sizes = st.tuples(edges, edges, edges)
places = st.tuples(st.floats(0.3, 1.0), st.floats(-0.4, 0.4), st.floats(0.3, 1.2))
turns = st.floats(-0.06, 0.06)
chances = st.floats(0.0, 1.0)


def raster(facing: Facing) -> Raster:
    """Of nothing."""
    pose, _ = REGION.frame_of(facing, 0.003)
    empty = np.zeros((2, 2), dtype=np.float32)
    colour = np.zeros((2, 2, 3), dtype=np.uint8)
    return Raster(facing, REGION.cell_from_region @ pose, 0.003, colour, empty, empty > 0)


def faces_of(box: OrientedBox, chance: float = 1.0) -> tuple[Face, Face]:
    """The front and the top of a box in the region's frame, in the cell."""
    depth, width, height = box.size
    cell_from_box = REGION.cell_from_region @ box.pose
    front = Pose((-depth / 2, 0.0, 0.0), ((0.0, 0.0, 1.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0)))
    top = Pose((0.0, 0.0, height / 2), ((0.0, -1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, -1.0)))
    return (
        Face(Facing.FRONT, cell_from_box @ front, (width, height), chance),
        Face(Facing.TOP, cell_from_box @ top, (width, depth), chance),
    )


def seen_on(view: Raster, face: Face) -> Rectangle:
    """A face as its raster shows it."""
    pose = view.cell_from_raster.inverse @ face.cell_from_face
    u, v, depth = pose.translation
    turn = math.atan2(pose.rotation[1][0], pose.rotation[0][0])
    return Rectangle(u, v, *face.size, turn, depth)


def numbers(rectangle: Rectangle) -> tuple[float, ...]:
    """Of a rectangle."""
    each = rectangle
    return (each.u, each.v, each.width, each.height, each.turn, each.depth)


@given(sizes, places, turns, chances, st.booleans())
def test_each_face_of_an_expected_box_implies_the_other_where_it_is(
    size: tuple[float, float, float],
    place: tuple[float, float, float],
    yaw: float,
    chance: float,
    standing: bool,  # noqa: FBT001 - drawn
) -> None:
    """Whatever the box's size, place and turn, and whether boxes stand upright or lie."""
    front, top = faces_of(OrientedBox(Pose.from_yaw(place, yaw), size), chance)
    expected, back = Expected((size,), standing), REGION.cell_from_region.inverse
    for one, other in ((front, top), (top, front)):
        view = raster(other.facing)
        implied = implied_by([one], view, expected, back)
        wanted = numbers(seen_on(view, other))
        away = [np.abs(np.subtract(numbers(each.rectangle), wanted)).max() for each in implied]
        assert min(away) < 1e-9
        assert {each.chance for each in implied} == {chance}


@given(sizes, sizes)
def test_a_face_of_no_expected_box_implies_nothing(
    size: tuple[float, float, float], other: tuple[float, float, float]
) -> None:
    """And of an expected one only what has its edges."""
    front, _ = faces_of(OrientedBox(Pose((0.5, 0.0, 0.5)), size))
    found = boxes_with(front, Expected((other,)))
    assert all(abs(box[1] - size[1]) < 0.014 and abs(box[2] - size[2]) < 0.014 for box in found)
    assert all(sorted(box) == sorted(other) for box in found)
    assert boxes_with(front, Expected()) == ()


@given(chances, st.floats(0.0, 0.015), st.floats(0.025, 0.3))
def test_what_is_implied_speaks_for_what_lies_there_and_for_nothing_else(
    chance: float, near: float, far: float
) -> None:
    """The more the nearer it lies and the surer the other face is; behind it is another face."""
    place = Rectangle(0.5, 0.5, 0.3, 0.2, 0.0, 1.0)
    moved = [
        place,
        Rectangle(0.5 + near, 0.5, 0.3, 0.2, 0.0, 1.0),
        Rectangle(0.5 + far, 0.5, 0.3, 0.2, 0.0, 1.0),
        Rectangle(0.5, 0.5, 0.3, 0.2, 0.0, 1.0 + far),
    ]
    rows = np.array([numbers(each) for each in moved])
    candidates = Candidates(rows, np.zeros((len(rows), FEATURES)))
    there, beside, away, behind = spoken_for(candidates, [Implied(place, chance)]).tolist()
    assert there == pytest.approx(SPEAKS * chance)
    assert there >= beside >= 0.5 * there
    assert away == behind == 0.0
    assert spoken_for(candidates, []).tolist() == [0.0] * len(rows)
