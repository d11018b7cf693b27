"""One random pallet emptied by one policy: what it took, how late it was, how firmly it stood."""

import time
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from depal.selection.access import (
    Errand,
    Mask,
    Ways,
    fewest_removals,
    members,
    planned,
)
from depal.selection.score import STEP
from depal.selection.stability import THRESHOLD, Certificate, StandingPile, guard
from depal.studies.due import Wanted
from depal.studies.due.runs import Pallet
from depal.studies.retrieval.runs import W, joined, reached

AHEAD = 1e3
"""What leaves for the next request scores above all others."""


class Rule(Enum):
    """A policy of the benchmark."""

    PAPER = "paper"
    GUARDED_PAPER = "paper, guarded"
    ACCESS = "access"
    GUARDED_ACCESS = "access, guarded"

    @property
    def guarded(self) -> bool:
        """Whether boxes wait that would leave a pile with too little margin."""
        return self in {Rule.GUARDED_PAPER, Rule.GUARDED_ACCESS}

    @property
    def by_access(self) -> bool:
        """Whether boxes are taken by the ways that are open."""
        return self in {Rule.ACCESS, Rule.GUARDED_ACCESS}


@dataclass(frozen=True, slots=True)
class Unloaded:
    """One pallet, emptied as far as it went.

    Attributes:
        order: the boxes as they were stored.
        lateness: of the requests: priority times actions after due.
        least: boxes that had to leave before the first request's, at the least; None where it
            could never leave.
        seconds: of each decision, the guard's included.
    """

    order: tuple[int, ...]
    lateness: float
    least: int | None
    seconds: tuple[float, ...]


def emptied(pallet: Pallet, rule: Rule, pile: StandingPile) -> Unloaded:
    """Stores box after box until none is free.

    Args:
        pallet: the boxes, and requests that are all known from the start.
        rule: the policy.
        pile: the same boxes with their masses.
    """
    ways = pallet.ways if rule.by_access else joined(pallet.graph, pallet.ways)
    first = fewest_removals(ways, 1 << pallet.requests[0].box)
    open_requests, late = list(pallet.requests), 0.0
    order: list[int] = []
    seconds: list[float] = []
    gone = 0
    while free := ways.free(gone):
        start = time.perf_counter()
        scores = _scores(pallet, ways, rule, gone, open_requests)
        ranked = sorted(
            members(free), key=lambda box: (-round(scores[box] / STEP), pallet.rank[box])
        )
        chosen = _guarded(ranked, pile, order) if rule.guarded else ranked[0]
        seconds.append(time.perf_counter() - start)
        order.append(chosen)
        gone |= 1 << chosen
        late += sum(each.late(len(order)) for each in open_requests if each.box == chosen)
        open_requests = [each for each in open_requests if each.box != chosen]
    return Unloaded(tuple(order), late, None if first is None else first.least, tuple(seconds))


def _scores(
    pallet: Pallet, ways: Ways, rule: Rule, gone: Mask, known: Sequence[Wanted]
) -> list[float]:
    """Eq. (3) by the paper; by access what leaves for the agenda's next request comes first."""
    scores = [(1 - W) * h for h in pallet.h]
    if not rule.by_access:
        for each in known:
            for box in members(reached(pallet.graph, each.box)):
                scores[box] = max(scores[box], W * each.priority + (1 - W) * pallet.h[box])
        return scores
    left = ways.without(gone)
    found = [(each, fewest_removals(left, 1 << each.box)) for each in known]
    errands = [Errand(each.priority, plan.boxes, each.due) for each, plan in found if plan]
    count = float(gone.bit_count())
    for place, number in enumerate(planned(errands, 1.0, count).order):
        for box in members(errands[number].boxes):
            scores[box] = max(scores[box], AHEAD - place)
    return scores


def _guarded(ranked: list[int], pile: StandingPile, order: Sequence[int]) -> int:
    """The first that leaves a firm pile; the firmest where none does."""

    def certify(box: int) -> Certificate:
        return pile.certificate((*order, box), THRESHOLD)

    found = guard(ranked, certify).chosen
    return ranked[0] if found is None else found


def margins(
    pile: StandingPile, order: Sequence[int], enough: float
) -> list[tuple[tuple[int, ...], float]]:
    """What is gone and the margin of the pile that is left, after every removal but the last [g].

    Args:
        pile: the boxes.
        order: as they were stored.
        enough: above this a lower bound will do [g].
    """
    steps = [tuple(order[:count]) for count in range(1, len(order))]
    return [
        (gone, pile.certificate(gone, enough).margin) for gone in steps if len(gone) < len(pile)
    ]
