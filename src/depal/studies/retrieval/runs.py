"""One request carried out, box by box, under a model of what blocks what."""

from collections.abc import Sequence
from dataclasses import dataclass

from depal.selection.access import Mask, Removal, Way, Ways, fewest_removals, members
from depal.selection.score import STEP

W = 0.9
"""The weight of the policy `paper` here: it is then at the limit of its own rule."""


@dataclass(frozen=True, slots=True)
class Retrieval:
    """What one request took.

    Attributes:
        actions: boxes that were stored before the requested one; None where it was never free.
        least: the proven minimum under the policy's own rule; None where there is no order.
        proven: whether the plan that was followed is known to be the smallest.
    """

    actions: int | None
    least: int | None
    proven: bool


def by_access(ways: Ways, requested: int, rank: Sequence[int]) -> Retrieval:
    """The policy `access`: the boxes of the fewest removals, by falling h as they become free.

    Args:
        ways: how boxes can be taken.
        requested: the box that is asked for.
        rank: per box its place in the order by h.
    """
    plan = fewest_removals(ways, 1 << requested)
    if plan is None:
        return Retrieval(None, None, proven=True)
    return Retrieval(len(carried_out(ways, plan, rank)) - 1, plan.least, plan.gap == 0)


def carried_out(ways: Ways, plan: Removal, rank: Sequence[int]) -> list[int]:
    """The boxes of a plan in the order in which they leave, the requested ones as soon as free."""
    gone, order = 0, list[int]()
    while plan.wanted & ~gone:
        free = ways.free(gone) & plan.boxes
        best = min(members(free & plan.wanted or free), key=rank.__getitem__)
        gone |= 1 << best
        order.append(best)
    return order


def by_paper(graph: Sequence[Mask], ways: Ways, requested: int, scores: "Scores") -> Retrieval:
    """The policy `paper`, w = W: the best leaf of G that has an open way.

    Args:
        graph: per box those that block it under G.
        ways: how boxes can be taken; a leaf of G without an open way is passed over.
        requested: the box that is asked for.
        scores: of the boxes, and the priority of the request.
    """
    both = joined(graph, ways)
    least = fewest_removals(both, 1 << requested)
    wanted = reached(graph, requested)
    gone, count = 0, 0
    while True:
        free = both.free(gone)
        if not free:
            return Retrieval(None, None if least is None else least.least, proven=True)
        best = min(members(free), key=lambda box: scores.key(box, wanted))
        if best == requested:
            break
        gone |= 1 << best
        count += 1
    return Retrieval(count, None if least is None else least.least, proven=True)


def joined(graph: Sequence[Mask], ways: Ways) -> Ways:
    """The ways that also wait for all that blocks under G."""
    return Ways.among(
        members(ways.present),
        (
            Way(way.box, way.approach, way.blockers | graph[way.box])
            for each in ways.of
            for way in each
        ),
    )


def reached(graph: Sequence[Mask], box: int) -> Mask:
    """T(b): everything that blocks a box under G, directly or not, itself included."""
    found = open_boxes = 1 << box
    while open_boxes:
        low = open_boxes & -open_boxes
        new = graph[low.bit_length() - 1] & ~found
        found |= new
        open_boxes = (open_boxes ^ low) | new
    return found


@dataclass(frozen=True, slots=True)
class Scores:
    """What Eq. (3) mixes.

    Attributes:
        h: (n,) Eq. (1).
        rank: (n,) the order that settles ties.
        priority: p of the request.
    """

    h: Sequence[float]
    rank: Sequence[int]
    priority: float = 1.0

    def key(self, box: int, wanted: Mask) -> tuple[int, int]:
        """The best box has the smallest; a box of T(r) inherits p."""
        inherited = self.priority if wanted >> box & 1 else 0.0
        return -round((W * inherited + (1 - W) * self.h[box]) / STEP), self.rank[box]
