"""The least weighted lateness there is: dynamic programming over sets of boxes."""

from collections.abc import Sequence
from dataclasses import dataclass

from depal.selection.access import Mask, Ways, members

MOST_BOXES = 12
"""So many boxes at the most: the sets double with each."""


@dataclass(frozen=True, slots=True)
class Wanted:
    """A request for one box.

    Attributes:
        box: its number.
        priority: p, the cost of an action of lateness.
        arrived: after so many actions the request is known.
        due: after so many actions the box should have been stored.
    """

    box: int
    priority: float
    arrived: int
    due: float

    def late(self, served: int) -> float:
        """The cost of being served as the action with this number, from 1."""
        return self.priority * max(0.0, served - self.due)


def least_lateness(ways: Ways, requests: Sequence[Wanted]) -> float | None:
    """The weighted lateness of the best order of all boxes, every request known from the start.

    It knows nothing of removal sets: it goes through every set of boxes that can have left.

    Args:
        ways: how boxes can be taken; at most `MOST_BOXES`.
        requests: each for another box.

    Returns:
        The sum over requests of priority times actions after due; None where a requested box
        can never leave.
    """
    of = {each.box: each for each in requests}
    wanted = sum(1 << box for box in of)
    level: dict[Mask, float] = {0: 0.0}
    least: float | None = None
    for count in range(1, ways.present.bit_count() + 1):
        after: dict[Mask, float] = {}
        for gone, late in level.items():
            for box in members(ways.free(gone)):
                cost = late + (of[box].late(count) if box in of else 0.0)
                left = gone | 1 << box
                if cost < after.get(left, float("inf")):
                    after[left] = cost
        done = [cost for left, cost in after.items() if not wanted & ~left]
        least = min([*done, *([] if least is None else [least])], default=None)
        level = {left: cost for left, cost in after.items() if wanted & ~left}
    return least
