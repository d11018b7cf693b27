"""From the frames of one look to the two rasters of a pile."""

from collections.abc import Sequence

import cv2
import numpy as np
import numpy.typing as npt

from depal.geometry import Pose
from depal.geometry.abreast import abreast
from depal.perception.faces import Facing, Raster
from depal.perception.rasters import kernels
from depal.perception.rasters.region import Region
from depal.ports import Frame

Floats = npt.NDArray[np.float64]
Narrow = npt.NDArray[np.float32]

STEP = 0.003
"""Edge of a raster's pixel [m]."""

FINER = 2
"""Depths are gathered in pixels this many times as wide as colours."""

REACH = 0.022
"""Normals are taken over twice so much of a surface, seen squarely [m]."""

JUMP = 0.03
"""Depths that differ by more than this share are different surfaces."""

FLATTEST = 0.6
"""Cosine between a surface's normal and the viewing direction beyond which it is left out."""

SMOOTH = 0.03
"""Depths are averaged over twice so much of a surface [m]."""

SAME = 0.022
"""Depths that differ by less belong to one surface [m]."""

GROWN = 0.018
"""Surfaces are carried on over their edges by so much [m]."""

FLAT = 0.04
"""What faces up and lies less than this above the ground is the ground [m]."""

SPARE = 4
"""A raster shows so many coarse pixels around what is known."""

HIDDEN = 0.06
"""A place so far behind what a camera measures is hidden from it [m]."""


def rasters_of(
    frames: Sequence[Frame], region: Region, step: float = STEP
) -> tuple[Raster, Raster]:
    """The front elevation and the top plan of what stands in a region.

    Args:
        frames: of one look, one per camera.
        region: what is searched.
        step: edge of a pixel [m].

    Returns:
        The raster of what faces the viewer, and of what faces up.
    """
    surfaces = abreast(_surface, frames)
    front, top = abreast(
        lambda facing: _raster(facing, frames, surfaces, region, step), (Facing.FRONT, Facing.TOP)
    )
    return front, top


def intrinsics(k: Sequence[Sequence[float]]) -> Floats:
    """(4,) fx, fy, cx, cy of a camera matrix."""
    return np.array([k[0][0], k[1][1], k[0][2], k[1][2]])


def carried(pose: Pose) -> Floats:
    """(3, 4) of a pose, as the kernels take it."""
    return np.column_stack((np.array(pose.rotation), np.array(pose.translation)))


def _surface(frame: Frame) -> tuple[Narrow, Narrow]:
    """Depths without specks, and normals."""
    depth = np.ascontiguousarray(frame.depth, dtype=np.float32)
    k = intrinsics(frame.depth_k)
    measured = depth[depth > 0.0]
    usual = float(np.median(measured)) if measured.size else 1.0
    reach = max(int(REACH * k[0] / usual), 2)
    smooth = _blurred(depth, reach)
    normals = np.empty((*depth.shape, 3), dtype=np.float32)
    kernels.normals(smooth, k, reach, JUMP, normals)
    return depth, normals


def _blurred(depth: Narrow, reach: int) -> Narrow:
    """The mean of the known depths around each known one."""
    known = (depth > 0.0).astype(np.float32)
    size = (2 * (reach // 2) + 1,) * 2
    total = cv2.boxFilter(depth, -1, size, normalize=False)
    count = cv2.boxFilter(known, -1, size, normalize=False)
    mean = total / np.maximum(count, 1.0)
    near = np.abs(mean - depth) < JUMP / 3 * depth
    return np.asarray(np.where(near, mean, depth), dtype=np.float32)


def _raster(
    facing: Facing,
    frames: Sequence[Frame],
    surfaces: Sequence[tuple[Narrow, Narrow]],
    region: Region,
    step: float,
) -> Raster:
    region_from_raster, shape = region.frame_of(facing, step, FINER)
    cell_from_raster = region.cell_from_region @ region_from_raster
    depths = _depths(facing, frames, surfaces, region, cell_from_raster, shape, step)
    (first, last), (left, right) = _known_part(depths[1])
    smooth, reached = (_finer(each[first:last, left:right]) for each in depths)
    coarse = step * FINER
    cell_from_raster = cell_from_raster @ Pose((left * coarse, first * coarse, 0.0))
    rows, columns = smooth.shape
    weight = np.zeros((rows, columns), dtype=np.float32)
    colour = np.zeros((rows, columns, 3), dtype=np.float32)
    for frame in frames:
        pose = carried(frame.cell_from_camera.inverse @ cell_from_raster)
        k = intrinsics(frame.colour_k)
        scale = frame.depth_k[0][0] / frame.colour_k[0][0]
        depth = np.ascontiguousarray(frame.depth, dtype=np.float32)
        kernels.gather(reached, frame.colour, depth, scale, k, pose, step, HIDDEN, weight, colour)
    seen = (weight > 0.0) & np.isfinite(smooth)
    picture = np.clip(np.round(colour), weight[..., None] > 0.0, 255).astype(np.uint8)
    return Raster(facing, cell_from_raster, step, picture, smooth, np.asarray(seen))


def _known_part(reached: Narrow) -> tuple[tuple[int, int], tuple[int, int]]:
    """The rows and columns that hold all that is known, and a little more."""
    known = np.isfinite(reached)
    spans = []
    for axis in (1, 0):
        some = np.flatnonzero(known.any(axis=axis))
        first, last = (int(some[0]), int(some[-1]) + 1) if some.size else (0, 1)
        size = known.shape[1 - axis]
        spans.append((max(first - SPARE, 0), min(last + SPARE, size)))
    return spans[0], spans[1]


def _finer(coarse: Narrow) -> Narrow:
    """Each pixel as `FINER` times as many along rows and columns."""
    return np.ascontiguousarray(np.repeat(np.repeat(coarse, FINER, axis=0), FINER, axis=1))


def _depths(
    facing: Facing,
    frames: Sequence[Frame],
    surfaces: Sequence[tuple[Narrow, Narrow]],
    region: Region,
    cell_from_raster: Pose,
    shape: tuple[int, int],
    step: float,
) -> tuple[Narrow, Narrow]:
    """The smoothed depths, and the same carried on over the edges of surfaces, both coarse."""
    coarse, shift = step * FINER, step * (FINER - 1) / 2
    cell_from_coarse = cell_from_raster @ Pose((shift, shift, 0.0))
    deepest = region.size[0] if facing is Facing.FRONT else region.size[2] - region.ground - FLAT
    size = (shape[0] // FINER, shape[1] // FINER)
    nearest = np.full(size, np.inf, dtype=np.float32)
    total, count = np.zeros(size, dtype=np.float32), np.full(size, -1.0, dtype=np.float32)
    for _ in range(2):
        for frame, (depth, normals) in zip(frames, surfaces, strict=True):
            pose = carried(cell_from_coarse.inverse @ frame.cell_from_camera)
            view = (intrinsics(frame.depth_k), pose, coarse, FLATTEST, deepest)
            kernels.splat(depth, normals, *view, nearest, total, count)
        count[:] = np.maximum(count, 0.0)
    with np.errstate(invalid="ignore", divide="ignore"):
        closed = _closed(np.where(count > 0.0, total / count, np.float32(np.inf)))
    if facing is Facing.FRONT:
        closed[round((region.size[2] - region.ground) / coarse) :] = np.inf
    smooth = np.empty_like(closed)
    kernels.level(closed, round(SMOOTH / coarse), SAME, smooth)
    reached = _grown(np.where(np.isnan(smooth), np.inf, smooth), round(GROWN / coarse))
    return smooth, reached.astype(np.float32)


def _grown(depth: Narrow, pixels: int) -> Narrow:
    """Surfaces carried on a little over their edges, where depths are often missing.

    Of two surfaces that meet there the nearer one goes on: an edge is its own.
    """
    square = np.ones((3, 3), dtype=np.uint8)
    for _ in range(pixels):
        nearer = cv2.erode(depth, square)
        depth = np.where(np.isfinite(depth), depth, nearer)
    return depth


def _closed(nearest: Narrow) -> Narrow:
    """Holes between splats filled with the median of what is around them; specks removed."""
    filled = np.where(np.isfinite(nearest), nearest, np.float32(1e6)).astype(np.float32)
    median = cv2.medianBlur(filled, 5)
    return np.where(median < 1e5, median, np.float32(np.inf)).astype(np.float32)  # noqa: PLR2004
