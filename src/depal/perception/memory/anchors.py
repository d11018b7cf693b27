"""How far apart two boxes are as the cameras see them: by their fronts and by their tops.

A look measures a face well and what lies behind it badly; so two boxes are compared by the faces
that they show, and by the nearer answer.
"""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.geometry import OrientedBox, Pose, Vector3

Array = npt.NDArray[np.float64]

QUARTER = math.pi / 2


@dataclass(frozen=True, slots=True)
class Difference:
    """Between two boxes.

    Attributes:
        shift: of the face that agrees better [m].
        size: greatest difference of that face's edges [m].
    """

    shift: float
    size: float

    @property
    def total(self) -> float:
        """Of both [m]."""
        return self.shift + self.size


def yaw_of(shape: OrientedBox) -> float:
    """Of a box that stands flat [rad]."""
    rotation = shape.pose.rotation
    return math.atan2(rotation[1][0], rotation[0][0])


def aligned(shape: OrientedBox, like: OrientedBox) -> OrientedBox:
    """The same box, upright, its axes turned by quarters until they are next to another's."""
    off = yaw_of(shape) - yaw_of(like)
    quarters = round(off / QUARTER)
    yaw = yaw_of(shape) - quarters * QUARTER
    a, b, c = shape.size
    size = (b, a, c) if quarters % 2 else (a, b, c)
    return OrientedBox(Pose.from_yaw(shape.centre, yaw), size)


def between(one: OrientedBox, two: OrientedBox) -> Difference:
    """How far two boxes are apart; their axes need not be aligned."""
    a, b = anchors_of([one]), anchors_of([two])
    shift, size = differences(a, b)
    return Difference(float(shift[0, 0]), float(size[0, 0]))


def anchors_of(shapes: list[OrientedBox]) -> Array:
    """(n, 2, 5): of each box its front and its top: x, y, z of the middle, width and height."""
    rows = []
    for shape in shapes:
        x, y, z = shape.centre
        deep, wide, high = (np.abs(np.array(shape.pose.rotation)) @ np.array(shape.size)).tolist()
        rows.append([[x - deep / 2, y, z, wide, high], [x, y, z + high / 2, deep, wide]])
    return np.array(rows, dtype=float).reshape(-1, 2, 5)


def differences(one: Array, two: Array) -> tuple[Array, Array]:
    """Between all boxes of two lists.

    Args:
        one: (n, 2, 5).
        two: (m, 2, 5).

    Returns:
        Shift and difference of size by the face that agrees better, (n, m) each [m].
    """
    off = one[:, None] - two[None]
    shift = np.linalg.norm(off[..., :3], axis=3)
    size = np.abs(off[..., 3:]).max(axis=3, initial=0.0)
    better = (shift + size).argmin(axis=2)[..., None]
    return (
        np.take_along_axis(shift, better, 2)[..., 0],
        np.take_along_axis(size, better, 2)[..., 0],
    )


def resized_at_its_face(shape: OrientedBox, size: Vector3) -> OrientedBox:
    """A box of another size whose front and top stay where they are; axes are the box's own."""
    axes = np.array(shape.pose.rotation)
    more = (np.array(size) - np.array(shape.size)) / 2
    nearer = np.argmax(np.abs(axes[0, :2]))  # the axis along the view
    shift = np.zeros(3)
    shift += axes[:, nearer] * np.sign(axes[0, nearer]) * more[nearer]
    shift[2] -= more[2]
    x, y, z = (np.array(shape.centre) + shift).tolist()
    return OrientedBox(Pose((x, y, z), shape.pose.rotation), size)
