"""What a range sensor above the opening of a compartment reads."""

import math
from collections.abc import Iterable

import numpy as np

from depal.domain import Place
from depal.geometry import OrientedBox

STRIP = 0.05
"""The width of what it tells apart, about [m]."""

STEP = 0.001
"""Its resolution [m]."""


def profile_of(place: Place, things: Iterable[OrientedBox]) -> tuple[float, ...]:
    """How far in a compartment is free in strips of equal width, from the smallest y on [m].

    Args:
        place: the compartment.
        things: what may stand in it, in the cell frame.
    """
    width, height = place.opening
    edges = np.linspace(-width / 2, width / 2, max(math.ceil(width / STRIP), 1) + 1)
    free = np.full(len(edges) - 1, place.depth)
    place_from_cell = place.cell_from_place.inverse
    for thing in things:
        corners = thing.seen_from(place_from_cell).corners
        (x, right, low), (far, left, high) = corners.min(axis=0), corners.max(axis=0)
        if far <= 0.0 or x >= place.depth or high <= 0.0 or low >= height:
            continue
        before = (edges[1:] > right) & (edges[:-1] < left)
        free[before] = np.minimum(free[before], max(float(x), 0.0))
    return tuple((np.round(free / STEP) * STEP).tolist())
