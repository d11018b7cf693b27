"""How deep the arm sets boxes into each place."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from depal.cell.checking.delivery import CLEARANCE, LIFT, fits
from depal.cell.checking.mover import Mover, Task
from depal.cell.checking.sizes import BoxSize
from depal.domain import Approach, CellLayout, Place, PlaceId
from depal.geometry import OrientedBox, Pose, Vector3

DEPTHS = (0.02, 0.12, 0.22, 0.32, 0.42, 0.52)
"""How far behind the opening the box's outward face is tried [m]."""

_ACROSS = 3
_OUT = 0.05
_WALL = 0.012


@dataclass(frozen=True, slots=True)
class PlaceReach:
    """How one box size goes into one place by one grasp.

    Attributes:
        place: the compartment.
        size: the box.
        approach: how it is held.
        fits: whether it goes through the opening at all.
        tried: how many positions on the place's floor.
        reached: share of them that are reached.
        deepest: how far behind the opening the outward face gets [m]; negative for never.
    """

    place: PlaceId
    size: BoxSize
    approach: Approach
    fits: bool
    tried: int
    reached: float
    deepest: float


def check_place_reach(
    mover: Mover, layout: CellLayout, sizes: Sequence[BoxSize]
) -> tuple[PlaceReach, ...]:
    """Tries every box size and grasp over the floor of every place, each of them empty.

    Args:
        mover: the arm.
        layout: the cell.
        sizes: of the boxes.
    """
    plate = max(module.size[0] for module in layout.tool.modules)
    return tuple(
        _reach(mover, place, load, approach, plate)
        for place in layout.places.values()
        for load in sizes
        for approach in Approach
    )


def _reach(
    mover: Mover, place: Place, load: BoxSize, approach: Approach, plate: float
) -> PlaceReach:
    results = [
        (face, mover.can(_task(place, load, face, aside), approach))
        for face, aside in _positions(place, load, plate)
    ]
    reached = [face for face, done in results if done]
    return PlaceReach(
        place=place.id,
        size=load,
        approach=approach,
        fits=fits(place, load.size),
        tried=len(results),
        reached=len(reached) / len(results) if results else 0.0,
        deepest=max(reached, default=-1.0),
    )


def _positions(place: Place, load: BoxSize, plate: float) -> Iterator[tuple[float, float]]:
    """Depths of the outward face and middles across the opening [m].

    Beside the walls, boxes narrower than the tool's plate stand as near as the plate lets them.
    """
    depth, width, _ = load.size
    if not fits(place, load.size) or width + 2 * CLEARANCE > place.opening[0]:
        return
    room = max((place.opening[0] - max(width, plate)) / 2 - _WALL, 0.0)
    for face in DEPTHS:
        if face + depth + CLEARANCE <= place.depth:
            for aside in np.linspace(-room, room, _ACROSS).tolist():
                yield face, aside


def _task(place: Place, load: BoxSize, face: float, aside: float) -> Task:
    depth, _, height = load.size
    standing = Pose((face + depth / 2, aside, height / 2))
    box = OrientedBox(place.cell_from_place @ standing, load.size)
    rows = place.cell_from_place.rotation
    front: Vector3 = (-rows[0][0], -rows[1][0], 0.0)
    out = face + depth + _OUT
    moves = ((0.0, 0.0, LIFT), (front[0] * out, front[1] * out, 0.0))
    return Task(box, load, (), moves)
