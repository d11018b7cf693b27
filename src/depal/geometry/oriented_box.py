"""A box in space."""

import itertools
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.geometry.pose import Pose, Vector3


@dataclass(frozen=True, slots=True)
class OrientedBox:
    """A cuboid at a pose; the frame is the one its pose leads to.

    Attributes:
        pose: `frame_from_box`; the box's own frame sits in its centre, along its edges.
        size: full edge lengths along the box's own axes [m], all positive.
    """

    pose: Pose
    size: Vector3

    @classmethod
    def upright(cls, centre: Vector3, size: Vector3, yaw: float = 0.0) -> "OrientedBox":
        """A box that stands flat, its centre at `centre` [m], turned by `yaw` [rad]."""
        return cls(Pose(centre) if yaw == 0.0 else Pose.from_yaw(centre, yaw), size)

    @classmethod
    def from_corner(cls, corner: Vector3, size: Vector3) -> "OrientedBox":
        """An axis-aligned box from its corner with the smallest coordinates [m]."""
        (x, y, z), (a, b, c) = corner, size
        return cls(Pose((x + a / 2, y + b / 2, z + c / 2)), size)

    @property
    def centre(self) -> Vector3:
        """The centre, also taken as the centre of mass [m]."""
        return self.pose.translation

    @property
    def corners(self) -> npt.NDArray[np.float64]:
        """The eight corners, (8, 3) [m], in the frame of the pose."""
        signs = np.array(list(itertools.product((-0.5, 0.5), repeat=3)))
        rotation = np.array(self.pose.rotation)
        corners: npt.NDArray[np.float64] = (signs * np.array(self.size)) @ rotation.T + np.array(
            self.centre
        )
        return corners

    def seen_from(self, other_from_frame: Pose) -> "OrientedBox":
        """The same box in another frame."""
        return OrientedBox(other_from_frame @ self.pose, self.size)
