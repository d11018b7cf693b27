"""Which sides of a held box the arm can show to the barcode reader."""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from depal.cell.checking.mover import Mover
from depal.cell.checking.sizes import BoxSize
from depal.cell.planning.showing import before_lens
from depal.domain import Approach, ReaderMount
from depal.geometry import OrientedBox, Vector3

_SIDES = {
    "far": (1.0, 0.0, 0.0),
    "left": (0.0, 1.0, 0.0),
    "right": (0.0, -1.0, 0.0),
    "near": (-1.0, 0.0, 0.0),
}
"""Sides of a box by their normals, as the arm sees it that takes it from the front."""


@dataclass(frozen=True, slots=True)
class ReaderReach:
    """What can be shown of one box size by one grasp.

    Attributes:
        size: the box.
        approach: how it is held.
        held: whether there is a way to hold it so.
        sides: names of the upright sides whose middle can be shown.
    """

    size: BoxSize
    approach: Approach
    held: bool
    sides: tuple[str, ...]


def check_reader_reach(
    mover: Mover, reader: ReaderMount, sizes: Sequence[BoxSize]
) -> tuple[ReaderReach, ...]:
    """Tries to show every upright side that the tool leaves free, the box upright.

    Args:
        mover: the arm.
        reader: where it looks.
        sizes: of the boxes.
    """
    return tuple(
        ReaderReach(
            load,
            approach,
            bool(mover.ways(load, approach)),
            tuple(_shown(mover, reader, load, approach)),
        )
        for load, approach in itertools.product(sizes, Approach)
    )


def _shown(mover: Mover, reader: ReaderMount, load: BoxSize, approach: Approach) -> list[str]:
    return [
        side
        for side, normal in _SIDES.items()
        if not (approach is Approach.HORIZONTAL and side == "near")
        and any(
            mover.shows(_before(reader, load, normal), load, grasp)
            for grasp in mover.ways(load, approach)
        )
    ]


def _before(reader: ReaderMount, load: BoxSize, normal: Vector3) -> OrientedBox:
    """The box with the middle of one side where labels are to be shown, facing the lens."""
    return OrientedBox(before_lens(reader, load.size, np.array(normal)), load.size)
