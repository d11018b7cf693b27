"""A raster shows surfaces where they are, whatever camera took them."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.domain import EURO_PALLET, PalletStand, cell_from_pallet
from depal.geometry import Pose
from depal.perception.changing import changed, shift_between
from depal.perception.faces import Facing, Rectangle
from depal.perception.rasters import Region, rasters_of
from depal.ports import Frame

STAND = PalletStand(cell_from_pallet(EURO_PALLET), EURO_PALLET)
WIDE, HIGH = 320, 240
FOCAL = 260.0
K = ((FOCAL, 0.0, (WIDE - 1) / 2), (0.0, FOCAL, (HIGH - 1) / 2), (0.0, 0.0, 1.0))


def facing_forward(x: float, y: float, z: float, yaw: float) -> Pose:
    """A level camera that looks along x, turned by `yaw` to the left."""
    c, s = math.cos(yaw), math.sin(yaw)
    return Pose((x, y, z), ((s, 0.0, c), (-c, 0.0, s), (0.0, -1.0, 0.0)))


def wall(pose: Pose, x: float) -> Frame:
    """A picture of a wall at this x, a bright square from y -.1 to .1 and z .5 to .7 on it."""
    rays = np.stack(np.meshgrid(np.arange(WIDE) - K[0][2], np.arange(HIGH) - K[1][2]), axis=-1)
    rays = np.concatenate((rays / FOCAL, np.ones((HIGH, WIDE, 1))), axis=2)
    cell = rays @ np.array(pose.rotation).T
    depth = (x - pose.translation[0]) / cell[..., 0]
    points = cell * depth[..., None] + np.array(pose.translation)
    square = (np.abs(points[..., 1]) < 0.1) & (np.abs(points[..., 2] - 0.6) < 0.1)
    colour = np.where(square[..., None], (200, 60, 40), (40, 60, 200)).astype(np.uint8)
    return Frame(0.0, colour, depth.astype(np.float32), K, K, pose)


@given(st.floats(-0.25, 0.25), st.floats(0.5, 1.0), st.floats(-0.15, 0.15), st.floats(1.42, 1.9))
@settings(max_examples=15)
def test_a_square_on_a_wall_is_seen_where_it_is(y: float, z: float, yaw: float, x: float) -> None:
    """A square on a wall is seen where it is."""
    frame = wall(facing_forward(0.0, y, z, yaw), x)
    front, _ = rasters_of([frame], Region.above(STAND))
    red = (front.colour[..., 0] > 150) & front.known
    rows, columns = np.nonzero(red)
    middle = front.cell_from_raster.apply(
        (columns.mean() * front.step, rows.mean() * front.step, float(front.depth[red].mean()))
    )
    assert middle == pytest.approx((x, 0.0, 0.6), abs=0.004)
    assert red.sum() * front.step**2 == pytest.approx(0.04, rel=0.1)


def test_a_wall_does_not_face_up() -> None:
    """A wall does not face up."""
    _, top = rasters_of([wall(facing_forward(0.0, 0.0, 0.8, 0.0), 1.6)], Region.above(STAND))
    assert not top.known.any()


def test_two_cameras_together_see_what_each_sees() -> None:
    """Two cameras together see what each sees."""
    poses = [facing_forward(0.0, y, 0.8, yaw) for y, yaw in ((-0.5, 0.5), (0.5, -0.5))]
    frames = [wall(pose, 1.6) for pose in poses]
    both, _ = rasters_of(frames, Region.above(STAND))
    for frame in frames:
        one, _ = rasters_of([frame], Region.above(STAND))
        assert both.known.sum() >= one.known.sum()


@given(st.floats(-0.3, 0.3), st.floats(-0.3, 0.3), st.floats(-0.5, 0.5))
def test_a_rectangle_keeps_its_place_in_the_cell(u: float, v: float, turn: float) -> None:
    """A rectangle keeps its place in the cell."""
    front, _ = rasters_of([wall(facing_forward(0.0, 0.0, 0.8, 0.0), 1.6)], Region.above(STAND))
    rectangle = Rectangle(u, v, 0.2, 0.1, turn, 0.05)
    pose = front.pose_of(rectangle)
    corner = pose.apply((-0.1, -0.05, 0.0))
    x, y, z = front.cell_from_raster.inverse.apply(corner)
    assert (x, y) == pytest.approx(tuple(rectangle.corners[0]), abs=1e-9)
    assert z == pytest.approx(0.05)


def test_nothing_has_changed_where_nothing_has() -> None:
    """Nothing has changed where nothing has."""
    pose = facing_forward(0.0, 0.1, 0.8, 0.0)
    before, _ = rasters_of([wall(pose, 1.6)], Region.above(STAND))
    again, _ = rasters_of([wall(facing_forward(0.0, 0.0, 0.85, 0.1), 1.6)], Region.above(STAND))
    both = before.known.mean()
    assert both > 0.5
    assert changed(before, before).sum() == 0
    down, right = shift_between(before, again)
    assert isinstance(down, int)
    assert isinstance(right, int)


def test_a_wall_that_has_moved_has_changed_everywhere() -> None:
    """A wall that has moved has changed everywhere."""
    pose = facing_forward(0.0, 0.1, 0.8, 0.0)
    before, _ = rasters_of([wall(pose, 1.6)], Region.above(STAND))
    now, _ = rasters_of([wall(pose, 1.66)], Region.above(STAND))
    differs = changed(before, now)
    assert differs[now.known].mean() > 0.95


@pytest.mark.parametrize("facing", list(Facing))
def test_a_regions_raster_covers_it(facing: Facing) -> None:
    """A regions raster covers it."""
    region = Region.above(STAND)
    pose, (rows, columns) = region.frame_of(facing, 0.003, 2)
    down = region.size[2] if facing is Facing.FRONT else region.size[0]
    assert rows * 0.003 == pytest.approx(down, abs=0.007)
    assert columns * 0.003 == pytest.approx(region.size[1], abs=0.007)
    first = pose.apply((0.0, 0.0, 0.0))
    assert first[1] == pytest.approx(region.size[1] / 2, abs=0.003)
