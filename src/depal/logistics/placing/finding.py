"""Where a box goes inside a compartment, best spots first."""

import math
from collections.abc import Callable, Iterable

import numpy as np

from depal.logistics.placing.candidates import CAPACITY, Weights, list_spots
from depal.logistics.placing.feasible import stands
from depal.logistics.placing.place_map import PlaceMap
from depal.logistics.placing.scene import Array, load_of, rules_of, scene_of
from depal.logistics.placing.values import MARGINS, Held, Margins, Spot

Reachable = Callable[[Spot], bool]

WEIGHTS = Weights()
"""What makes a spot good, as `measure_fill` found it."""

SPOTS = 8
"""How many spots are offered."""

TRIES = 64
"""How many spots `reachable` is asked about, at the most."""

APART = (0.03, 0.03, 0.01)
"""Spots nearer to each other than this, along all of x, y, z, are the same for a planner [m]."""


def find_spots(
    place_map: PlaceMap,
    held: Held,
    *,
    margins: Margins = MARGINS,
    max_depth: float = math.inf,
    reachable: Reachable | None = None,
    limit: int = SPOTS,
    weights: Weights = WEIGHTS,
) -> tuple[Spot, ...]:
    """Where a box can be pushed in straight from the front, set down, and stands.

    Args:
        place_map: the compartment and what stands in it.
        held: the box, turned as it would be pushed in, with the tool behind or above it.
        margins: how much room it is given.
        max_depth: how deep behind the opening the arm brings the box's outward face [m].
        reachable: what else a spot must satisfy; asked in order, about `TRIES` at the most.
        limit: how many spots are wanted.
        weights: what makes a spot good.

    Returns:
        Distinct spots, best first; empty where it cannot go in.
    """
    scene = scene_of(place_map.place, place_map.boxes, max_depth)
    rows = np.empty((CAPACITY, 4))
    count = list_spots(scene, load_of(held), rules_of(margins), weights, rows)
    found: list[Spot] = []
    first_side = 1.0 if len(place_map.boxes) % 2 else -1.0
    for row in _distinct(rows[:count], first_side, TRIES if reachable else limit):
        spot = _spot(place_map, held, margins, row)
        if reachable is None or reachable(spot):
            found.append(spot)
        if len(found) == limit:
            break
    return tuple(found)


def is_full_for(
    place_map: PlaceMap,
    helds: Iterable[Held],
    *,
    margins: Margins = MARGINS,
    max_depth: float = math.inf,
) -> bool:
    """Whether none of some boxes, or of the ways to turn one, can go in."""
    return not any(
        find_spots(place_map, held, margins=margins, max_depth=max_depth, limit=1) for held in helds
    )


def can_stand(
    place_map: PlaceMap,
    held: Held,
    spot: Spot,
    *,
    margins: Margins = MARGINS,
    max_depth: float = math.inf,
) -> bool:
    """Whether a box can be pushed in to that spot and stands there, as far as the map says."""
    scene = scene_of(place_map.place, place_map.boxes, max_depth)
    x, y, z = spot.corner
    middle = y + held.size[1] / 2
    return bool(stands(scene, load_of(held), rules_of(margins), x, middle, z))


def _distinct(rows: Array, first_side: float, limit: int) -> list[list[float]]:
    """The best rows that are apart; among equals low, deep, and on one side first."""
    order = np.lexsort((first_side * rows[:, 1], -rows[:, 0], rows[:, 2], np.round(rows[:, 3], 9)))
    rest = rows[order]
    chosen: list[list[float]] = []
    while len(rest) and len(chosen) < limit:
        chosen.append(rest[0].tolist())
        near = np.abs(rest[:, :3] - rest[0, :3]) < APART
        rest = rest[~near.all(axis=1)]
    return chosen


def _spot(place_map: PlaceMap, held: Held, margins: Margins, row: list[float]) -> Spot:
    depth, width, _ = held.size
    x, y, z = row[0], row[1] - width / 2, row[2]
    carriers = [
        box.id
        for box in place_map.boxes
        if abs(box.corner[2] + box.size[2] - z) <= margins.level
        and box.corner[0] < x + depth
        and box.corner[0] + box.size[0] > x
        and box.corner[1] < y + width
        and box.corner[1] + box.size[1] > y
    ]
    return Spot(place_map.place.id, (x, y, z), held.size, tuple(carriers), row[3])
