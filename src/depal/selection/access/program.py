"""The fewest removals as an integer program, exact where ways leave a choice.

x_b says that box b leaves, y_w that it leaves by way w: x_b <= sum of its y, y_w <= x of each of
the way's blockers. That alone lets boxes justify one another in a ring; where a solution cannot be
carried out, the set S of its stuck boxes gives a cut: if any box of S leaves, one of S leaves by
a way that no box of S blocks (a loop formula, Lin and Zhao 2004). Rounds go on until a solution
can be carried out: it is then the optimum.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import csr_array

from depal.selection.access.ways import Mask, Way, Ways, mask_of, members

Floats = npt.NDArray[np.float64]

_WHOLE = 0.5
_SLACK = 1e-6


@dataclass(frozen=True, slots=True)
class Limits:
    """How long an exact search may go on.

    Attributes:
        rounds: programs that are solved at the most.
        nodes: nodes of each program's search tree at the most.
    """

    rounds: int = 200
    nodes: int = 20_000


@dataclass(frozen=True, slots=True)
class Solution:
    """What a search has by its end.

    Attributes:
        boxes: a set that can leave.
        bound: no set that can leave and holds the targets has fewer boxes.
        rounds: programs that were solved.
    """

    boxes: Mask
    bound: int
    rounds: int


def solved(ways: Ways, wanted: Mask, known: Mask, least: Mask, limits: Limits) -> Solution:
    """The smallest set that can leave and holds the wanted boxes.

    Args:
        ways: no box of `known` waits for one that can never leave.
        wanted: boxes that shall leave.
        known: a set that can leave and holds them.
        least: boxes that leave in any case.
        limits: the search ends with what it has then.
    """
    model = _Model(ways, wanted | least)
    best, bound = known, least.bit_count()
    for number in range(1, limits.rounds + 1):
        answer = model.solve(limits.nodes)
        if answer is None:
            return Solution(best, min(bound, best.bit_count()), number)
        leaving, proven = answer
        bound = max(bound, min(proven, best.bit_count()))
        gone = ways.peeled(leaving)
        if wanted & ~gone == 0 and gone.bit_count() < best.bit_count():
            best = gone
        stuck = leaving & ~gone
        if best.bit_count() <= bound or not stuck:
            return Solution(best, bound, number)
        model.forbid(stuck)
    return Solution(best, bound, limits.rounds)


class _Model:
    """The program, with the cuts so far."""

    def __init__(self, ways: Ways, leaving: Mask) -> None:
        self._boxes = list(members(ways.present))
        self._ways: list[Way] = [way for box in self._boxes for way in ways.of[box]]
        self._column = {box: column for column, box in enumerate(self._boxes)}
        self._rows: list[dict[int, float]] = []
        offset = len(self._boxes)
        of_box: dict[int, list[int]] = {box: [] for box in self._boxes}
        for number, way in enumerate(self._ways):
            of_box[way.box].append(offset + number)
            for blocker in members(way.blockers):
                self._rows.append({offset + number: 1.0, self._column[blocker]: -1.0})
        for box in self._boxes:
            self._rows.append({self._column[box]: 1.0, **dict.fromkeys(of_box[box], -1.0)})
        self._lower = np.zeros(offset + len(self._ways))
        for box in members(leaving):
            self._lower[self._column[box]] = 1.0

    def forbid(self, stuck: Mask) -> None:
        """A set whose boxes wait for one another leaves only from outside."""
        offset = len(self._boxes)
        outward = {
            offset + number: -1.0
            for number, way in enumerate(self._ways)
            if stuck >> way.box & 1 and not way.blockers & stuck
        }
        for box in members(stuck):
            self._rows.append({self._column[box]: 1.0, **outward})

    def solve(self, nodes: int) -> tuple[Mask, int] | None:
        """A best set that the program allows, and its proven bound; None where it found none."""
        cost = np.zeros(len(self._lower))
        cost[: len(self._boxes)] = 1.0
        pairs = [(row, *entry) for row, each in enumerate(self._rows) for entry in each.items()]
        rows, columns, values = (np.array(part) for part in zip(*pairs, strict=True))
        matrix = csr_array((values, (rows, columns)), shape=(len(self._rows), len(cost)))
        result = milp(
            cost,
            integrality=np.ones(len(cost), np.int64),
            bounds=Bounds(self._lower, 1.0),
            constraints=LinearConstraint(matrix, -np.inf, 0.0),
            options={"node_limit": nodes},
        )
        if result.x is None:
            return None
        chosen: Floats = result.x[: len(self._boxes)]
        bound = int(np.ceil(result.mip_dual_bound - _SLACK))
        leaving = mask_of(box for box, x in zip(self._boxes, chosen, strict=True) if x > _WHOLE)
        return leaving, bound
