"""What a generator returns."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.geometry import PRISM_WIDTH
from depal.studies.pallets.lattice import TICK, Cuboid

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class RandomPallet:
    """Axis-aligned boxes in the cell frame.

    All coordinates are multiples of 2^-40 m, so that the sums, differences and halves of
    them are exact: two boxes that touch share one number, and neither their sizes nor their
    prisms let them overlap by rounding. The properties are computed anew at each call.

    Attributes:
        low: the corners with the smallest coordinates, (n, 3) [m]; made read-only.
        high: the corners with the largest coordinates, (n, 3) [m]; made read-only.
        x_max: the far side of the volume, whether or not a box reaches it [m].
    """

    low: Array
    high: Array
    x_max: float

    @classmethod
    def of_cuboids(cls, cuboids: Sequence[Cuboid], x_max: float) -> "RandomPallet":
        """From cuboids in ticks, in their order, in a volume that ends at `x_max` [m]."""
        corners = np.array(cuboids, dtype=np.float64) * TICK
        return cls(corners[:, :3].copy(), corners[:, 3:].copy(), x_max)

    def __post_init__(self) -> None:
        """Makes the arrays read-only."""
        self.low.setflags(write=False)
        self.high.setflags(write=False)

    def __len__(self) -> int:
        """The number of boxes, n."""
        return len(self.low)

    @property
    def centres(self) -> Array:
        """The boxes' centres, also taken as their centres of mass, (n, 3) [m]."""
        return (self.low + self.high) / 2

    @property
    def sizes(self) -> Array:
        """The boxes' edges along x, y, z, (n, 3) [m]."""
        return self.high - self.low

    @property
    def prisms(self) -> Array:
        """The boxes as `depal.geometry` relates them, (n, 8): none of them turned."""
        prisms = np.empty((len(self), PRISM_WIDTH))
        prisms[:, :3] = self.centres
        prisms[:, 3:6] = self.sizes / 2
        prisms[:, 6:] = (1.0, 0.0)
        return prisms
