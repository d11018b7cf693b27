"""How high what the cameras measure reaches, place by place, whatever boxes are believed there."""

from collections.abc import Sequence

import cv2
import numpy as np
import numpy.typing as npt

from depal.domain import PalletStand
from depal.ports import Frame, Relief

Narrow = npt.NDArray[np.float32]
Ints = npt.NDArray[np.int64]

DOWN = 0.7
"""A camera looks down where its view goes down by more than this share: from the side depths err
along the ground."""

STEP = 0.01
"""Edge of a place [m]."""

MIDDLE = 5
"""Depths are the medians of squares of so many pixels."""

STRAY = 3
"""So many pixels of a place reach as high as is believed: fewer are stray."""


def relief_of(frames: Sequence[Frame], stand: PalletStand) -> Relief | None:
    """The relief over a pallet in the frames of a look; None where no camera looks down.

    Args:
        frames: nothing but the load is above the pallet.
        stand: where the pallet is.
    """
    down = [frame for frame in frames if frame.cell_from_camera.rotation[2][2] < -DOWN]
    if not down:
        return None
    length, width, _ = stand.size
    shape = round(length / STEP), round(width / STEP)
    found = [_points(frame, stand, shape) for frame in down]
    places, z = (np.concatenate(each) for each in zip(*found, strict=True))
    order = np.lexsort((-z, places))
    places, z = places[order], z[order]
    first = np.flatnonzero(np.diff(places, prepend=-1))
    counts = np.diff(np.append(first, len(places)))
    enough = counts >= STRAY
    heights = np.full(shape[0] * shape[1], np.nan)
    heights[places[first[enough]]] = z[first[enough] + STRAY - 1]
    return Relief(stand.cell_from_pallet, STEP, heights.reshape(shape))


def _points(frame: Frame, stand: PalletStand, shape: tuple[int, int]) -> tuple[Ints, Narrow]:
    """The number of the place and the height [m] of every pixel that shows something over it."""
    depth = np.asarray(cv2.medianBlur(np.ascontiguousarray(frame.depth, np.float32), MIDDLE))
    pose, k = stand.cell_from_pallet.inverse @ frame.cell_from_camera, frame.depth_k
    right = ((np.arange(depth.shape[1]) - k[0][2]) / k[0][0]).astype(np.float32)
    down = ((np.arange(depth.shape[0]) - k[1][2]) / k[1][1]).astype(np.float32)[:, None]
    x, y, z = (
        (np.float32(a) * right + (np.float32(b) * down + np.float32(c))) * depth + np.float32(t)
        for (a, b, c), t in zip(pose.rotation, pose.translation, strict=True)
    )
    row, column = np.floor(x / np.float32(STEP)), np.floor(y / np.float32(STEP))
    over = (depth > 0.0) & (row >= 0) & (row < shape[0]) & (column >= 0) & (column < shape[1])
    return (row[over] * shape[1] + column[over]).astype(np.int64), z[over]
