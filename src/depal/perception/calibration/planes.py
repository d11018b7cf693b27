"""Measured and true depths on planes whose places are known.

The planes are the plates of the markers, and the floor around those that lie on it. Their true
depths follow from the camera's pose, which the colour picture gave.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from depal.domain import Fiducial
from depal.geometry import Matrix3, Pose
from depal.perception.calibration.finding import corners_of, projected
from depal.perception.calibration.markers import PLATE

Floats = npt.NDArray[np.float64]

FLOOR = 0.02
"""A marker that faces up below this height lies on the floor, which is at height 0 [m]."""

AROUND = 3.4
"""The floor around such a marker is used so far: edge of the square by the marker's own."""

BLOCK = 12
"""Edge of a block of pixels, whose errors are no more independent than one."""

MEASURED = 0.4
"""A block counts when so much of it was measured."""

FARTHEST_OFF = 0.03
"""A block whose ratio of true and measured depth is farther from 1 shows something else."""

FEWEST = 4
"""So few blocks of a plane count."""

PLACED = 0.001
"""How well plates and floor are where the cell file says, along their normals [m]."""


@dataclass(frozen=True, slots=True)
class PlaneDepth:
    """What depth says of one plane.

    Attributes:
        measured: a depth in its middle [m].
        true: the same depth as it is [m].
        error: standard deviation between the two, the plane's own place included [m].
        blocks: how many blocks of pixels it was found from.
    """

    measured: float
    true: float
    error: float
    blocks: int


def plane_depths(
    depth: npt.NDArray[np.float32],
    k: Matrix3,
    cell_from_camera: Pose,
    fiducials: Iterable[Fiducial],
) -> tuple[PlaneDepth, ...]:
    """What a depth picture says of the planes of markers.

    Args:
        depth: (h, w) [m]; 0 where nothing was measured.
        k: its intrinsics.
        cell_from_camera: its pose.
        fiducials: those that are seen.

    Returns:
        One for each plane with enough pixels.
    """
    planes = list[PlaneDepth]()
    for fiducial in fiducials:
        plates = [_true_depths(depth.shape, k, cell_from_camera, fiducial, PLATE, None)]
        facing_up = fiducial.cell_from_marker.rotation[2][2] < -0.99  # noqa: PLR2004
        if facing_up and fiducial.cell_from_marker.translation[2] <= FLOOR:
            ground = _true_depths(depth.shape, k, cell_from_camera, fiducial, AROUND, 0.0)
            plates = [] if ground is None else [ground]
        for plate in plates:
            plane = None if plate is None else _judged(depth, plate)
            if plane is not None:
                planes.append(plane)
    return tuple(planes)


@dataclass(frozen=True, slots=True, eq=False)
class _Plane:
    """A part of a picture in which a plane is expected.

    Attributes:
        part: rows and columns.
        true: depth there [m]; 0 where the plane is not.
        cosine: between its normal and a ray of unit depth, in its middle.
    """

    part: tuple[slice, slice]
    true: Floats
    cosine: float


def _true_depths(
    shape: tuple[int, ...],
    k: Matrix3,
    cell_from_camera: Pose,
    fiducial: Fiducial,
    edge: float,
    height: float | None,
) -> _Plane | None:
    """Where a plane is seen, and how deep; with a height the floor around the plate."""
    corners = corners_of(fiducial, edge)
    hole = corners_of(fiducial, PLATE) if height is not None else None
    if height is not None:
        corners[:, 2] = height
    at = projected(corners, k, cell_from_camera)
    rows, columns = shape
    left, top = np.clip(np.floor(at[:, :2].min(axis=0)), 0, (columns, rows)).astype(int)
    right, bottom = np.clip(np.ceil(at[:, :2].max(axis=0)) + 1, 0, (columns, rows)).astype(int)
    if at[:, 2].min() <= 0.0 or right - left < BLOCK or bottom - top < BLOCK:
        return None
    inside = np.zeros((bottom - top, right - left), dtype=np.uint8)
    cv2.fillConvexPoly(inside, np.rint(at[:, :2] - (left, top)).astype(np.int32), 1)
    if hole is not None:
        plate = projected(hole, k, cell_from_camera)[:, :2] - (left, top)
        cv2.fillConvexPoly(inside, np.rint(plate).astype(np.int32), 0)
    # The rim is left out: depths bleed over edges.
    inside = np.asarray(cv2.erode(inside, np.ones((5, 5), dtype=np.uint8), borderValue=0))
    into = np.array(fiducial.cell_from_marker.rotation)[:, 2]
    normal = np.array(cell_from_camera.rotation).T @ into
    middle = np.array(cell_from_camera.inverse.apply(_centre(corners)))
    (fx, _, cx), (_, fy, cy), _ = k
    x, y = (np.arange(left, right) - cx) / fx, (np.arange(top, bottom) - cy) / fy
    towards = normal[0] * x[None, :] + normal[1] * y[:, None] + normal[2]
    true = np.where(inside > 0, normal @ middle / np.where(towards > 0.0, towards, np.inf), 0.0)
    cosine = float(normal @ middle / middle[2])
    return _Plane((slice(top, bottom), slice(left, right)), true, cosine)


def _centre(corners: Floats) -> tuple[float, float, float]:
    x, y, z = corners.mean(axis=0).tolist()
    return x, y, z


def _judged(depth: npt.NDArray[np.float32], plane: _Plane) -> PlaneDepth | None:
    """A plane's depths in one figure: a mean with Tukey's weights over the blocks' medians."""
    ratios = _ratios(depth[plane.part].astype(np.float64), plane.true)
    near = ratios[np.abs(ratios - 1.0) <= FARTHEST_OFF]
    if len(near) < FEWEST:
        return None
    ratio, weights = float(np.median(near)), np.ones_like(near)
    width = max(1.4826 * float(np.median(np.abs(near - ratio))), 1e-6)
    for _ in range(8):
        weights = np.maximum(1.0 - ((near - ratio) / (4.7 * width)) ** 2, 0.0) ** 2
        ratio = float(weights @ near / weights.sum())
    true = float(np.median(plane.true[plane.true > 0.0]))
    noise = true * width / np.sqrt(weights.sum())
    error = float(np.hypot(noise, PLACED / max(plane.cosine, 0.05)))
    return PlaneDepth(true / ratio, true, error, len(near))


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
