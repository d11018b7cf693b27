"""What the cameras measure on the pallet and no box explains: the arm keeps out of it.

Detection misses boxes, depths do not: where a surface is, something is.
"""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from depal.domain import PalletStand
from depal.geometry import OrientedBox, Pose
from depal.ports import Frame

Floats = npt.NDArray[np.float64]

STRIDE = 4
"""Every so many pixels of a depth picture along both edges are looked at."""

AROUND = 0.04
"""A surface this near to a box belongs to it: errors of depth, and bulging [m]."""

CELL = 0.05
"""Edge of the columns that the rest is gathered in [m]."""

LEAST = 8
"""So many points make a column; fewer are noise."""

ABOVE = 0.04
"""What is lower above the deck is the pallet [m]."""

TALLEST = 2.2
"""No load is higher [m]."""

STEP = 0.06
"""Neighbouring columns whose tops differ by less are one solid [m]."""


def unexplained(
    frames: Sequence[Frame], boxes: Sequence[OrientedBox], stand: PalletStand
) -> tuple[OrientedBox, ...]:
    """Solids around the surfaces above the pallet that belong to no box.

    Args:
        frames: of one look; nothing but the load is above the pallet.
        boxes: that are believed to stand there, in the cell frame.
        stand: where the pallet is.

    Returns:
        Upright solids in the cell frame.
    """
    points = np.concatenate([_points(frame) for frame in frames] or [np.empty((0, 3))])
    pallet_from_cell = stand.cell_from_pallet.inverse
    local = _carried(points, pallet_from_cell)
    length, width, _ = stand.size
    inside = (local[:, 0] > 0.0) & (local[:, 0] < length)
    inside &= (local[:, 1] > 0.0) & (local[:, 1] < width)
    inside &= (local[:, 2] > ABOVE) & (local[:, 2] < TALLEST)
    points, local = points[inside], local[inside]
    free = np.ones(len(points), dtype=bool)
    for box in boxes:
        within = np.abs(_carried(points, box.pose.inverse)) < np.array(box.size) / 2 + AROUND
        free &= ~within.all(axis=1)
    return tuple(solid.seen_from(stand.cell_from_pallet) for solid in _columns(local[free]))


def _points(frame: Frame) -> Floats:
    """(n, 3) what a depth picture shows, in the cell frame."""
    depth = np.asarray(frame.depth[::STRIDE, ::STRIDE], dtype=np.float64)
    k = np.array(frame.depth_k)
    rows, columns = np.nonzero(depth > 0.0)
    z = depth[rows, columns]
    x = (columns * STRIDE - k[0, 2]) / k[0, 0] * z
    y = (rows * STRIDE - k[1, 2]) / k[1, 1] * z
    return _carried(np.column_stack((x, y, z)), frame.cell_from_camera)


def _carried(points: Floats, pose: Pose) -> Floats:
    return np.asarray(points @ np.array(pose.rotation).T + np.array(pose.translation))


def _columns(points: Floats) -> list[OrientedBox]:
    """Points gathered in columns, and columns in a row of the same height joined."""
    if not len(points):
        return []
    places, member, counts = np.unique(
        np.floor(points[:, :2] / CELL).astype(int), axis=0, return_inverse=True, return_counts=True
    )
    low, high = np.full(len(places), np.inf), np.full(len(places), -np.inf)
    np.minimum.at(low, member.ravel(), points[:, 2])
    np.maximum.at(high, member.ravel(), points[:, 2])
    out: list[OrientedBox] = []
    run: list[float] = []  # x from, x to, y, low, high of what is being joined
    for (i, j), bottom, top, count in zip(places[:, ::-1], low, high, counts, strict=True):
        if count < LEAST:
            continue
        x, y = i * CELL, j * CELL
        if run and run[2] == y and abs(run[1] - x) < CELL / 2 and abs(run[4] - top) < STEP:
            run[1], run[3], run[4] = x + CELL, min(run[3], bottom), max(run[4], top)
            continue
        out += [_solid(run)] if run else []
        run = [x, x + CELL, y, bottom, top]
    return [*out, _solid(run)] if run else out


def _solid(run: list[float]) -> OrientedBox:
    left, right, y, low, high = run
    corner = (left, y, low - CELL / 2)
    return OrientedBox.from_corner(corner, (right - left, CELL, high - low + CELL / 2))
