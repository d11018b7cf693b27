"""What two views leave unseen: a grid over the pallet, looked at from the front and from above.

Both views are orthographic: lines of sight along +x, and straight down. A cell that a line of
sight has passed is empty; a cell in a seen box is taken; in all others something may hide.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Self

import numpy as np
import numpy.typing as npt

from depal.errors import SettingError

Array = npt.NDArray[np.float64]
Cells = npt.NDArray[np.bool_]
Owners = npt.NDArray[np.intp]

STEP = 0.04
"""The edge of a cell, or somewhat less, so that whole cells fill the region [m]."""

NOBODY = -1
"""The owner of an empty cell."""


@dataclass(frozen=True, slots=True)
class Region:
    """An upright block in the cell frame in which all boxes stand.

    Attributes:
        low: its corner with the smallest coordinates [m].
        high: its corner with the largest [m].
    """

    low: tuple[float, float, float]
    high: tuple[float, float, float]

    def __post_init__(self) -> None:
        """Refuses a block without volume."""
        if not all(high > low for low, high in zip(self.low, self.high, strict=True)):
            raise SettingError("region", f"{self.low} .. {self.high} m", "low below high")

    @property
    def shape(self) -> tuple[int, int, int]:
        """How many cells it has along x, y and z."""
        x, y, z = (
            max(1, int(np.ceil((high - low) / STEP - 1e-9)))
            for low, high in zip(self.low, self.high, strict=True)
        )
        return x, y, z

    @property
    def cell(self) -> Array:
        """(3,) the edges of a cell [m]."""
        size: Array = (np.array(self.high) - np.array(self.low)) / np.array(self.shape)
        return size

    def centres(self, axis: int) -> Array:
        """The coordinates of the cells' centres along an axis [m]."""
        count = self.shape[axis]
        centres: Array = self.low[axis] + (np.arange(count) + 0.5) * self.cell[axis]
        return centres


def owners_of(region: Region, prisms: Array, rows: Iterable[int]) -> Owners:
    """Which box each cell's centre lies in.

    Args:
        region: where to look.
        prisms: (n, 8) in the cell frame.
        rows: those that hold a box.

    Returns:
        (x, y, z) the row, NOBODY where there is none.
    """
    owners = np.full(region.shape, NOBODY, np.intp)
    xs, ys, zs = (region.centres(axis) for axis in range(3))
    for row in rows:
        x, y, z, length, width, height, cos, sin = prisms[row]
        dx, dy = xs[:, None] - x, ys[None, :] - y
        ground = (np.abs(cos * dx + sin * dy) <= length) & (np.abs(cos * dy - sin * dx) <= width)
        level = np.flatnonzero(np.abs(zs - z) <= height)
        if len(level):
            owners[:, :, level[0] : level[-1] + 1][ground] = row
    return owners


@dataclass(frozen=True, slots=True, eq=False)
class View:
    """What a look sees.

    Attributes:
        front: (y, z) the owner of the first taken cell along +x.
        top: (x, y) the owner of the first taken cell from above.
        along: (x, y, z) cells that a line of sight from the front passes, all of them empty.
        down: (x, y, z) cells that one from above passes, all of them empty.
    """

    front: Owners
    top: Owners
    along: Cells
    down: Cells

    @property
    def passed(self) -> Cells:
        """(x, y, z) cells known to be empty by this look."""
        return self.along | self.down

    @classmethod
    def of(cls, owners: Owners) -> Self:
        """Of taken cells, from the front and from above."""
        taken = owners != NOBODY
        ahead = np.logical_or.accumulate(taken, axis=0)
        below = np.logical_or.accumulate(taken[:, :, ::-1], axis=2)[:, :, ::-1]
        near = np.take_along_axis(owners, taken.argmax(axis=0)[None], axis=0)[0]
        last = owners.shape[2] - 1 - taken[:, :, ::-1].argmax(axis=2)
        high = np.take_along_axis(owners, last[:, :, None], axis=2)[:, :, 0]
        return cls(near, high, ~ahead, ~below)


def shares_seen(owners: Owners, view: View, boxes: int) -> Array:
    """How much of each box is in the open.

    Args:
        owners: of all cells.
        view: of them.
        boxes: how many rows there are.

    Returns:
        (boxes,) the greater one of the shares of its front and of its top; 0 where it has no cell.
    """
    shares = np.zeros(boxes)
    for axis, seen in ((0, view.front), (2, view.top)):
        for row in range(boxes):
            face = int((owners == row).any(axis=axis).sum())
            if face:
                shares[row] = max(shares[row], float((seen == row).sum()) / face)
    return shares
