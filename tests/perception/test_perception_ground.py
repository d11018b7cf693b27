"""Where a recorded frame stands: laws on pictures of a table with blocks on it."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.errors import FrameError
from depal.geometry import Pose
from depal.perception.ground import levelled, region_in
from depal.ports import Frame
from depal.simulation.imaging.lens import aimed

K = ((300.0, 0.0, 160.0), (0.0, 300.0, 120.0), (0.0, 0.0, 1.0))
HIGH = 2.0
BLOCK = ((-0.3, -0.2), (0.4, 0.3), 0.25)
"""Corners on the table and height of a block [m]."""


def table(pose: Pose, noise: float = 0.002) -> Frame:
    """What a camera at a pose sees of a level table with a block on it."""
    rows, columns = np.indices((240, 320))
    rays = np.stack(((columns - 160.0) / 300.0, (rows - 120.0) / 300.0, np.ones((240, 320))), -1)
    eye, ways = np.array(pose.translation), rays @ np.array(pose.rotation).T
    depth = np.full((240, 320), np.inf)
    for height, low, high in ((BLOCK[2], BLOCK[0], BLOCK[1]), (0.0, (-9, -9), (9, 9))):
        far = (height - eye[2]) / ways[..., 2]
        at = eye + far[..., None] * ways
        hit = (far > 0) & (at[..., :2] >= low).all(axis=-1) & (at[..., :2] <= high).all(axis=-1)
        depth = np.where(hit & (far < depth), far, depth)
    depth = np.where(np.isfinite(depth), depth, 0.0)
    shaken = depth * (1 + noise * np.random.default_rng(1).standard_normal(depth.shape))
    colour = np.zeros((240, 320, 3), dtype=np.uint8)
    return Frame(0.0, colour, shaken.astype(np.float32), K, K, pose)


POSES = st.tuples(st.floats(-0.7, 0.7), st.floats(-0.7, 0.7), st.floats(1.5, 2.5)).map(
    lambda at: aimed((at[0] + 0.01, at[1], at[2]), (0.0, 0.0, 0.0))
)


@given(POSES)
@settings(max_examples=15, deadline=None)
def test_the_table_is_level_whatever_the_camera_said(pose: Pose) -> None:
    """Its normal is z, the camera stands above the origin as high as it is above the table."""
    frame = table(pose)
    found = levelled(frame).cell_from_camera
    up_before, up = np.array(pose.rotation)[2], np.array(found.rotation)[2]
    assert up_before @ up > math.cos(math.radians(0.7))
    assert found.translation == pytest.approx((0.0, 0.0, pose.translation[2]), abs=0.02)
    assert np.linalg.det(np.array(found.rotation)) == pytest.approx(1.0)


@given(POSES)
@settings(max_examples=15, deadline=None)
def test_boxes_are_looked_for_where_something_stands(pose: Pose) -> None:
    """The region holds the block, and not much of the table."""
    region = region_in([table(pose)])
    inverse = region.cell_from_region.inverse
    (a, b), (c, d), high = BLOCK
    corners = np.array([inverse.apply((x, y, high)) for x in (a, c) for y in (b, d)])
    size = np.array(region.size)
    assert corners[:, 0].min() >= 0.0
    assert corners[:, 0].max() <= size[0]
    assert np.abs(corners[:, 1]).max() <= size[1] / 2
    assert corners[:, 2] == pytest.approx(np.full(4, high + region.ground), abs=0.02)
    assert corners[:, 2].max() <= size[2]
    assert size[0] * size[1] < 1.3


def test_far_is_up_in_the_picture_of_a_camera_that_looks_down() -> None:
    """And ahead for one that looks ahead."""
    down = aimed((0.0, -0.1, HIGH), (0.0, 0.0, 0.0))
    assert np.array(region_in([table(down)]).cell_from_region.rotation)[:, 0] == pytest.approx(
        (0.0, 1.0, 0.0), abs=0.01
    )
    ahead = aimed((-2.0, 0.0, 1.0), (0.0, 0.0, 0.0))
    assert np.array(region_in([table(ahead)]).cell_from_region.rotation)[:, 0] == pytest.approx(
        (1.0, 0.0, 0.0), abs=0.01
    )


def test_what_stands_aside_of_what_the_camera_is_aimed_at_is_left_out() -> None:
    """Another block, larger and at the picture's edge."""
    frame = table(aimed((0.01, 0.0, HIGH), (0.0, 0.0, 0.0)))
    alone = region_in([frame])
    depth = frame.depth.copy()
    depth[:, :60] = HIGH - 0.5
    both = region_in([replace(frame, depth=depth)])
    assert both.size == pytest.approx(alone.size, abs=0.03)


def test_the_same_frame_is_levelled_the_same_way() -> None:
    """Chance is seeded."""
    frame = table(aimed((0.3, 0.2, HIGH), (0.0, 0.0, 0.0)))
    assert levelled(frame).cell_from_camera == levelled(frame).cell_from_camera


def test_a_frame_without_depths_and_one_without_things_say_so() -> None:
    """There is nothing to stand on, or nothing that stands."""
    pose = aimed((0.01, 0.0, HIGH), (0.0, 0.0, 0.0))
    empty = table(Pose((5.0, 5.0, HIGH), pose.rotation), noise=0.0)
    with pytest.raises(FrameError, match="nothing stands above the ground"):
        region_in([empty])
    blind = Frame(0.0, empty.colour, np.zeros_like(empty.depth), K, K, pose)
    with pytest.raises(FrameError, match="0 of 4800 depths are measured; expected at least 500"):
        levelled(blind)
