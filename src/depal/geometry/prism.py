"""Upright prisms: boxes as the relations between them see them.

A prism is a box that stands flat: a rectangle on the ground, turned by a yaw, and a height
interval. A perceived box is never perfectly flat; its prism is the tightest one in the box's
own yaw that contains it. Prisms live in rows of an (n, 8) array:
x, y, z of the centre [m], half length, half width, half height [m], cos and sin of the yaw.
"""

import math
from collections.abc import Iterable
from itertools import chain

import numpy as np
import numpy.typing as npt

from depal.geometry.kernel import loop_kernel
from depal.geometry.oriented_box import OrientedBox
from depal.geometry.pose import IDENTITY

PRISM_WIDTH = 8
X, Y, Z, HALF_LENGTH, HALF_WIDTH, HALF_HEIGHT, COS, SIN = range(PRISM_WIDTH)

Array = npt.NDArray[np.float64]
_TILTED = 1e-12
"""Off-diagonal entries of a rotation below this are rounding: the box stands exactly flat."""


def prisms_of(boxes: Iterable[OrientedBox]) -> Array:
    """The prisms of boxes in one frame with z up, (n, 8)."""
    numbers = chain.from_iterable(map(prism_of, boxes))
    return np.fromiter(numbers, np.float64).reshape(-1, PRISM_WIDTH)


def prism_of(box: OrientedBox) -> tuple[float, float, float, float, float, float, float, float]:
    """The prism of one box, one row of `prisms_of`.

    The box's axis nearest to the vertical becomes the prism's height, the longer part of the
    remaining horizontal axis its yaw, folded into (-45, 45] degrees.
    """
    pose = box.pose
    (x, y, z), (length, width, height), rotation = pose.translation, box.size, pose.rotation
    if rotation is IDENTITY or rotation == IDENTITY:
        return (x, y, z, length / 2, width / 2, height / 2, 1.0, 0.0)
    (r00, r01, r02), (r10, r11, r12), (r20, r21, r22) = rotation
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


@loop_kernel
def lateral_interval(prisms: Array, a: int) -> tuple[float, float]:
    """The extent along y of the prism in row a [m]."""
    reach = (
        abs(prisms[a, SIN]) * prisms[a, HALF_LENGTH] + abs(prisms[a, COS]) * prisms[a, HALF_WIDTH]
    )
    return prisms[a, Y] - reach, prisms[a, Y] + reach


@loop_kernel
def slice_at(prisms: Array, a: int, y: float) -> tuple[float, float]:
    """Where the line at height y in the ground plane cuts the rectangle of row a: x interval [m].

    The line must cross the rectangle.
    """
    c, s, dy = prisms[a, COS], prisms[a, SIN], y - prisms[a, Y]
    if abs(s) <= _TILTED:
        return prisms[a, X] - prisms[a, HALF_LENGTH], prisms[a, X] + prisms[a, HALF_LENGTH]
    # In the rectangle's own axes a point is (c dx + s dy, c dy - s dx), within +- half edges;
    # c is at least cos 45 deg, for yaws are folded.
    low, high = (-prisms[a, HALF_LENGTH] - s * dy) / c, (prisms[a, HALF_LENGTH] - s * dy) / c
    first, second = (c * dy - prisms[a, HALF_WIDTH]) / s, (c * dy + prisms[a, HALF_WIDTH]) / s
    low, high = max(low, min(first, second)), min(high, max(first, second))
    return prisms[a, X] + low, prisms[a, X] + high


@loop_kernel
def footprint_overlap(prisms: Array, a: int, b: int) -> float:
    """How deep the rectangles of two rows reach into each other on the ground [m].

    The smallest shift that parts them, by the separating axis theorem; not positive when they
    are apart (then it is minus the widest gap along one of the four edge directions).
    """
    if prisms[a, SIN] == 0 and prisms[b, SIN] == 0:  # most boxes: the same number in fewer steps
        return min(
            float(
                prisms[a, HALF_LENGTH] + prisms[b, HALF_LENGTH] - abs(prisms[b, X] - prisms[a, X])
            ),
            float(prisms[a, HALF_WIDTH] + prisms[b, HALF_WIDTH] - abs(prisms[b, Y] - prisms[a, Y])),
        )
    return min(_depth_along_edges(prisms, a, b), _depth_along_edges(prisms, b, a))


@loop_kernel
def _depth_along_edges(prisms: Array, a: int, b: int) -> float:
    """How deep the rectangles reach into each other along a's two edge directions [m]."""
    dx, dy = prisms[b, X] - prisms[a, X], prisms[b, Y] - prisms[a, Y]
    cos_a, sin_a, cos_b, sin_b = prisms[a, COS], prisms[a, SIN], prisms[b, COS], prisms[b, SIN]
    turn_c = abs(cos_a * cos_b + sin_a * sin_b)
    turn_s = abs(cos_a * sin_b - sin_a * cos_b)
    length, width = prisms[b, HALF_LENGTH], prisms[b, HALF_WIDTH]
    along = prisms[a, HALF_LENGTH] + turn_c * length + turn_s * width
    across = prisms[a, HALF_WIDTH] + turn_s * length + turn_c * width
    return min(
        float(along - abs(cos_a * dx + sin_a * dy)), float(across - abs(cos_a * dy - sin_a * dx))
    )


@loop_kernel
def holds_centre(prisms: Array, a: int, b: int) -> bool:
    """Whether the centre of row b lies strictly inside row a."""
    dx, dy = prisms[b, X] - prisms[a, X], prisms[b, Y] - prisms[a, Y]
    c, s = prisms[a, COS], prisms[a, SIN]
    return bool(
        abs(prisms[b, Z] - prisms[a, Z]) < prisms[a, HALF_HEIGHT]
        and abs(c * dx + s * dy) < prisms[a, HALF_LENGTH]
        and abs(c * dy - s * dx) < prisms[a, HALF_WIDTH]
    )


@loop_kernel
def first_unsound(prisms: Array, first: int, last: int) -> int:
    """The first of the rows first .. last - 1 that is not finite or has no size; -1 for none."""
    for a in range(first, last):
        for column in range(PRISM_WIDTH):
            if not math.isfinite(prisms[a, column]):
                return a
        if min(prisms[a, HALF_LENGTH], prisms[a, HALF_WIDTH], prisms[a, HALF_HEIGHT]) <= 0:
            return a
    return -1
