"""What a camera can see: lines of sight against boxes and capsules."""

import math

import numpy as np
import numpy.typing as npt

from depal.geometry import loop_kernel

Floats = npt.NDArray[np.float64]

NEAR = 1e-9
"""Directions shorter than this count as parallel to a face."""


@loop_kernel
def count_visible(
    points: Floats,
    eye: Floats,
    centres: Floats,
    rotations: Floats,
    halves: Floats,
    capsules: Floats,
    visible: npt.NDArray[np.bool_],
) -> int:
    """Which points the eye sees, over everything solid.

    Args:
        points: (n, 3) just before the surfaces that they are on [m].
        eye: (3,) [m].
        centres: (m, 3) of the boxes [m].
        rotations: (m, 9) their axes in the cell, row by row.
        halves: (m, 3) half edges [m].
        capsules: (k, 7) ends and radius [m].
        visible: (n,) is filled.

    Returns:
        How many are visible.
    """
    count = 0
    for n in range(points.shape[0]):
        dx, dy, dz = points[n, 0] - eye[0], points[n, 1] - eye[1], points[n, 2] - eye[2]
        seen = True
        for m in range(centres.shape[0]):
            if _box_between(eye, dx, dy, dz, centres, rotations, halves, m):
                seen = False
                break
        if seen:
            for k in range(capsules.shape[0]):
                if _capsule_between(eye, dx, dy, dz, capsules, k):
                    seen = False
                    break
        visible[n] = seen
        count += seen
    return count


@loop_kernel
def _box_between(
    eye: Floats,
    dx: float,
    dy: float,
    dz: float,
    centres: Floats,
    rotations: Floats,
    halves: Floats,
    m: int,
) -> bool:
    """Whether the segment from the eye along (dx, dy, dz) meets box m: the method of slabs."""
    ox, oy, oz = eye[0] - centres[m, 0], eye[1] - centres[m, 1], eye[2] - centres[m, 2]
    first, last = 0.0, 1.0
    for axis in range(3):
        ax, ay, az = rotations[m, axis], rotations[m, 3 + axis], rotations[m, 6 + axis]
        start = ax * ox + ay * oy + az * oz
        way = ax * dx + ay * dy + az * dz
        half = halves[m, axis]
        if abs(way) < NEAR:
            if abs(start) > half:
                return False
        else:
            low, high = (-half - start) / way, (half - start) / way
            first, last = max(first, min(low, high)), min(last, max(low, high))
            if first > last:
                return False
    return True


@loop_kernel
def _capsule_between(
    eye: Floats, dx: float, dy: float, dz: float, capsules: Floats, k: int
) -> bool:
    """Whether the segment comes nearer to capsule k's axis than its radius."""
    ax, ay, az = capsules[k, 0], capsules[k, 1], capsules[k, 2]
    bx, by, bz = capsules[k, 3] - ax, capsules[k, 4] - ay, capsules[k, 5] - az
    rx, ry, rz = eye[0] - ax, eye[1] - ay, eye[2] - az
    a, e = dx * dx + dy * dy + dz * dz, bx * bx + by * by + bz * bz
    f, c = bx * rx + by * ry + bz * rz, dx * rx + dy * ry + dz * rz
    b = dx * bx + dy * by + dz * bz
    det = a * e - b * b
    s = min(max((b * f - c * e) / det, 0.0), 1.0) if det > NEAR else 0.0
    t = (b * s + f) / e if e > NEAR else 0.0
    if t < 0.0:
        t, s = 0.0, min(max(-c / a, 0.0), 1.0)
    elif t > 1.0:
        t, s = 1.0, min(max((b - c) / a, 0.0), 1.0)
    gx, gy, gz = rx + dx * s - bx * t, ry + dy * s - by * t, rz + dz * s - bz * t
    return bool(math.sqrt(gx * gx + gy * gy + gz * gz) < capsules[k, 6])
