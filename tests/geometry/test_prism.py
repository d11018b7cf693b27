"""Prisms contain their boxes, and their relations agree with sampled points."""

import itertools
import math

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from depal.geometry import (
    PRISM_WIDTH,
    OrientedBox,
    Pose,
    footprint_overlap,
    holds_centre,
    lateral_interval,
    prism_of,
    prisms_of,
    slice_at,
)

sides = st.floats(0.05, 0.6)
places = st.floats(-0.5, 0.5)
yaws = st.floats(-math.pi, math.pi)


@st.composite
def upright_boxes(draw: st.DrawFn) -> OrientedBox:
    """Boxes that stand flat, at any yaw."""
    centre = (draw(places), draw(places), draw(places))
    return OrientedBox.upright(centre, (draw(sides), draw(sides), draw(sides)), draw(yaws))


@st.composite
def tilted_boxes(draw: st.DrawFn) -> OrientedBox:
    """Boxes at any pose at all."""
    box = draw(upright_boxes())
    a, b = draw(yaws), draw(yaws)
    roll = Pose(rotation=((1, 0, 0), (0, math.cos(a), -math.sin(a)), (0, math.sin(a), math.cos(a))))
    turned = box.pose @ roll @ Pose.from_yaw((0, 0, 0), b)
    return OrientedBox(turned, box.size)


def rectangle(prism: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """The four corners of a prism on the ground, (4, 2)."""
    x, y, _, length, width, _, c, s = prism
    return np.array(
        [
            (x + c * i * length - s * j * width, y + s * i * length + c * j * width)
            for i, j in itertools.product((-1, 1), repeat=2)
        ]
    )


@given(tilted_boxes())
def test_a_prism_contains_its_box(box: OrientedBox) -> None:
    """Whatever the pose, no corner sticks out."""
    x, y, z, length, width, height, c, s = prism_of(box)
    for px, py, pz in box.corners.tolist():
        dx, dy = px - x, py - y
        assert abs(c * dx + s * dy) <= length + 1e-9
        assert abs(c * dy - s * dx) <= width + 1e-9
        assert abs(pz - z) <= height + 1e-9


@given(upright_boxes())
def test_the_prism_of_an_upright_box_is_the_box(box: OrientedBox) -> None:
    """Nothing is added, and the yaw is folded to the nearest axis."""
    _, _, _, length, width, height, c, s = prism_of(box)
    assert 8 * length * width * height == pytest.approx(math.prod(box.size))
    assert 2 * height == pytest.approx(box.size[2])
    assert c >= math.cos(math.pi / 4) - 1e-9
    assert c * c + s * s == pytest.approx(1)


@pytest.mark.parametrize("up", [0, 1, 2])
def test_a_box_that_lies_on_its_side_is_as_high_as_the_edge_that_points_up(up: int) -> None:
    """The axis nearest to the vertical becomes the height."""
    rotation = np.eye(3)[:, np.roll([0, 1, 2], up - 2)].T
    box = OrientedBox(Pose.from_arrays((0, 0, 0), rotation), (0.2, 0.4, 0.6))
    assert 2 * prism_of(box)[5] == pytest.approx(box.size[int(np.argmax(rotation[2]))])


def test_no_boxes_have_no_prisms() -> None:
    """The shape still fits."""
    assert prisms_of([]).shape == (0, PRISM_WIDTH)


@given(upright_boxes())
def test_the_lateral_interval_is_that_of_the_corners(box: OrientedBox) -> None:
    """Along y."""
    prisms = prisms_of([box])
    low, high = lateral_interval(prisms, 0)
    corners = rectangle(prisms[0])
    assert low == pytest.approx(corners[:, 1].min(), abs=1e-9)
    assert high == pytest.approx(corners[:, 1].max(), abs=1e-9)


@given(upright_boxes(), st.floats(0.01, 0.99))
def test_a_slice_ends_on_the_rectangles_edges(box: OrientedBox, share: float) -> None:
    """Both ends lie within the rectangle, and a hair beyond lies outside."""
    prisms = prisms_of([box])
    low_y, high_y = lateral_interval(prisms, 0)
    y = low_y + share * (high_y - low_y)
    near, far = slice_at(prisms, 0, y)
    x0, y0, _, length, width, _, c, s = prisms[0]

    def inside(x: float, slack: float) -> bool:
        dx, dy = x - x0, y - y0
        return abs(c * dx + s * dy) <= length + slack and abs(c * dy - s * dx) <= width + slack

    assert near <= far + 1e-9
    assert inside(near, 1e-7)
    assert inside(far, 1e-7)
    assert not inside(near - 1e-3, -1e-7)
    assert not inside(far + 1e-3, -1e-7)


@given(upright_boxes(), upright_boxes())
def test_footprints_overlap_alike_from_both_sides(a: OrientedBox, b: OrientedBox) -> None:
    """To the last bit, so that no order of boxes matters."""
    prisms = prisms_of([a, b])
    assert footprint_overlap(prisms, 0, 1) == footprint_overlap(prisms, 1, 0)


@given(upright_boxes(), upright_boxes())
def test_footprints_overlap_when_they_share_a_point(a: OrientedBox, b: OrientedBox) -> None:
    """The sign agrees with a common point found by sampling one in the other."""
    prisms = prisms_of([a, b])
    depth = footprint_overlap(prisms, 0, 1)
    assume(abs(depth) > 0.02)
    grid = np.linspace(-1, 1, 61)
    i, j = (part.ravel() for part in np.meshgrid(grid, grid))
    x, y, _, length, width, _, c, s = prisms[0]
    px, py = x + c * i * length - s * j * width, y + s * i * length + c * j * width
    x, y, _, length, width, _, c, s = prisms[1]
    dx, dy = px - x, py - y
    shared = (abs(c * dx + s * dy) <= length) & (abs(c * dy - s * dx) <= width)
    assert bool(shared.any()) == (depth > 0)


@given(upright_boxes(), st.floats(-0.6, 0.6), st.floats(-0.6, 0.6))
def test_shifting_by_the_overlap_parts_axis_aligned_boxes(
    a: OrientedBox, dx: float, dy: float
) -> None:
    """For boxes that are not turned the overlap is the smaller of the two shared lengths."""
    flat = OrientedBox.upright(a.centre, a.size)
    b = OrientedBox.upright((a.centre[0] + dx, a.centre[1] + dy, 0.0), (0.3, 0.2, 0.1))
    expected = min(a.size[0] / 2 + 0.15 - abs(dx), a.size[1] / 2 + 0.1 - abs(dy))
    assert footprint_overlap(prisms_of([flat, b]), 0, 1) == pytest.approx(expected, abs=1e-9)


@given(upright_boxes(), upright_boxes())
def test_a_box_holds_a_centre_only_when_it_contains_it(a: OrientedBox, b: OrientedBox) -> None:
    """Checked in the box's own frame."""
    prisms = prisms_of([a, b])
    local = a.pose.inverse.apply(b.centre)
    margins = [side / 2 - abs(value) for side, value in zip(a.size, local, strict=True)]
    assume(min(abs(margin) for margin in margins) > 1e-6)
    assert holds_centre(prisms, 0, 1) == (min(margins) > 0)
