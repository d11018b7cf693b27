"""A face as numbers in the region's frame: x away from the viewer, y to the left, z up."""

import math
from dataclasses import dataclass
from typing import Self

import numpy as np

from depal.geometry import Pose
from depal.perception.faces import Face, Facing


@dataclass(frozen=True, slots=True)
class Lying:
    """Where a face lies.

    Attributes:
        face: it.
        x: of its middle [m].
        y: of its middle [m].
        z: of its middle [m].
        yaw: of the box against the region, within 45 degrees [rad].
        width: along y [m].
        other: a front's height, a top's depth along x [m].
    """

    face: Face
    x: float
    y: float
    z: float
    yaw: float
    width: float
    other: float

    @classmethod
    def of(cls, face: Face, region_from_cell: Pose) -> Self:
        """A face of the cell."""
        pose = region_from_cell @ face.cell_from_face
        x, y, z = pose.translation
        along = np.array(pose.rotation)[:, 0]  # the face's own x, which is -y of the region
        yaw = math.atan2(along[0], -along[1])
        return cls(face, x, y, z, yaw, *face.size)

    @property
    def front_edge(self) -> tuple[float, float, float]:
        """The middle of the edge that a box's front and top share [m]."""
        if self.face.facing is Facing.FRONT:
            return (self.x, self.y, self.z + self.other / 2)
        half = self.other / 2
        return (self.x - half * math.cos(self.yaw), self.y - half * math.sin(self.yaw), self.z)
