"""Which front and which top are of one box."""

from collections.abc import Sequence

import numpy as np
from scipy.optimize import linear_sum_assignment

from depal.perception.assembling.edges import Lying

AWAY = (0.030, 0.025, 0.030)
"""The shared edge, seen twice, may differ by so much along x, y, z [m]."""

WIDTH = 0.035
"""Widths of the two may differ by so much [m]."""

NEVER = 100.0


def paired(fronts: Sequence[Lying], tops: Sequence[Lying]) -> list[tuple[int, int]]:
    """Pairs of a front and a top that meet in one edge.

    Args:
        fronts: faces that look to the viewer.
        tops: faces that look up.

    Returns:
        Indices; each face is in one pair at the most.
    """
    if not fronts or not tops:
        return []
    cost = np.array([[_apart(front, top) for top in tops] for front in fronts])
    rows, columns = linear_sum_assignment(cost)
    return [
        (int(row), int(column))
        for row, column in zip(rows, columns, strict=True)
        if cost[row, column] < NEVER
    ]


def _apart(front: Lying, top: Lying) -> float:
    """How badly two faces fit together; `NEVER` where they cannot."""
    away = [
        abs(a - b) / limit
        for a, b, limit in zip(front.front_edge, top.front_edge, AWAY, strict=True)
    ]
    away.append(abs(front.width - top.width) / WIDTH)
    if max(away) > 1.0:
        return NEVER
    names = front.face.name, top.face.name
    if names[0] and names[1] and names[0].gtin != names[1].gtin:
        certain = names[0].certain and names[1].certain
        return NEVER if certain else sum(away) + 1.0
    return sum(away)
