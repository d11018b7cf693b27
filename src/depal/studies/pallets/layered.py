"""Full layers, as a store's own warehouse stacks them."""

import numpy as np

from depal.studies.pallets.cuts import across, cut_in_height, cut_up
from depal.studies.pallets.draws import dealt, uniforms
from depal.studies.pallets.lattice import ticks_above
from depal.studies.pallets.pallet import RandomPallet
from depal.studies.pallets.volume import SMALLEST, X_MAX, drawn_count, volume_of

LAYERS = range(2, 7)
"""How many layers a pallet may have."""

LOWEST_LAYER = 0.1
"""No layer is lower than this: thinner ones would be sheets rather than boxes [m]."""


def layered(rng: np.random.Generator) -> RandomPallet:
    """A pallet of 2 to 6 full layers of random heights, all boxes of a layer of one height.

    The number of layers is uniform, the heights are uniform among those of 10 cm and more.
    Every layer gets one box, every other box falls to any layer. A layer is cut in the ground
    plane: any of its leaves, through the longer side, at .3 to .7 of it. The boxes come layer
    by layer from the bottom up.
    """
    draw = uniforms(rng)
    count = drawn_count(draw)
    number = LAYERS[int(draw() * len(LAYERS))]
    layers = cut_in_height(volume_of(), number, draw, ticks_above(LOWEST_LAYER))
    shares = dealt(draw, count, number, most=count)
    rule, least = across(draw), ticks_above(SMALLEST)
    boxes = [
        box
        for layer, share in zip(layers, shares, strict=True)
        for box in cut_up(layer, share, rule, least)
    ]
    return RandomPallet.of_cuboids(boxes, X_MAX)
