"""What of the pallet's load the arm takes, from the front and from above."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from depal.cell.checking.mover import Mover, Task
from depal.cell.checking.sizes import BoxSize
from depal.cell.checking.standing import LOAD_HEIGHT
from depal.domain import Approach, PalletStand
from depal.geometry import OrientedBox, Pose, Vector3

USUAL_HEIGHT = 1.66
"""The highest of 58 real deliveries, above the floor [m]."""

_ACROSS, _DEEP, _HIGH = 5, 3, 7
_GAP = 0.001
_LIFT, _UP, _FORTH = 0.008, 0.03, 0.15
"""From the front a box is lifted a little and drawn out; from above a little more, and then it is
on its way [m]. Nothing stands in front of a box that is taken (the relation "occludes")."""


@dataclass(frozen=True, slots=True)
class PalletReach:
    """What is reached of one box size.

    Attributes:
        size: the box.
        tried: how many positions.
        horizontal: share that is taken from the front.
        vertical: share that is taken from above.
        either: share that is taken by one of them.
        usual: the same of the positions that end at most 1.66 m above the floor.
        missed: some positions that are not taken: pallet's x, y of the box's near lower edge and
            height of its bottom above the floor [m].
    """

    size: BoxSize
    tried: int
    horizontal: float
    vertical: float
    either: float
    usual: float
    missed: tuple[Vector3, ...]


def check_pallet_reach(
    mover: Mover, pallet: PalletStand, sizes: Sequence[BoxSize]
) -> tuple[PalletReach, ...]:
    """Tries boxes everywhere on the pallet, with the load around them that hinders most.

    Args:
        mover: the arm.
        pallet: where it stands.
        sizes: of the boxes.
    """
    return tuple(_reach(mover, pallet, load) for load in sizes)


def _reach(mover: Mover, pallet: PalletStand, load: BoxSize) -> PalletReach:
    rows = []
    missed = []
    for corner, task_of in _positions(pallet, load):
        taken = tuple(mover.can(task_of[approach], approach) for approach in Approach)
        top = corner[2] + load.size[2]
        rows.append((*taken, any(taken), top <= USUAL_HEIGHT + _GAP))
        if not any(taken):
            missed.append(corner)
    table = np.array(rows, dtype=bool)
    usual = table[table[:, 3], 2]
    return PalletReach(
        size=load,
        tried=len(table),
        horizontal=float(table[:, 0].mean()),
        vertical=float(table[:, 1].mean()),
        either=float(table[:, 2].mean()),
        usual=float(usual.mean()),
        missed=tuple(missed),
    )


def _positions(
    pallet: PalletStand, load: BoxSize
) -> Iterator[tuple[Vector3, dict[Approach, Task]]]:
    """Corners in the pallet's frame, with z above the floor, and what would be to do there."""
    length, width, deck = pallet.size
    depth, across, height = load.size
    tops = [*np.linspace(deck + height, USUAL_HEIGHT, _HIGH), LOAD_HEIGHT]
    for top in tops:
        z = float(top) - height - deck
        for x in np.linspace(0.0, length - across, _ACROSS).tolist():
            for y in np.linspace(0.0, width - depth, _DEEP).tolist():
                yield (x, y, z + deck), _tasks(pallet, load, (x, y, z))


def _tasks(pallet: PalletStand, load: BoxSize, corner: Vector3) -> dict[Approach, Task]:
    length, width, deck = pallet.size
    depth, across, height = load.size
    x, y, z = corner
    out, top = pallet.cell_from_pallet, z + height
    # The box's own x leads away from the robot, as the pallet's y does.
    turn = ((0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    centre = (x + across / 2, y + depth / 2, z + height / 2)
    box = OrientedBox(out @ Pose(centre, turn), load.size)
    rows = out.rotation
    front = (-rows[0][1], -rows[1][1], 0.0)
    below = _block((0.0, 0.0, 0.0), (length, width, z - _GAP))
    beside = [
        _block((0.0, y, z), (x - _GAP, width, top)),
        _block((x + across + _GAP, y, z), (length, width, top)),
    ]
    behind = _block((0.0, y + depth + _GAP, z), (length, width, LOAD_HEIGHT - deck))
    level = _block((0.0, y + depth + _GAP, z), (length, width, top))
    forth = depth + 0.02
    ways = {
        Approach.HORIZONTAL: (
            [below, *beside, behind],
            ((0.0, 0.0, _LIFT), (front[0] * forth, front[1] * forth, 0.0)),
        ),
        Approach.VERTICAL: (
            [below, *beside, level],
            ((0.0, 0.0, _UP), (front[0] * _FORTH, front[1] * _FORTH, 0.0)),
        ),
    }
    return {
        approach: Task(
            box,
            load,
            tuple(block.seen_from(out) for block in blocks if block is not None),
            moves,
        )
        for approach, (blocks, moves) in ways.items()
    }


def _block(low: Vector3, high: Vector3) -> OrientedBox | None:
    """A block of load between two corners; None where there is no room for one."""
    edges = [b - a for a, b in zip(low, high, strict=True)]
    if min(edges) < 10 * _GAP:
        return None
    return OrientedBox.from_corner(low, (edges[0], edges[1], edges[2]))
