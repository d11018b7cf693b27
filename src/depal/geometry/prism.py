"""Upright prisms: boxes as the relations between them see them.

A prism is a box that stands flat: a rectangle on the ground, turned by a yaw, and a height
interval. A perceived box is never perfectly flat; its prism is the tightest one in the box's
own yaw that contains it. Prisms live in rows of an (n, 8) array:
x, y, z of the centre [m], half length, half width, half height [m], cos and sin of the yaw.
"""

import math
from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from depal.geometry.kernel import kernel
from depal.geometry.oriented_box import OrientedBox

PRISM_WIDTH = 8
X, Y, Z, HALF_LENGTH, HALF_WIDTH, HALF_HEIGHT, COS, SIN = range(PRISM_WIDTH)

Array = npt.NDArray[np.float64]
_TILTED = 1e-12
"""Off-diagonal entries of a rotation below this are rounding: the box stands exactly flat."""


def prisms_of(boxes: Iterable[OrientedBox]) -> Array:
    """The prisms of boxes in one frame with z up, (n, 8)."""
    rows = [prism_of(box) for box in boxes]
    return np.array(rows, dtype=np.float64).reshape(-1, PRISM_WIDTH)


def prism_of(box: OrientedBox) -> tuple[float, float, float, float, float, float, float, float]:
    """The prism of one box, one row of `prisms_of`.

    The box's axis nearest to the vertical becomes the prism's height, the longer part of the
    remaining horizontal axis its yaw, folded into (-45, 45] degrees.
    """
    (x, y, z), (length, width, height) = box.pose.translation, box.size
    (r00, r01, r02), (r10, r11, r12), (r20, r21, r22) = box.pose.rotation
    if r00 == 1.0 and r11 == 1.0 and r22 == 1.0:
        return (x, y, z, length / 2, width / 2, height / 2, 1.0, 0.0)
    columns = ((r00, r10, r20), (r01, r11, r21), (r02, r12, r22))
    up = max(range(3), key=lambda axis: (abs(columns[axis][2]), axis))
    forward = columns[(up + 1) % 3]
    c, s = _fold(*_unit(forward[0], forward[1]))
    half = [0.0, 0.0, 0.0]
    for column, edge in zip(columns, box.size, strict=True):
        cx, cy, cz = column
        for axis, reach in enumerate((c * cx + s * cy, c * cy - s * cx, cz)):
            if abs(reach) > _TILTED:
                half[axis] += abs(reach) * edge / 2
    return (x, y, z, half[0], half[1], half[2], c, s)


def _unit(x: float, y: float) -> tuple[float, float]:
    norm = math.hypot(x, y)
    return x / norm, y / norm


def _fold(c: float, s: float) -> tuple[float, float]:
    """The direction among its four quarter turns that lies nearest to the x axis."""
    if abs(s) > abs(c):
        c, s = s, -c
    return (-c, -s) if c < 0 else (c, s)


@kernel
def lateral_interval(prism: Array) -> tuple[float, float]:
    """The prism's extent along y [m]."""
    reach = abs(prism[SIN]) * prism[HALF_LENGTH] + abs(prism[COS]) * prism[HALF_WIDTH]
    return prism[Y] - reach, prism[Y] + reach


@kernel
def slice_at(prism: Array, y: float) -> tuple[float, float]:
    """Where the line at height y in the ground plane cuts the prism's rectangle: x interval [m].

    The line must cross the rectangle.
    """
    c, s, dy = prism[COS], prism[SIN], y - prism[Y]
    low, high = -math.inf, math.inf
    # In the rectangle's own axes a point is (c dx + s dy, c dy - s dx), within +- half edges.
    if abs(c) > _TILTED:
        low = max(low, (-prism[HALF_LENGTH] - s * dy) / c)
        high = min(high, (prism[HALF_LENGTH] - s * dy) / c)
    if abs(s) > _TILTED:
        first, second = (c * dy - prism[HALF_WIDTH]) / s, (c * dy + prism[HALF_WIDTH]) / s
        low, high = max(low, min(first, second)), min(high, max(first, second))
    return prism[X] + low, prism[X] + high


@kernel
def footprint_overlap(a: Array, b: Array) -> float:
    """How deep the rectangles of two prisms reach into each other on the ground [m].

    The smallest shift that parts them, by the separating axis theorem; not positive when they
    are apart (then it is minus the widest gap along one of the four edge directions).
    """
    dx, dy = b[X] - a[X], b[Y] - a[Y]
    turn_c = a[COS] * b[COS] + a[SIN] * b[SIN]
    turn_s = a[COS] * b[SIN] - a[SIN] * b[COS]
    turn_c, turn_s = abs(turn_c), abs(turn_s)
    depth = (
        a[HALF_LENGTH]
        + turn_c * b[HALF_LENGTH]
        + turn_s * b[HALF_WIDTH]
        - abs(a[COS] * dx + a[SIN] * dy)
    )
    depth = min(
        depth,
        a[HALF_WIDTH]
        + turn_s * b[HALF_LENGTH]
        + turn_c * b[HALF_WIDTH]
        - abs(a[COS] * dy - a[SIN] * dx),
    )
    depth = min(
        depth,
        b[HALF_LENGTH]
        + turn_c * a[HALF_LENGTH]
        + turn_s * a[HALF_WIDTH]
        - abs(b[COS] * dx + b[SIN] * dy),
    )
    return min(
        depth,
        b[HALF_WIDTH]
        + turn_s * a[HALF_LENGTH]
        + turn_c * a[HALF_WIDTH]
        - abs(b[COS] * dy - b[SIN] * dx),
    )


@kernel
def holds_centre(a: Array, b: Array) -> bool:
    """Whether the centre of b lies strictly inside a."""
    dx, dy, dz = b[X] - a[X], b[Y] - a[Y], b[Z] - a[Z]
    return bool(
        abs(dz) < a[HALF_HEIGHT]
        and abs(a[COS] * dx + a[SIN] * dy) < a[HALF_LENGTH]
        and abs(a[COS] * dy - a[SIN] * dx) < a[HALF_WIDTH]
    )
