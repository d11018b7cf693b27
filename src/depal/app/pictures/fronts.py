"""Where the side of a box that looks most to a camera lies in its picture."""

import math

import numpy as np
import numpy.typing as npt

from depal.geometry import OrientedBox
from depal.ports import Frame

Floats = npt.NDArray[np.float64]

FRONT = 4
"""A face has so many corners."""


def front_of(frame: Frame, shape: OrientedBox) -> Floats | None:
    """The outline of one face in the colour picture.

    Args:
        frame: whose pose and intrinsics count.
        shape: upright, in the cell frame.

    Returns:
        (4, 2) corners [pixel]; None where the face is not whole in the picture.
    """
    eye = np.array(frame.cell_from_camera.translation)
    axes = np.array(shape.pose.rotation)
    way = axes.T @ (eye - np.array(shape.centre))
    axis = int(np.abs(way[:2] / np.array(shape.size[:2])).argmax())
    side = math.copysign(0.5, way[axis])
    others = [k for k in range(3) if k != axis]
    local = np.zeros((FRONT, 3))
    local[:, axis] = side
    local[:, others] = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]
    corners = local * np.array(shape.size) @ axes.T + np.array(shape.centre)
    seen = frame.cell_from_camera.inverse
    inside = corners @ np.array(seen.rotation).T + np.array(seen.translation)
    if (inside[:, 2] <= 0).any():
        return None
    found = (inside / inside[:, 2:]) @ np.array(frame.colour_k).T
    height, width = frame.colour.shape[:2]
    within = (found[:, :2] >= 0).all() and (found[:, :2] < (width, height)).all()
    return np.asarray(found[:, :2]) if within else None
