"""Pinhole cameras and light."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.geometry import Matrix3, Pose, Vector3

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Lens:
    """A pinhole camera; pixel (0, 0)'s centre has the coordinates (0, 0).

    Attributes:
        cell_from_camera: z forward, x right, y down in the picture.
        size: width and height of the picture [pixel].
        focal: along x and y [pixel].
        centre: where the optical axis meets the picture [pixel].
        near: what is nearer along the axis is not seen [m].
    """

    cell_from_camera: Pose
    size: tuple[int, int]
    focal: tuple[float, float]
    centre: tuple[float, float]
    near: float = 0.02

    @classmethod
    def looking(
        cls, cell_from_camera: Pose, size: tuple[int, int], vertical_view: float, near: float = 0.02
    ) -> "Lens":
        """A lens with square pixels and an angle of view from top to bottom [rad]."""
        width, height = size
        focal = height / 2 / math.tan(vertical_view / 2)
        centre = ((width - 1) / 2, (height - 1) / 2)
        return cls(cell_from_camera, size, (focal, focal), centre, near)

    @property
    def k(self) -> Matrix3:
        """The intrinsic matrix, rows."""
        (fx, fy), (cx, cy) = self.focal, self.centre
        return ((fx, 0.0, cx), (0.0, fy, cy), (0.0, 0.0, 1.0))

    @property
    def values(self) -> Floats:
        """(5,) fx, fy, cx, cy, near, as the kernels take them."""
        return np.array([*self.focal, *self.centre, self.near])


def aimed(eye: Vector3, target: Vector3) -> Pose:
    """`cell_from_camera` of an upright camera at `eye` that looks at `target` [m]."""
    forward = np.array(target) - np.array(eye)
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, (0.0, 0.0, 1.0))
    right /= np.linalg.norm(right)
    return Pose.from_arrays(eye, np.column_stack((right, np.cross(forward, right), forward)))


@dataclass(frozen=True, slots=True)
class Light:
    """One light far away, and light from all around, more of it from above.

    Attributes:
        towards: the direction in which the light stands, in the cell frame.
        direct: brightness of a surface that faces it.
        above: brightness from all around on a surface that faces up.
        below: the same on a surface that faces down.
    """

    towards: Vector3 = (-0.45, 0.3, 0.84)
    direct: float = 0.5
    above: float = 0.55
    below: float = 0.35

    def on(self, normals: Floats) -> Floats:
        """Brightness of surfaces by their outward unit normals (..., 3), lambertian."""
        towards = np.array(self.towards) / np.linalg.norm(self.towards)
        facing = np.maximum(normals @ towards, 0.0)
        around = self.below + (self.above - self.below) * (normals[..., 2] + 1) / 2
        return np.asarray(self.direct * facing + around)
