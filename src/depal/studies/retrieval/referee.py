"""A second proof of the fewest removals, from another program: every box with a place in line.

Here the order is part of the program (Miller, Tucker and Zemlin 1960): u_b is when box b leaves,
and a way by which it leaves makes u_b at least one more than that of each blocker. It is slower
than the program of the policy, shares no line with it, and needs no cuts.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import lil_array

from depal.selection import EXACT
from depal.selection.access import Ways, fewest_removals, free_ways, members
from depal.studies.case1 import draw_trial
from depal.studies.pallets import generator_named


def least_in_line(ways: Ways, requested: int) -> int | None:
    """The fewest boxes that leave before a requested one.

    Args:
        ways: how boxes can be taken.
        requested: the box that is asked for.

    Returns:
        The number; None where no order exists.
    """
    boxes = list(members(ways.present))
    column = {box: index for index, box in enumerate(boxes)}
    listed = [way for box in boxes for way in ways.of[box]]
    n, m = len(boxes), len(listed)
    pairs = [(k, way.box, other) for k, way in enumerate(listed) for other in members(way.blockers)]
    matrix = lil_array((2 * len(pairs) + n, 2 * n + m))
    upper = np.zeros(matrix.shape[0])
    for row, (k, box, other) in enumerate(pairs):
        matrix[row, n + k], matrix[row, column[other]] = 1.0, -1.0
        # u_other + 1 <= u_box where way k is taken
        line = len(pairs) + row
        matrix[line, n + m + column[other]], matrix[line, n + m + column[box]] = 1.0, -1.0
        matrix[line, n + k] = n
        upper[line] = n - 1
    for index, box in enumerate(boxes):
        row = 2 * len(pairs) + index
        matrix[row, index] = 1.0
        for k, way in enumerate(listed):
            if way.box == box:
                matrix[row, n + k] = -1.0
    cost = np.concatenate((np.ones(n), np.zeros(m + n)))
    lower = np.zeros(2 * n + m)
    lower[column[requested]] = 1.0
    result = milp(
        cost,
        integrality=np.concatenate((np.ones(n + m, np.int64), np.zeros(n, np.int64))),
        bounds=Bounds(lower, np.concatenate((np.ones(n + m), np.full(n, float(n))))),
        constraints=LinearConstraint(matrix.tocsr(), -np.inf, upper),
    )
    return None if result.x is None else round(result.fun) - 1


@dataclass(frozen=True, slots=True)
class Checked:
    """Pallets on which the policy was compared with the second program.

    Attributes:
        pallets: the generator's name.
        compared: how many.
        equal: on how many both say the same.
        chosen: on how many a way had to be chosen: no closure proves those.
    """

    pallets: str
    compared: int
    equal: int
    chosen: int


def checked(piece: tuple[str, int, int]) -> Checked:
    """Compares both programs on the first pallets of a seed.

    Args:
        piece: the generator's name, the seed, and how many.
    """
    generator, seed, pallets = piece
    generate = generator_named(generator)
    answers: Sequence[tuple[bool, bool]] = [
        _agree(free_ways(trial.pallet.prisms, EXACT), trial.requested)
        for trial in (draw_trial(generate, seed, index) for index in range(pallets))
    ]
    equal, chosen = (sum(column) for column in zip(*answers, strict=True))
    return Checked(generator, pallets, equal, chosen)


def _agree(ways: Ways, requested: int) -> tuple[bool, bool]:
    found = fewest_removals(ways, 1 << requested)
    least = least_in_line(ways, requested)
    if found is None or least is None:
        return found is None and least is None, False
    return found.actions == least and found.gap == 0, found.rounds > 0
