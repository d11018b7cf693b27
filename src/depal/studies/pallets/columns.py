"""Towers side by side."""

import numpy as np

from depal.studies.pallets.cuts import across, cut_in_height, cut_up
from depal.studies.pallets.draws import Draw, dealt, uniforms
from depal.studies.pallets.lattice import ticks_above
from depal.studies.pallets.pallet import RandomPallet
from depal.studies.pallets.volume import SMALLEST, X_MAX, drawn_count, volume_of

FEWEST_PER_COLUMN, MOST_PER_COLUMN = 2, 6
"""Bounds of the mean number of boxes in a pallet's columns."""

TALLEST_COLUMN = 12
"""No column has more boxes than this."""


def columns(rng: np.random.Generator) -> RandomPallet:
    """A pallet whose footprint is cut first and every column of it then at its own heights.

    The number of columns is uniform among those with 2 to 6 boxes each in the mean. The
    footprint is cut like a layer: any leaf, through the longer side, at .3 to .7 of it. Every
    column gets one box, every other box falls to any column that has less than 12. The heights
    of a column are uniform among those of 5 cm and more. The boxes come column by column, from
    the bottom up.
    """
    draw = uniforms(rng)
    count = drawn_count(draw)
    number = _number_of_columns(draw, count)
    least = ticks_above(SMALLEST)
    footprints = cut_up(volume_of(), number, across(draw), least)
    shares = dealt(draw, count, number, TALLEST_COLUMN)
    boxes = [
        box
        for footprint, share in zip(footprints, shares, strict=True)
        for box in cut_in_height(footprint, share, draw, least)
    ]
    return RandomPallet.of_cuboids(boxes, X_MAX)


def _number_of_columns(draw: Draw, count: int) -> int:
    fewest, most = -(-count // MOST_PER_COLUMN), count // FEWEST_PER_COLUMN
    return fewest + int(draw() * (most - fewest + 1))
