"""What a depth picture says of planes whose true depths follow from the camera's pose."""

from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from depal.geometry import Matrix3, Pose
from depal.perception.calibration.finding import projected
from depal.perception.calibration.surfaces import Surface

Floats = npt.NDArray[np.float64]

BLOCK = 12
"""Edge of a block of pixels, of which the median counts."""

ALIKE = 2.0
"""Errors of neighbouring blocks are alike: their mean is so many times worse than of others."""

BLEEDING = 0.009
"""Depths bleed over edges so far [focal length]."""

MEASURED = 0.4
"""A block counts when so much of it was measured."""

FARTHEST_OFF = 0.03
"""A block whose ratio of true and measured depth is farther from 1 shows something else."""

FEWEST = 4
"""So few blocks of a plane count."""

PLACED = 0.001
"""How well surfaces are where the cell file says, along their normals [m]."""


@dataclass(frozen=True, slots=True)
class PlaneDepth:
    """What depth says of one plane.

    Attributes:
        measured: a depth in its middle [m].
        true: the same depth as it is [m].
        error: standard deviation between the two, the plane's own place included [m].
        slant: how much deeper it gets from a pixel to the next one [m].
        blocks: how many blocks of pixels it was found from.
    """

    measured: float
    true: float
    error: float
    slant: float = 0.0
    blocks: int = 0


def plane_depth(
    depth: npt.NDArray[np.float32], k: Matrix3, cell_from_camera: Pose, surface: Surface
) -> PlaneDepth | None:
    """Compares measured and true depths of a surface.

    Args:
        depth: (h, w) [m]; 0 where nothing was measured.
        k: its intrinsics.
        cell_from_camera: its pose.
        surface: where it is; parts that something hides are told by their depths.

    Returns:
        A mean with Tukey's weights over the medians of blocks; None where too little is seen.
    """
    at = projected(surface.corners, k, cell_from_camera)
    rows, columns = depth.shape
    left, top = np.clip(np.floor(at[:, :2].min(axis=0)), 0, (columns, rows)).astype(int)
    right, bottom = np.clip(np.ceil(at[:, :2].max(axis=0)) + 1, 0, (columns, rows)).astype(int)
    if at[:, 2].min() <= 0.0 or right - left < BLOCK or bottom - top < BLOCK:
        return None
    inside = _covered(surface, (left, top, right, bottom), k, cell_from_camera)
    normal = -np.array(cell_from_camera.rotation).T @ surface.outward
    x, y, z = surface.corners.mean(axis=0).tolist()
    middle = np.array(cell_from_camera.inverse.apply((x, y, z)))
    (fx, _, cx), (_, fy, cy), _ = k
    rays_x, rays_y = (np.arange(left, right) - cx) / fx, (np.arange(top, bottom) - cy) / fy
    towards = normal[0] * rays_x[None, :] + normal[1] * rays_y[:, None] + normal[2]
    there = (inside > 0) & (towards > 0.0)
    true = np.where(there, normal @ middle / np.where(there, towards, 1.0), 0.0)
    near = _ratios(depth[top:bottom, left:right].astype(np.float64), true)
    near = near[np.abs(near - 1.0) <= FARTHEST_OFF]
    if len(near) < FEWEST:
        return None
    ratio, error = _mean(near)
    deep = float(np.median(true[there]))
    cosine = float(normal @ middle / middle[2])
    slant = deep * float(np.hypot(normal[0] / fx, normal[1] / fy)) / cosine
    placed = PLACED / cosine
    return PlaneDepth(deep / ratio, deep, float(np.hypot(error * deep, placed)), slant, len(near))


def merged(planes: list[PlaneDepth]) -> PlaneDepth:
    """One plane in several pictures: their mean, whose error is no smaller: most of it stays."""
    measured = float(np.mean([plane.measured / plane.true for plane in planes])) * planes[0].true
    error = float(np.mean([plane.error for plane in planes]))
    return PlaneDepth(measured, planes[0].true, error, planes[0].slant, planes[0].blocks)


def _covered(
    surface: Surface, window: tuple[int, int, int, int], k: Matrix3, cell_from_camera: Pose
) -> npt.NDArray[np.uint8]:
    """Which pixels of a window lie well within a surface."""
    left, top, right, bottom = window
    inside = np.zeros((bottom - top, right - left), dtype=np.uint8)
    for corners, value in ((surface.corners, 1), (surface.hole, 0)):
        if corners is not None:
            at = projected(corners, k, cell_from_camera)[:, :2] - (left, top)
            cv2.fillConvexPoly(inside, np.rint(at).astype(np.int32), value)
    rim = round(BLEEDING * k[0][0]) if surface.edged else 1
    square = np.ones((2 * rim + 1, 2 * rim + 1), dtype=np.uint8)
    return np.asarray(cv2.erode(inside, square, borderValue=0), dtype=np.uint8)


def _mean(ratios: Floats) -> tuple[float, float]:
    """A mean with Tukey's weights, and its standard deviation."""
    mean, weights = float(np.median(ratios)), np.ones_like(ratios)
    width = max(1.4826 * float(np.median(np.abs(ratios - mean))), 1e-6)
    for _ in range(8):
        weights = np.maximum(1.0 - ((ratios - mean) / (4.7 * width)) ** 2, 0.0) ** 2
        mean = float(weights @ ratios / weights.sum())
    return mean, ALIKE * width / float(np.sqrt(weights.sum()))


def _ratios(measured: Floats, true: Floats) -> Floats:
    """True by measured depth: medians over squares of `BLOCK` pixels, (n,)."""
    kept = list[float]()
    for top in range(0, true.shape[0], BLOCK):
        for left in range(0, true.shape[1], BLOCK):
            part = (slice(top, top + BLOCK), slice(left, left + BLOCK))
            there = true[part] > 0.0
            both = there & (measured[part] > 0.0)
            count = int(np.count_nonzero(both))
            if count >= max(BLOCK * BLOCK // 4, MEASURED * np.count_nonzero(there)):
                kept.append(float(np.median(true[part][both] / measured[part][both])))
    return np.array(kept)
