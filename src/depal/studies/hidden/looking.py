"""What a pallet shows from the front and from above, look after look, while boxes leave."""

from typing import Self

import numpy as np
import numpy.typing as npt

from depal.selection.access import Mask, mask_of
from depal.selection.hidden import (
    NOBODY,
    SHARE,
    Placements,
    Region,
    Scene,
    View,
    owners_of,
    shares_seen,
    window_of,
)
from depal.studies.pallets import SIZE, X_MAX, X_NEAR

Array = npt.NDArray[np.float64]

REGION = Region((X_NEAR, -SIZE[1] / 2, 0.0), (X_MAX, SIZE[1] / 2, SIZE[2]))
"""The volume that the random pallets fill."""


class Looks:
    """The true pallet and what looks have told of it.

    Attributes:
        seen: the boxes that are there and have been seen.
        gone: the boxes that have left.
    """

    def __init__(self, prisms: Array) -> None:
        """Before the first look.

        Args:
            prisms: (n, 8) of all boxes.
        """
        self._owners = owners_of(REGION, prisms, range(len(prisms)))
        self._empty = np.zeros(REGION.shape, np.bool_)
        self._view = View.of(self._owners)
        self._boxes = len(prisms)
        self.seen: Mask = 0
        self.gone: Mask = 0

    @classmethod
    def first(cls, prisms: Array) -> Self:
        """After the first look."""
        looks = cls(prisms)
        looks.look()
        return looks

    def look(self) -> None:
        """What is in the open now is known from now on."""
        self._view = View.of(self._owners)
        self._empty |= self._view.passed
        shares = shares_seen(self._owners, self._view, self._boxes)
        self.seen |= mask_of(np.flatnonzero(shares >= SHARE).tolist())

    def remove(self, box: int) -> None:
        """A box leaves: its place is empty."""
        self._empty |= self._owners == box
        self._owners[self._owners == box] = NOBODY
        self.seen &= ~(1 << box)
        self.gone |= 1 << box

    def scene(self) -> Scene:
        """What is known now."""
        known = np.array([self.seen >> box & 1 for box in range(self._boxes)], np.bool_)
        named = (self._owners != NOBODY) & known[np.maximum(self._owners, 0)]
        return Scene(REGION, np.where(named, self._owners, NOBODY), self._empty.copy(), self._view)


def true_place(found: Placements, prism: Array) -> int | None:
    """The placement that a box has in truth, or None where none of them is it.

    Args:
        found: placements of a box of its size.
        prism: (8,) of the box, not turned.
    """
    size = 2 * prism[3:6]
    span = window_of(REGION, size)
    first = np.rint((prism[:3] - np.array(REGION.low)) / REGION.cell - span / 2).astype(np.intp)
    same = (found.first == first).all(axis=1) & np.isclose(found.sizes, size).all(axis=1)
    rows = np.flatnonzero(same)
    return int(rows[0]) if len(rows) else None
