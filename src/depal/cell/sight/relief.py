"""How high what the cameras measure reaches, place by place, whatever boxes are believed there."""

from collections.abc import Sequence

import cv2
import numpy as np
import numpy.typing as npt

from depal.domain import PalletStand
from depal.ports import Frame, Relief

Floats = npt.NDArray[np.float64]

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
    points = np.concatenate([_points(frame, stand) for frame in down])
    rows, columns = (np.floor(points[:, axis] / STEP).astype(int) for axis in (0, 1))
    inside = (rows >= 0) & (rows < shape[0]) & (columns >= 0) & (columns < shape[1])
    places, z = (rows * shape[1] + columns)[inside], points[inside, 2]
    order = np.lexsort((-z, places))
    places, z = places[order], z[order]
    first = np.flatnonzero(np.diff(places, prepend=-1))
    counts = np.diff(np.append(first, len(places)))
    enough = counts >= STRAY
    heights = np.full(shape[0] * shape[1], np.nan)
    heights[places[first[enough]]] = z[first[enough] + STRAY - 1]
    return Relief(stand.cell_from_pallet, STEP, heights.reshape(shape))


def _points(frame: Frame, stand: PalletStand) -> Floats:
    """(n, 3) what a depth picture shows, in the pallet's frame [m]."""
    depth = cv2.medianBlur(np.ascontiguousarray(frame.depth, dtype=np.float32), MIDDLE)
    rows, columns = np.nonzero(np.asarray(depth) > 0.0)
    z = np.asarray(depth)[rows, columns].astype(np.float64)
    k = np.array(frame.depth_k)
    seen = np.column_stack(((columns - k[0, 2]) / k[0, 0] * z, (rows - k[1, 2]) / k[1, 1] * z, z))
    pose = stand.cell_from_pallet.inverse @ frame.cell_from_camera
    return np.asarray(seen @ np.array(pose.rotation).T + np.array(pose.translation))
