"""Where a surface is, something is: what no box explains is an obstacle, and nothing else."""

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.cell.files import shipped_cell
from depal.cell.sight import unexplained
from depal.geometry import OrientedBox, Pose
from depal.ports import Frame

CELL = shipped_cell("default")
SIZE = (0.3, 0.4, 0.3)
DECK = CELL.pallet.cell_from_pallet.translation[2]


def box(x: float, y: float, size: tuple[float, float, float] = SIZE) -> OrientedBox:
    """Standing on the deck."""
    return OrientedBox.upright((x, y, DECK + size[2] / 2), size)


def frame_of(boxes: list[OrientedBox], noise: float = 0.0) -> Frame:
    """What a small camera before the pallet measures: boxes, and a wall behind."""
    turn = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
    return taken(np.array([0.0, 0.0, 0.6]), turn, boxes, noise)


def from_above(boxes: list[OrientedBox], noise: float) -> Frame:
    """What one above the pallet measures: boxes, and something far below."""
    turn = np.array([[0.0, -1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
    return taken(np.array([1.6, 0.0, 2.0]), turn, boxes, noise)


def taken(
    eye: npt.NDArray[np.float64],
    turn: npt.NDArray[np.float64],
    boxes: list[OrientedBox],
    noise: float,
) -> Frame:
    """What a camera at a pose measures."""
    v, u = np.meshgrid(np.arange(120.0), np.arange(160.0), indexing="ij")
    rays = np.stack(((u - 79.5) / 150, (v - 59.5) / 150, np.ones_like(u)), axis=-1) @ turn.T
    depth = np.full(u.shape, 4.0)
    for each in boxes:
        low, high = each.corners.min(axis=0), each.corners.max(axis=0)
        with np.errstate(divide="ignore", invalid="ignore"):
            one, two = (low - eye) / rays, (high - eye) / rays
        near = np.nanmax(np.minimum(one, two), axis=-1)
        far = np.nanmin(np.maximum(one, two), axis=-1)
        depth = np.where((near < far) & (near > 0.0), np.minimum(depth, near), depth)
    depth = depth + np.random.default_rng(1).normal(0.0, noise, depth.shape)
    big = np.kron(depth, np.ones((4, 4))).astype(np.float32)  # every fourth pixel is looked at
    fine = np.array([[600.0, 0.0, 318.0], [0.0, 600.0, 238.0], [0.0, 0.0, 1.0]])
    matrix = tuple(tuple(row) for row in fine.tolist())
    colour = np.zeros((4, 4, 3), dtype=np.uint8)
    return Frame(0.0, colour, big, matrix, matrix, Pose.from_arrays(eye, turn))  # type: ignore[arg-type]


def solids(boxes: list[OrientedBox], believed: list[OrientedBox]) -> tuple[OrientedBox, ...]:
    """What is found, with depths that are 4 mm off."""
    return unexplained([frame_of(boxes, 0.004)], believed, CELL.pallet)


def test_boxes_that_are_believed_leave_nothing_to_explain() -> None:
    """A little off, as they are."""
    there = [box(1.6, 0.3), box(1.7, -0.2)]
    seen = [box(1.61, 0.29), box(1.69, -0.2)]
    assert solids(there, seen) == ()


@pytest.mark.parametrize("y", [-0.35, 0.0, 0.3])
def test_a_box_that_was_missed_is_an_obstacle_where_it_stands(y: float) -> None:
    """Its front at least, across its width and height, in the cell's frame."""
    other = box(1.7, y - 0.5 if y > 0 else y + 0.5)
    missed = box(1.6, y)
    found = solids([missed, other], [other])
    corners = np.concatenate([solid.corners for solid in found])
    low, high = corners.min(axis=0), corners.max(axis=0)
    assert low[0] == pytest.approx(1.45, abs=0.06)
    assert (low[1], high[1]) == pytest.approx((y - 0.2, y + 0.2), abs=0.07)
    assert (low[2], high[2]) == pytest.approx((DECK, DECK + 0.3), abs=0.08)


def test_an_empty_pallet_has_no_obstacles() -> None:
    """Nor has a look without pictures."""
    assert solids([], []) == ()
    assert unexplained([], [], CELL.pallet) == ()


def test_a_box_that_was_missed_behind_another_is_seen_from_above() -> None:
    """Flush, of the same height, and narrow: what is believed before it does not swallow it."""
    front, missed = box(1.6, 0.0), box(1.82, 0.0, (0.104, 0.4, 0.3))
    found = unexplained([from_above([front, missed], 0.004)], [front], CELL.pallet)
    corners = np.concatenate([solid.corners for solid in found])
    low, high = corners.min(axis=0), corners.max(axis=0)
    assert low[0] > 1.75
    assert (low[0], high[0]) == pytest.approx((1.77, 1.872), abs=0.04)
    assert (low[1], high[1]) == pytest.approx((-0.2, 0.2), abs=0.04)
    assert high[2] == pytest.approx(DECK + 0.3, abs=0.03)


@given(st.floats(1.56, 1.85), st.floats(-0.3, 0.3), st.floats(0.12, 0.3), st.floats(0.12, 0.3))
def test_all_of_a_top_that_nothing_explains_lies_in_obstacles(
    x: float, y: float, depth: float, width: float
) -> None:
    """To its corners, within 8 mm: where an edge is cut off, a tool hits it."""
    missed = box(x, y, (depth, width, 0.25))
    found = unexplained([from_above([missed], 0.002)], [], CELL.pallet)
    lower = np.array([solid.corners.min(axis=0) for solid in found])
    upper = np.array([solid.corners.max(axis=0) for solid in found])
    for corner in missed.corners[missed.corners[:, 2] > missed.centre[2]]:
        below = corner - (0.0, 0.0, 0.01)
        off = np.maximum(np.maximum(lower - below, below - upper), 0.0).max(axis=1).min()
        assert off < 0.008
