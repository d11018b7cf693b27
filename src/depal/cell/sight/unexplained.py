"""What the cameras measure on the pallet and no box explains: the arm keeps out of it.

Detection misses boxes, depths do not: where a surface is, something is.
"""

from collections.abc import Sequence

import cv2
import numpy as np
import numpy.typing as npt

from depal.domain import PalletStand
from depal.geometry import OrientedBox, Pose
from depal.geometry.abreast import abreast
from depal.ports import Frame

Floats = npt.NDArray[np.float64]
Narrow = npt.NDArray[np.float32]
Ints = npt.NDArray[np.int64]
Bytes = npt.NDArray[np.uint8]
Flags = npt.NDArray[np.bool_]

STRIDE = 4
"""Every so many pixels of a depth picture along both edges are looked at."""

MIDDLE = 5
"""Depths are the medians of squares of so many pixels: of one pixel they scatter too far."""

ALONG, ACROSS = 0.04, 0.015
"""A surface this near to a box belongs to it, along the view, where depths err and boxes bulge, and
across the view, where pictures hardly do [m]."""

DEPTHS = (0.0, -ALONG, ALONG, -ALONG / 2, ALONG / 2)
"""Where along the view a point is looked for in a box [m]: less than twice ACROSS apart."""

PATCH = 4
"""A patch is so many of the thinned pixels high and wide at least."""

HOLE = 3
"""Holes in a patch that are narrower than so many of the thinned pixels are none."""

GROWN = 2
"""Patches lose so many pixels along their edges, and get those back that lie on their surface."""

JUMP = 0.02
"""Neighbouring depths that differ by more of themselves are of two surfaces."""

SLOPE = 0.008
"""An edge of a patch is of its surface where their depths differ by less of themselves."""

CELL = 0.05
"""Edge of the columns that the rest is gathered in [m]."""

LEAST = 1
"""So many points make a column; fewer are noise."""

ABOVE = 0.04
"""What is lower above the deck is the pallet [m]."""

TALLEST = 2.2
"""No load is higher [m]."""

RIM = 0.014
"""So much of a surface is lost at each of its edges [m]."""

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
    found = abreast(lambda frame: _strange(frame, boxes, stand), frames)
    local = np.concatenate(found) if found else np.empty((0, 3))
    return tuple(solid.seen_from(stand.cell_from_pallet) for solid in _columns(local))


def _strange(frame: Frame, boxes: Sequence[OrientedBox], stand: PalletStand) -> Floats:
    """(n, 3) points of one frame that belong to no box, in the pallet's frame.

    Only patches count: depths between two surfaces lie in lines and specks.
    """
    depth = _thinned(frame)
    rows, columns = np.nonzero(depth > 0.0)
    points = _points(frame, depth, rows, columns)
    local = _carried(points, stand.cell_from_pallet.inverse)
    length, width, _ = stand.size
    free = (local[:, 0] > 0.0) & (local[:, 0] < length)
    free &= (local[:, 1] > 0.0) & (local[:, 1] < width)
    free &= (local[:, 2] > ABOVE) & (local[:, 2] < TALLEST)
    views = points - np.array(frame.cell_from_camera.translation)
    views /= np.linalg.norm(views, axis=1, keepdims=True)
    for box in boxes:
        half = np.array(box.size) / 2 + ACROSS
        reach = float(np.linalg.norm(half)) + ALONG
        near = np.flatnonzero(free & (np.abs(points - box.centre) <= reach).all(axis=1))
        for way in DEPTHS:
            left = near[free[near]]
            inside = np.abs(_carried(points[left] + way * views[left], box.pose.inverse)) < half
            free[left[inside.all(axis=1)]] = False
    mask = np.zeros(depth.shape, dtype=np.uint8)
    mask[rows[free], columns[free]] = 1
    return np.asarray(local[free & _patches(depth, mask)[rows, columns]])


def _patches(depth: Narrow, strange: Bytes) -> Flags:
    """The pixels of patches; their edges, where depths are not even, belong to them.

    Args:
        depth: thinned.
        strange: 1 where a pixel belongs to no box.
    """
    even = strange & _even(depth)
    whole = cv2.morphologyEx(even, cv2.MORPH_CLOSE, np.ones((HOLE, HOLE), np.uint8))
    patch = cv2.morphologyEx(whole, cv2.MORPH_OPEN, np.ones((PATCH, PATCH), np.uint8)) > 0
    window = np.ones((3, 3), np.uint8)
    patch = np.asarray(patch & (even > 0))
    for _ in range(GROWN):
        nearest = cv2.erode(np.where(patch, depth, np.float32(np.inf)), window)
        farthest = cv2.dilate(np.where(patch, depth, np.float32(0.0)), window)
        off = np.maximum(nearest - depth, depth - farthest)
        patch = patch | ((strange > 0) & (off < SLOPE * depth))
    return patch


def _thinned(frame: Frame) -> Narrow:
    """Every so many pixels of a depth picture, of which each is the middle one around it."""
    depth = np.ascontiguousarray(frame.depth, dtype=np.float32)
    return np.asarray(cv2.medianBlur(depth, MIDDLE)[::STRIDE, ::STRIDE])


def _even(depth: Narrow) -> Flags:
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
    corners = np.full((2, len(places), 3), [[[np.inf]], [[-np.inf]]])
    np.minimum.at(corners[0], member.ravel(), points)
    np.maximum.at(corners[1], member.ravel(), points)
    out: list[OrientedBox] = []
    run: tuple[Floats, Floats] | None = None  # the corners of what is being joined
    last = (0, 0)
    for (j, i), low, high, count in zip(places.tolist(), *corners, counts, strict=True):
        if count < LEAST:
            continue
        if run is not None and last == (j, i - 1) and abs(run[1][2] - high[2]) < STEP:
            run = np.minimum(run[0], low), np.maximum(run[1], high)
        else:
            out += [_solid(*run)] if run is not None else []
            run = low, high
        last = (j, i)
    return [*out, _solid(*run)] if run is not None else out


def _solid(low: Floats, high: Floats) -> OrientedBox:
    """From corner to corner, a bit below, and around: the rims of patches are not even."""
    low = low - np.array((RIM, RIM, CELL / 2))
    high = high + np.array((RIM, RIM, 0.0))
    a, b, c = low.tolist()
    length, width, height = (high - low).tolist()
    return OrientedBox.from_corner((a, b, c), (length, width, height))
