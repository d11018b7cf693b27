"""The volume that the pallets of the studies fill."""

from depal.geometry import Vector3
from depal.studies.pallets.draws import Draw
from depal.studies.pallets.lattice import Cuboid, ticks_above, ticks_below

X_NEAR = 1.4
"""The side of the volume that faces the robot [m]."""

SIZE: Vector3 = (0.8, 1.6, 1.0)
"""The volume's edges along x, y, z [m]."""

X_MAX = X_NEAR + SIZE[0]
"""The far side of the volume [m]."""

SMALLEST = 0.05
"""No side of a box is below this [m]."""

COUNTS = range(9, 45)
"""How many boxes a pallet may have."""


def volume_of(size: Vector3 = SIZE) -> Cuboid:
    """A volume of a given size [m]: it begins at `X_NEAR`, centred on y = 0, on the deck.

    Where its sides are not on the lattice, the nearest ones within are taken.
    """
    length, width, height = size
    side = ticks_below(width / 2)
    return [ticks_above(X_NEAR), -side, 0, ticks_below(X_NEAR + length), side, ticks_below(height)]


def drawn_count(draw: Draw) -> int:
    """How many boxes the next pallet has: uniform in `COUNTS`."""
    return COUNTS[int(draw() * len(COUNTS))]
