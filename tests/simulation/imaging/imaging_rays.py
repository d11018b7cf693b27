"""Rays against boxes by slabs: the long way that the rasteriser is held against."""

import numpy as np

from depal.geometry import OrientedBox
from depal.simulation.imaging.lens import Lens


def cast(boxes: list[OrientedBox], lens: Lens, eye: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Depth along the axis and index of the first box of every pixel's ray; inf and -1."""
    width, height = lens.size
    (fx, fy), (cx, cy) = lens.focal, lens.centre
    columns, rows = np.meshgrid(np.arange(width), np.arange(height))
    rays = np.stack(((columns - cx) / fx, (rows - cy) / fy, np.ones_like(rows, dtype=float)), -1)
    rays = rays @ np.array(lens.cell_from_camera.rotation).T
    depth, part = np.full((height, width), np.inf), np.full((height, width), -1)
    for index, box in enumerate(boxes):
        turn = np.array(box.pose.rotation)
        start = (eye - np.array(box.centre)) @ turn
        way = rays @ turn
        half = np.array(box.size) / 2
        with np.errstate(divide="ignore", invalid="ignore"):
            a, b = (-half - start) / way, (half - start) / way
        first, last = np.minimum(a, b).max(axis=-1), np.maximum(a, b).min(axis=-1)
        hit = (first <= last) & (first > lens.near) & (first < depth)
        depth[hit], part[hit] = first[hit], index
    return depth, part
