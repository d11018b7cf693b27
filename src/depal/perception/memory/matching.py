"""Which seen box is which remembered one."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from scipy.optimize import linear_sum_assignment

from depal.perception.faces import SeenBox
from depal.perception.memory.anchors import anchors_of, differences
from depal.perception.memory.remembered import Remembered

Array = npt.NDArray[np.float64]

STILL = 0.045
"""A box that has not moved is found again within this, position and size together [m]."""

FAR = 0.20
"""A box that was pushed is found again within this [m]."""

ALIKE = 0.02
"""Edges of the same box differ by less from look to look [m]."""

RENAMED = 0.03
"""A product's name that differs weighs as much as this distance [m]."""

NEVER = 1e3


def matched(old: Sequence[Remembered], new: Sequence[SeenBox]) -> dict[int, int]:
    """Pairs of what is remembered and what is seen, by their indices.

    First those that stand where they stood; then, among the rest, those that were moved a little:
    of the same size and, where known, the same product.
    """
    if not old or not new:
        return {}
    shift, size = differences(
        anchors_of([box.seen.shape for box in old]), anchors_of([box.shape for box in new])
    )
    clash = np.array([[_renamed(a, b) for b in new] for a in old], dtype=bool)
    still = shift + size + clash * RENAMED
    pairs = _assigned(np.where(shift + size < STILL, still, NEVER))
    pushed = np.where((shift < FAR) & (size < ALIKE) & ~clash, shift + size, NEVER)
    pushed[list(pairs), :] = NEVER
    pushed[:, list(pairs.values())] = NEVER
    return {**pairs, **_assigned(pushed)}


def _renamed(old: Remembered, new: SeenBox) -> bool:
    return None not in {old.seen.gtin, new.gtin} and old.seen.gtin != new.gtin


def _assigned(cost: Array) -> dict[int, int]:
    rows, columns = linear_sum_assignment(cost)
    return {
        int(row): int(column)
        for row, column in zip(rows, columns, strict=True)
        if cost[row, column] < NEVER
    }
