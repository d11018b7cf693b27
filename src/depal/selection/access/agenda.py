"""Which request first: the order of service that makes the weighted lateness least.

Eq. (2) of the paper lets every box inherit the greatest priority of what it stands before, and
knows no times. Here a request has a due time; being late costs its priority per second. Serving
requests in an order costs the removals that each one adds to those before it, so the time at
which one is served depends on the set served by then alone: dynamic programming over sets (Held
and Karp 1962) finds the best order. It is exact where the removals of a set are the union of
those of its requests: where no way leaves a choice.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from depal.selection.access.ways import Mask

MOST = 10
"""So many requests are ordered exactly; more are taken by urgency first."""

_LOOK_AHEAD = 2.0


@dataclass(frozen=True, slots=True)
class Errand:
    """A request and what it takes.

    Attributes:
        priority: p, the cost of a second of lateness.
        boxes: all that leave for it, its own box included.
        due: when it should be served [s since the start of the run].
    """

    priority: float
    boxes: Mask
    due: float


@dataclass(frozen=True, slots=True)
class Agenda:
    """An order of service.

    Attributes:
        order: the numbers of the errands, first first.
        lateness: the sum over all of priority times seconds after due [s].
        exact: whether no order of these sets is better.
    """

    order: tuple[int, ...]
    lateness: float
    exact: bool


def planned(errands: Sequence[Errand], pace: float, now: float = 0.0) -> Agenda:
    """The order that makes the weighted lateness least.

    Args:
        errands: what is wanted, and the boxes that leave for each.
        pace: how long one box takes [s].
        now: the time [s since the start of the run].

    Returns:
        The order; ties by number.
    """
    urgent = by_urgency(errands, pace, now)
    head, tail = urgent[:MOST], urgent[MOST:]
    order, late = _ordered(errands, head, pace, now)
    gone = 0
    for number in order:
        gone |= errands[number].boxes
    for number in tail:
        gone |= errands[number].boxes
        late += _late(errands[number], gone, pace, now)
    return Agenda((*order, *tail), late, exact=not tail)


def by_urgency(errands: Sequence[Errand], pace: float, now: float = 0.0) -> list[int]:
    """The errands by the apparent cost of their tardiness (Vepsalainen and Morton 1987).

    One after the other: priority over the removals still needed, less the more slack is left.
    """
    left, gone = list(range(len(errands))), 0
    order: list[int] = []
    while left:
        needs = {number: (errands[number].boxes & ~gone).bit_count() for number in left}
        typical = pace * max(sum(needs.values()) / len(left), 1.0)
        passed = now + pace * gone.bit_count()
        costs = {
            number: (_apparent(errands[number], passed, pace * needs[number], typical), number)
            for number in left
        }
        best = min(left, key=costs.__getitem__)
        left.remove(best)
        order.append(best)
        gone |= errands[best].boxes
    return order


def _apparent(errand: Errand, passed: float, takes: float, typical: float) -> float:
    """Minus the priority per second that it takes, fading with the slack that is left."""
    slack = max(0.0, errand.due - passed - takes)
    return -errand.priority / max(takes, typical / 100) * math.exp(-slack / (_LOOK_AHEAD * typical))


def lateness_of(
    errands: Sequence[Errand], order: Sequence[int], pace: float, now: float = 0.0
) -> float:
    """The weighted lateness of an order of service [s]."""
    gone, late = 0, 0.0
    for number in order:
        gone |= errands[number].boxes
        late += _late(errands[number], gone, pace, now)
    return late


def _ordered(
    errands: Sequence[Errand], numbers: Sequence[int], pace: float, now: float
) -> tuple[list[int], float]:
    """The best order of some errands and its lateness."""
    numbers = sorted(numbers)
    unions: list[Mask] = [0] * (1 << len(numbers))
    best: list[tuple[float, int]] = [(0.0, -1)] * (1 << len(numbers))
    for subset in range(1, 1 << len(numbers)):
        low = (subset & -subset).bit_length() - 1
        gone = unions[subset] = unions[subset & (subset - 1)] | errands[numbers[low]].boxes
        best[subset] = min(
            (best[subset & ~(1 << last)][0] + _late(errands[numbers[last]], gone, pace, now), last)
            for last in range(len(numbers))
            if subset >> last & 1
        )
    order: list[int] = []
    subset = (1 << len(numbers)) - 1
    late = best[subset][0]
    while subset:
        last = best[subset][1]
        order.append(numbers[last])
        subset &= ~(1 << last)
    return order[::-1], late


def _late(errand: Errand, gone: Mask, pace: float, now: float) -> float:
    return errand.priority * max(0.0, now + pace * gone.bit_count() - errand.due)
