"""Rigid poses as immutable values."""

import math
from dataclasses import dataclass
from typing import Self

import numpy as np
import numpy.typing as npt

Vector3 = tuple[float, float, float]
Matrix3 = tuple[Vector3, Vector3, Vector3]

IDENTITY: Matrix3 = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True, slots=True)
class Pose:
    """A rotation followed by a translation: `b_from_a.apply(p_in_a)` is p in b.

    Attributes:
        translation: the origin of a, in b [m].
        rotation: rows of the orthonormal matrix whose columns are the axes of a, in b.
    """

    translation: Vector3 = (0.0, 0.0, 0.0)
    rotation: Matrix3 = IDENTITY

    @classmethod
    def from_yaw(cls, translation: Vector3, yaw: float) -> Self:
        """A turn about the vertical axis by `yaw` [rad], then a shift [m]."""
        c, s = math.cos(yaw), math.sin(yaw)
        return cls(translation, ((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)))

    @classmethod
    def from_arrays(cls, translation: npt.ArrayLike, rotation: npt.ArrayLike) -> Self:
        """From arrays of shape (3,) [m] and (3, 3)."""
        t = np.asarray(translation, dtype=float).tolist()
        r = np.asarray(rotation, dtype=float).tolist()
        return cls((t[0], t[1], t[2]), (_row(r[0]), _row(r[1]), _row(r[2])))

    @property
    def inverse(self) -> "Pose":
        """`a_from_b` of this `b_from_a`."""
        turned_back = np.array(self.rotation).T
        return Pose.from_arrays(-turned_back @ np.array(self.translation), turned_back)

    def __matmul__(self, other: "Pose") -> "Pose":
        """`c_from_b @ b_from_a` is `c_from_a`."""
        turn = np.array(self.rotation)
        return Pose.from_arrays(
            turn @ np.array(other.translation) + np.array(self.translation),
            turn @ np.array(other.rotation),
        )

    def apply(self, point: Vector3) -> Vector3:
        """A point in a [m], seen in b [m]."""
        x, y, z = point
        moved = [
            row[0] * x + row[1] * y + row[2] * z + shift
            for row, shift in zip(self.rotation, self.translation, strict=True)
        ]
        return (moved[0], moved[1], moved[2])


def _row(values: list[float]) -> Vector3:
    return (values[0], values[1], values[2])
