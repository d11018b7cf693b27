"""Boxes as near to cubes as cuts make them."""

import numpy as np

from depal.studies.pallets.cuts import cut_up
from depal.studies.pallets.draws import uniforms
from depal.studies.pallets.lattice import Cuboid, ticks_above
from depal.studies.pallets.pallet import RandomPallet
from depal.studies.pallets.volume import SMALLEST, X_MAX, drawn_count, volume_of


def cubic(rng: np.random.Generator) -> RandomPallet:
    """A pallet cut always through the largest leaf across its longest side, at .35 to .65 of it.

    Of leaves of one volume the first in the list is cut, of sides of one length the first in
    the order x, y, z.
    """
    draw = uniforms(rng)

    def through_largest(leaves: list[Cuboid]) -> tuple[Cuboid, int, float]:
        leaf = max(leaves, key=_volume)
        sides = [leaf[axis + 3] - leaf[axis] for axis in range(3)]
        return leaf, sides.index(max(sides)), 0.35 + 0.3 * draw()

    leaves = cut_up(volume_of(), drawn_count(draw), through_largest, ticks_above(SMALLEST))
    return RandomPallet.of_cuboids(leaves, X_MAX)


def _volume(leaf: Cuboid) -> int:
    x, y, z, far_x, far_y, top = leaf
    return (far_x - x) * (far_y - y) * (top - z)
