"""Several requests with due times on one pallet, carried out box by box under three policies."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from depal.selection.access import (
    Errand,
    Mask,
    Ways,
    fewest_removals,
    members,
    planned,
)
from depal.selection.score import STEP
from depal.studies.due.optimum import Wanted
from depal.studies.retrieval.runs import W, joined, reached


@dataclass(frozen=True, slots=True)
class Pallet:
    """What all policies work on.

    Attributes:
        ways: how the boxes can be taken.
        graph: per box those that block it under G.
        h: (n,) Eq. (1).
        rank: (n,) the order that settles ties.
        requests: each for another box.
    """

    ways: Ways
    graph: Sequence[Mask]
    h: Sequence[float]
    rank: Sequence[int]
    requests: tuple[Wanted, ...]


def by_paper(pallet: Pallet) -> float | None:
    """The policy `paper`, w = .9: l by Eq. (2)'s maximum over T; due times are not heard.

    Returns:
        The weighted lateness in actions; None where a requested box was never free.
    """
    both = joined(pallet.graph, pallet.ways)
    sets = {each.box: reached(pallet.graph, each.box) for each in pallet.requests}
    return _carried_out(pallet, both, lambda _gone, _count, known: _inherited(pallet, known, sets))


def by_maximum(pallet: Pallet) -> float | None:
    """`access` with Eq. (2)'s maximum over the fewest removals; due times are not heard.

    Returns:
        The weighted lateness in actions; None where a requested box was never free.
    """

    def choose(gone: Mask, _count: int, known: Sequence[Wanted]) -> list[float]:
        left = pallet.ways.without(gone)
        sets = {each.box: _removal(left, each.box) for each in known}
        return _inherited(pallet, known, sets)

    return _carried_out(pallet, pallet.ways, choose)


def by_agenda(pallet: Pallet) -> float | None:
    """`access` with the order of service that makes the weighted lateness least.

    Returns:
        The weighted lateness in actions; None where a requested box was never free.
    """

    def choose(gone: Mask, count: int, known: Sequence[Wanted]) -> list[float]:
        scores = [(1 - W) * each for each in pallet.h]
        left = pallet.ways.without(gone)
        errands = [
            Errand(each.priority, _removal(left, each.box), each.due)
            for each in known
            if left.present >> each.box & 1
        ]
        agenda = planned(errands, 1.0, float(count))
        for place, number in enumerate(agenda.order):
            for box in members(errands[number].boxes):
                scores[box] = max(scores[box], 1e3 - place)
        return scores

    return _carried_out(pallet, pallet.ways, choose)


def _removal(ways: Ways, box: int) -> Mask:
    found = fewest_removals(ways, 1 << box)
    return 0 if found is None else found.boxes


def _inherited(pallet: Pallet, known: Sequence[Wanted], sets: dict[int, Mask]) -> list[float]:
    """Eqs. (2) and (3): every box inherits the greatest priority of what it is removed for."""
    scores = []
    for box, h in enumerate(pallet.h):
        inherited = max((each.priority for each in known if sets[each.box] >> box & 1), default=0.0)
        scores.append(W * inherited + (1 - W) * h)
    return scores


def _carried_out(
    pallet: Pallet, ways: Ways, scored: Callable[[Mask, int, Sequence[Wanted]], list[float]]
) -> float | None:
    """Stores the best free box, over and over, until every request is served."""
    gone, late = 0, 0.0
    open_requests = list(pallet.requests)
    count = 0
    while open_requests:
        free = ways.free(gone)
        if not free:
            return None
        known = [each for each in open_requests if each.arrived <= count]
        scores = scored(gone, count, known)
        best = min(members(free), key=lambda box: (-round(scores[box] / STEP), pallet.rank[box]))
        gone |= 1 << best
        count += 1
        for each in [each for each in open_requests if each.box == best]:
            late += each.late(count)
            open_requests.remove(each)
    return late
