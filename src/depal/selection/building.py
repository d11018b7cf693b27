"""The edges of a whole pile at once, by one sweep along y."""

import math

import numpy as np

from depal.selection.links import POOL_FULL, Array, Links, link_all
from depal.selection.relations import Tolerances

_SMALLEST = 16


def link_prisms(prisms: Array, tolerances: Tolerances) -> tuple[Links, tuple[int, int]]:
    """The edges between prisms that sit in slots 0, 1, 2, ...

    Args:
        prisms: (n, 8).
        tolerances: how wrong the poses may be.

    Returns:
        The edges, and a pair of slots whose boxes are in one place or (BUILT, BUILT).
    """
    slots = len(prisms)
    lows, highs = _lateral_extents(prisms)
    order = np.argsort(lows, kind="stable").astype(np.int32)
    # A box has more neighbours above and before it the more there are; room for most piles.
    edges = max(_SMALLEST, int(slots * (8 + math.sqrt(slots))))
    while True:
        links = Links.empty(slots, edges)
        ended = link_all(prisms, order, lows, highs, tolerances.overlap, tolerances.slack, links)
        if ended[0] != POOL_FULL:
            return links, ended
        edges *= 4


def _lateral_extents(prisms: Array) -> tuple[Array, Array]:
    # As geometry's lateral_interval, for all rows at once.
    reach = np.abs(prisms[:, 7]) * prisms[:, 3] + np.abs(prisms[:, 6]) * prisms[:, 4]
    return prisms[:, 1] - reach, prisms[:, 1] + reach
