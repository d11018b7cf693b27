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

BELOW = 0.06
"""The region begins so far below the deck [m]."""

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
        ground: what boxes stand on at the lowest is so high in the region [m].
    """

    cell_from_region: Pose
    size: tuple[float, float, float]
    ground: float = 0.0

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
        origin = np.array([x, y, z - BELOW]) - away * deep / 2
        pose = Pose.from_arrays(origin, np.column_stack((away, left, (0.0, 0.0, 1.0))))
        return cls(pose, (deep, wide, TALLEST + BELOW), BELOW)

    def frame_of(
        self, facing: Facing, step: float, multiple: int = 1
    ) -> tuple[Pose, tuple[int, int]]:
        """Where a raster with pixels of this step [m] lies, and its rows and columns.

        Args:
            facing: what it is to show.
            step: edge of a pixel [m].
            multiple: rows and columns are multiples of this.

        Returns:
            `region_from_raster`, and rows and columns.
        """
        deep, wide, high = self.size
        if facing is Facing.FRONT:
            turn = ((0.0, 0.0, 1.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0))
            corner, down = (0.0, wide / 2 - step / 2, high - step / 2), high
        else:
            turn = ((0.0, -1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, -1.0))
            corner, down = (deep - step / 2, wide / 2 - step / 2, high), deep
        rows, columns = (multiple * math.ceil(each / step / multiple) for each in (down, wide))
        return Pose(corner, turn), (rows, columns)
