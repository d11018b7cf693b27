"""The part of space that is searched for boxes."""

import math
from dataclasses import dataclass
from typing import Self

import numpy as np

from depal.domain import PalletStand
from depal.geometry import Pose
from depal.perception.faces import Facing

AROUND = 0.06
"""Boxes may overhang their pallet by so much [m]."""

TALLEST = 1.85
"""The top of the highest pile above the deck [m]."""


@dataclass(frozen=True, slots=True)
class Region:
    """A cuboid that boxes are looked for in, with the directions of its faces.

    Its frame: x away from the viewer, y to the viewer's left, z up; the origin is the middle of
    the lower edge that is nearest to the viewer.

    Attributes:
        cell_from_region: its frame.
        size: along x, y, z [m].
        solid: what is below this height of the region is no box [m].
    """

    cell_from_region: Pose
    size: tuple[float, float, float]
    solid: float = 0.0

    @classmethod
    def above(cls, stand: PalletStand) -> Self:
        """Above a pallet that is looked at from the cell's origin."""
        length, width, _ = stand.size
        x, y, z = stand.cell_from_pallet.apply((length / 2, width / 2, 0.0))
        rotation = np.array(stand.cell_from_pallet.rotation)
        sides = [(rotation[:, 0], length, width), (rotation[:, 1], width, length)]
        axis, along, across = max(sides, key=lambda side: abs(float(side[0] @ (x, y, 0.0))))
        away = axis * math.copysign(1.0, float(axis @ (x, y, 0.0)))
        deep, wide = along + 2 * AROUND, across + 2 * AROUND
        left = np.cross((0.0, 0.0, 1.0), away)
        origin = np.array([x, y, z]) - away * deep / 2
        pose = Pose.from_arrays(origin, np.column_stack((away, left, (0.0, 0.0, 1.0))))
        return cls(pose, (deep, wide, TALLEST))

    def frame_of(self, facing: Facing, step: float) -> tuple[Pose, tuple[int, int]]:
        """`region_from_raster` and the rows and columns of a raster with this step [m]."""
        deep, wide, high = self.size
        if facing is Facing.FRONT:
            turn = ((0.0, 0.0, 1.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0))
            pose = Pose((0.0, wide / 2 - step / 2, high - step / 2), turn)
            return pose, (math.ceil(high / step), math.ceil(wide / step))
        turn = ((0.0, -1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, -1.0))
        pose = Pose((deep - step / 2, wide / 2 - step / 2, high), turn)
        return pose, (math.ceil(deep / step), math.ceil(wide / step))
