"""Straight lines of sight against boxes and capsules."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Self

import numpy as np
import numpy.typing as npt

from depal.geometry.kernel import loop_kernel
from depal.geometry.oriented_box import OrientedBox

Floats = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]

NEAR = 1e-9
"""Lines shorter than this across a face count as parallel to it [m]; an axis is a point below its
root."""


@dataclass(frozen=True, slots=True, eq=False)
class Blockers:
    """What nobody sees through, in one frame.

    Attributes:
        centres: (m, 3) of the boxes [m].
        rotations: (m, 9) their axes, row by row.
        halves: (m, 3) half edges [m].
        capsules: (k, 7) both ends of the axis and the radius [m].
    """

    centres: Floats
    rotations: Floats
    halves: Floats
    capsules: Floats

    @classmethod
    def of(cls, boxes: Iterable[OrientedBox], capsules: Floats | None = None) -> Self:
        """Boxes and capsules in one frame."""
        listed = list(boxes)
        return cls(
            np.array([box.centre for box in listed], dtype=float).reshape(-1, 3),
            np.array([box.pose.rotation for box in listed], dtype=float).reshape(-1, 9),
            np.array([box.size for box in listed], dtype=float).reshape(-1, 3) / 2,
            np.empty((0, 7)) if capsules is None else np.ascontiguousarray(capsules, dtype=float),
        )

    def between(self, starts: Floats, ends: Floats) -> Flags:
        """Which lines meet something.

        Args:
            starts: (n, 3) [m].
            ends: (n, 3) not at their starts [m].

        Returns:
            (n,) whether the line is blocked.
        """
        lines = np.column_stack((starts, ends))
        blocked = np.zeros(len(lines), dtype=np.bool_)
        _block(lines, self.centres, self.rotations, self.halves, self.capsules, blocked)
        return blocked


@loop_kernel
def _block(
    lines: Floats,
    centres: Floats,
    rotations: Floats,
    halves: Floats,
    capsules: Floats,
    blocked: Flags,
) -> None:
    """Fills `blocked`, (n,), for `lines`, (n, 6): start and end."""
    for n in range(lines.shape[0]):
        for m in range(centres.shape[0]):
            if _meets_box(lines, n, centres, rotations, halves, m):
                blocked[n] = True
                break
        if not blocked[n]:
            for k in range(capsules.shape[0]):
                if _meets_capsule(lines, n, capsules, k):
                    blocked[n] = True
                    break


@loop_kernel
def _meets_box(
    lines: Floats, n: int, centres: Floats, rotations: Floats, halves: Floats, m: int
) -> bool:
    """Whether line n meets box m: the method of slabs."""
    x, y, z = lines[n, 0], lines[n, 1], lines[n, 2]
    dx, dy, dz = lines[n, 3] - x, lines[n, 4] - y, lines[n, 5] - z
    ox, oy, oz = x - centres[m, 0], y - centres[m, 1], z - centres[m, 2]
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
def _meets_capsule(lines: Floats, n: int, capsules: Floats, k: int) -> bool:
    """Whether line n comes nearer to the axis of capsule k than its radius.

    Closest points of two segments (Ericson, Real-Time Collision Detection, 5.1.9).
    """
    x, y, z = lines[n, 0], lines[n, 1], lines[n, 2]
    dx, dy, dz = lines[n, 3] - x, lines[n, 4] - y, lines[n, 5] - z
    ax, ay, az = capsules[k, 0], capsules[k, 1], capsules[k, 2]
    bx, by, bz = capsules[k, 3] - ax, capsules[k, 4] - ay, capsules[k, 5] - az
    rx, ry, rz = x - ax, y - ay, z - az
    a, e = dx * dx + dy * dy + dz * dz, bx * bx + by * by + bz * bz
    f, c = bx * rx + by * ry + bz * rz, dx * rx + dy * ry + dz * rz
    b = dx * bx + dy * by + dz * bz
    if e > NEAR:
        det = a * e - b * b
        s = min(max((b * f - c * e) / det, 0.0), 1.0) if det > NEAR else 0.0
        t = (b * s + f) / e
    else:
        s, t = min(max(-c / a, 0.0), 1.0), 0.0
    if t < 0.0:
        t, s = 0.0, min(max(-c / a, 0.0), 1.0)
    elif t > 1.0:
        t, s = 1.0, min(max((b - c) / a, 0.0), 1.0)
    gx, gy, gz = rx + dx * s - bx * t, ry + dy * s - by * t, rz + dz * s - bz * t
    return bool(math.sqrt(gx * gx + gy * gy + gz * gz) < capsules[k, 6])
