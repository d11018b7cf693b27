"""Where a recorded frame stands: what is level in it, and where boxes may be.

A camera of a cell knows its pose, and the cell knows its pallet. A frame from elsewhere may know
neither: then the plane that most of the picture lies in is taken as level, with the camera above.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

import cv2
import numpy as np
import numpy.typing as npt

from depal.errors import FrameError, Problem
from depal.geometry import Pose
from depal.perception.rasters import Region
from depal.perception.rasters.region import BELOW
from depal.ports import Frame

Floats = npt.NDArray[np.float64]

EVERY = 4
"""Every so many pixels along rows and columns are looked at."""

TRIES = 300
"""So many planes are tried."""

WITHIN = 0.012
"""A point lies in a plane when it is nearer, by its distance from the camera."""

FEWEST = 500
"""So many depths are needed to say anything."""

LAYER = 0.02
"""Heights are counted in such steps [m]."""

FLOOR = 0.04
"""The ground is the lowest layer with such a share of what is seen."""

ABOVE = 0.05
"""What is lower above the ground is no box [m]."""

LARGE = 0.01
"""Connected things are as large as this share of the picture; smaller ones are specks."""

AROUND = 0.06
"""Boxes are looked for so far beyond what is seen of them [m]."""

RARE = 0.3
"""So many per cent of the points at every end are specks."""

STEEP = math.radians(65)
"""For a camera that looks down more steeply, far away is where the picture's upper edge is."""


def levelled(frame: Frame) -> Frame:
    """A frame with a pose from what it shows: z up from its greatest plane, x away, at its foot.

    Args:
        frame: its own pose is not used.

    Raises:
        FrameError: there are too few depths to find a plane.
    """
    points = _points(frame)
    normal, middle = _greatest_plane(points)
    up = -normal if normal @ middle > 0 else normal
    away = np.array((0.0, -1.0, 0.0)) if abs(up[2]) > math.sin(STEEP) else np.array((0.0, 0.0, 1.0))
    away -= up * (up @ away)
    away /= np.linalg.norm(away)
    turn = np.vstack((away, np.cross(up, away), up))
    foot = up * (up @ middle)
    return replace(frame, cell_from_camera=Pose.from_arrays(-turn @ foot, turn))


def region_in(frames: Sequence[Frame]) -> Region:
    """Where the things stand that the frames of one look are aimed at.

    Of each picture these are the connected things above the ground that are nearest to its middle.

    Args:
        frames: with their poses; z of the cell is up. The first one says what is far away.

    Raises:
        FrameError: there are too few depths, or nothing stands on the ground.
    """
    grids = [_in_cell(frame) for frame in frames]
    ground = _ground(np.concatenate([grid[..., 2][~np.isnan(grid[..., 2])] for grid in grids]))
    things = np.concatenate([_aimed_at(grid, ground) for grid in grids])
    if len(things) < FEWEST // 10:
        raise FrameError("depth.png", [Problem("", "nothing stands above the ground", "boxes")])
    turn = np.array(frames[0].cell_from_camera.rotation)
    forward, upper = turn[:, 2], -turn[:, 1]
    ahead = upper if -forward[2] > math.sin(STEEP) else forward
    away = np.array((ahead[0], ahead[1], 0.0)) / np.hypot(ahead[0], ahead[1])
    left = np.array((-away[1], away[0], 0.0))
    axes = np.vstack((away, left, (0.0, 0.0, 1.0)))
    low, high = np.percentile(things @ axes.T, (RARE, 100 - RARE), axis=0)
    low, high = low - AROUND, high + AROUND
    low[2] = ground - BELOW
    origin = np.array((low[0], (low[1] + high[1]) / 2, low[2])) @ axes
    deep, wide, tall = (high - low).tolist()
    return Region(Pose.from_arrays(origin, axes.T), (deep, wide, tall), BELOW)


def _aimed_at(grid: Floats, ground: float) -> Floats:
    """The points of the connected things nearest to a picture's middle, (n, 3)."""
    above = (np.nan_to_num(grid[..., 2], nan=-np.inf) > ground + ABOVE).astype(np.uint8)
    closed = cv2.morphologyEx(above, cv2.MORPH_CLOSE, np.ones((3, 3), dtype=np.uint8))
    count, labels, stats, middles = cv2.connectedComponentsWithStats(closed)
    large = [k for k in range(1, count) if stats[k, cv2.CC_STAT_AREA] > LARGE * above.size]
    if not large:
        return np.empty((0, 3))
    middle = np.array(above.shape[::-1]) / 2
    nearest = min(large, key=lambda k: float(np.linalg.norm(middles[k] - middle)))
    return np.asarray(grid[(labels == nearest) & (above > 0)])


def _in_cell(frame: Frame) -> Floats:
    """Some of what is measured, (h, w, 3) in the cell [m]; NaN where nothing is."""
    pose = frame.cell_from_camera
    return np.asarray(_grid(frame) @ np.array(pose.rotation).T + pose.translation)


def _points(frame: Frame) -> Floats:
    """The same, (n, 3) in the camera's frame, without what is not measured [m]."""
    grid = _grid(frame)
    return np.asarray(grid[~np.isnan(grid[..., 2])])


def _grid(frame: Frame) -> Floats:
    """Some of what is measured, (h, w, 3) in the camera's frame [m]; NaN where nothing is."""
    (fx, _, cx), (_, fy, cy), _ = frame.depth_k
    z = frame.depth[::EVERY, ::EVERY].astype(np.float64)
    rows, columns = np.indices(z.shape) * EVERY
    measured = int((z > 0).sum())
    if measured < FEWEST:
        what = f"{measured} of {z.size} depths are measured"
        raise FrameError("depth.png", [Problem("", what, f"at least {FEWEST}")])
    z[z <= 0] = np.nan
    return np.stack(((columns - cx) / fx * z, (rows - cy) / fy * z, z), axis=-1)


def _greatest_plane(points: Floats) -> tuple[Floats, Floats]:
    """Normal and middle of the plane that most points lie in (RANSAC, then least squares)."""
    random = np.random.default_rng(0)
    reach = WITHIN * np.linalg.norm(points, axis=1)
    best = np.zeros(len(points), dtype=np.bool_)
    for _ in range(TRIES):
        a, b, c = points[random.integers(len(points), size=3)]
        normal = np.cross(b - a, c - a)
        length = float(np.linalg.norm(normal))
        if length < 1e-9:  # noqa: PLR2004 - three points in a line
            continue
        inside = np.abs((points - a) @ (normal / length)) < reach
        if inside.sum() > best.sum():
            best = inside
    middle = points[best].mean(axis=0)
    _, _, axes = np.linalg.svd(points[best] - middle, full_matrices=False)
    return axes[2], middle


def _ground(heights: Floats) -> float:
    """The height of the lowest layer with much in it [m]."""
    low = float(np.percentile(heights, RARE))
    layers = np.maximum(np.floor((heights - low) / LAYER).astype(int), 0)
    counts = np.bincount(layers)
    both = counts + np.append(counts[1:], 0)
    lowest = int(np.flatnonzero(both >= FLOOR * len(heights))[0])
    return float(np.median(heights[(layers == lowest) | (layers == lowest + 1)]))
