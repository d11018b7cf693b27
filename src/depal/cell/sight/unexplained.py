"""What the cameras measure on the pallet and no box explains: the arm keeps out of it.

Detection misses boxes, depths do not: where a surface is, something is.
"""

from collections.abc import Sequence

import cv2
import numpy as np
import numpy.typing as npt

from depal.domain import PalletStand
from depal.geometry import OrientedBox, Pose
from depal.ports import Frame

Floats = npt.NDArray[np.float64]
Narrow = npt.NDArray[np.float32]
Ints = npt.NDArray[np.int64]

STRIDE = 4
"""Every so many pixels of a depth picture along both edges are looked at."""

AROUND = 0.04
"""A surface this near to a box belongs to it: errors of depth, and bulging [m]."""

PATCH = 5
"""A patch is so many of the thinned pixels high and wide at least."""

JUMP = 0.02
"""Neighbouring depths that differ by more of themselves are of two surfaces."""

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
    found = [_strange(frame, boxes, stand) for frame in frames]
    local = np.concatenate(found) if found else np.empty((0, 3))
    return tuple(solid.seen_from(stand.cell_from_pallet) for solid in _columns(local))


def _strange(frame: Frame, boxes: Sequence[OrientedBox], stand: PalletStand) -> Floats:
    """(n, 3) points of one frame that belong to no box, in the pallet's frame.

    Only patches count: beside edges depths lie between two surfaces, in lines and specks.
    """
    depth = np.asarray(frame.depth[::STRIDE, ::STRIDE], dtype=np.float32)
    rows, columns = np.nonzero(_even(depth))
    points = _points(frame, depth, rows, columns)
    local = _carried(points, stand.cell_from_pallet.inverse)
    length, width, _ = stand.size
    free = (local[:, 0] > 0.0) & (local[:, 0] < length)
    free &= (local[:, 1] > 0.0) & (local[:, 1] < width)
    free &= (local[:, 2] > ABOVE) & (local[:, 2] < TALLEST)
    for box in boxes:
        left = np.flatnonzero(free)
        off = np.abs(_carried(points[left], box.pose.inverse)) - np.array(box.size) / 2
        free[left[(off < AROUND).all(axis=1)]] = False
    mask = np.zeros(depth.shape, dtype=np.uint8)
    mask[rows[free], columns[free]] = 1
    patch = np.asarray(cv2.morphologyEx(mask, cv2.MORPH_OPEN, np.ones((PATCH, PATCH), np.uint8)))
    return np.asarray(local[patch[rows, columns] > 0])


def _even(depth: Narrow) -> npt.NDArray[np.bool_]:
    """Pixels whose neighbours lie on the same surface."""
    window = np.ones((3, 3), np.uint8)
    span = np.asarray(cv2.dilate(depth, window)) - np.asarray(cv2.erode(depth, window))
    return np.asarray((depth > 0.0) & (span < JUMP * depth))


def _points(frame: Frame, depth: Narrow, rows: Ints, columns: Ints) -> Floats:
    """(n, 3) what some pixels of a thinned depth picture show, in the cell frame."""
    k = np.array(frame.depth_k)
    z = depth[rows, columns].astype(np.float64)
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
        np.floor(points[:, 1::-1] / CELL).astype(int),
        axis=0,
        return_inverse=True,
        return_counts=True,
    )
    low, high = np.full(len(places), np.inf), np.full(len(places), -np.inf)
    np.minimum.at(low, member.ravel(), points[:, 2])
    np.maximum.at(high, member.ravel(), points[:, 2])
    out: list[OrientedBox] = []
    run: list[float] = []  # x from, x to, y, low, high of what is being joined
    for (j, i), bottom, top, count in zip(places, low, high, counts, strict=True):
        if count < LEAST:
            continue
        x, y = float(i * CELL), float(j * CELL)
        if run and run[2] == y and abs(run[1] - x) < CELL / 2 and abs(run[4] - top) < STEP:
            run[1], run[3], run[4] = x + CELL, min(run[3], bottom), max(run[4], top)
            continue
        out += [_solid(run)] if run else []
        run = [x, x + CELL, y, bottom, top]
    return [*out, _solid(run)] if run else out


def _solid(run: list[float]) -> OrientedBox:
    left, right, y, low, high = map(float, run)
    corner = (left, y, low - CELL / 2)
    return OrientedBox.from_corner(corner, (right - left, CELL, high - low + CELL / 2))
