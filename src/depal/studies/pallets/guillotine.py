"""Random guillotine cuts, as in case study 1 of the paper (section III-A)."""

import math

import numpy as np

from depal.errors import SettingError
from depal.geometry import Vector3
from depal.studies.pallets.cuts import cut_up
from depal.studies.pallets.draws import Draw, uniforms
from depal.studies.pallets.lattice import Cuboid, ticks_above
from depal.studies.pallets.pallet import RandomPallet
from depal.studies.pallets.volume import SIZE, SMALLEST, X_NEAR, drawn_count, volume_of


def guillotine(rng: np.random.Generator) -> RandomPallet:
    """A pallet of random cuts: any leaf, any axis, at .45 to .55 of its length, all uniform.

    A cut that would leave a side below 5 cm is drawn anew: leaf, axis and place.
    """
    draw = uniforms(rng)
    return _cut(draw, drawn_count(draw), SIZE, SMALLEST)


def guillotine_boxes(
    rng: np.random.Generator, count: int, size: Vector3 = SIZE, smallest: float = SMALLEST
) -> RandomPallet:
    """The same cuts for any number of boxes, as benchmarks need them.

    Args:
        rng: the source of all randomness.
        count: how many boxes there shall be.
        size: edges of the volume along x, y, z [m].
        smallest: no side of a box is below this [m].

    Returns:
        `count` boxes that fill the volume.

    Raises:
        SettingError: a number is out of its range, or that many boxes cannot be cut.
    """
    if count < 1:
        raise SettingError("count", f"{count} is out of range", "1 box or more")
    if not 0 < smallest < math.inf:
        raise SettingError("smallest", f"{smallest} m is out of range", "a length above 0 m")
    if not all(smallest <= edge < math.inf for edge in size):
        edges = " x ".join(f"{edge:g}" for edge in size)
        raise SettingError("size", f"{edges} m is out of range", f"edges of {smallest:g} m or more")
    # No more boxes than cubes of the smallest side, whatever the cuts.
    room = math.prod(math.floor(edge / smallest + 1e-9) for edge in size)
    if count > room:
        what = f"{count} boxes with no side below {smallest:g} m have no room"
        raise SettingError("count", what, f"at most {room}")
    return _cut(uniforms(rng), count, size, smallest)


def _cut(draw: Draw, count: int, size: Vector3, smallest: float) -> RandomPallet:
    def anywhere(leaves: list[Cuboid]) -> tuple[Cuboid, int, float]:
        return leaves[int(draw() * len(leaves))], int(draw() * 3), 0.45 + 0.1 * draw()

    leaves = cut_up(volume_of(size), count, anywhere, ticks_above(smallest))
    return RandomPallet.of_cuboids(leaves, X_NEAR + size[0])
