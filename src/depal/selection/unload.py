"""A whole pallet taken apart by the rule alone: the loop of case study 1, compiled."""

import numpy as np
import numpy.typing as npt

from depal.geometry import kernel
from depal.selection.links import BLOCKERS, NONE, Array, Indices, Links, remove
from depal.selection.score import mixed_score, stepped
from depal.selection.walks import propagate

Ranks = npt.NDArray[np.int64]


@kernel
def best_free(links: Links, score: Array, rank: Ranks) -> int:
    """The best-scored box that nothing blocks, ties by geometry; NONE where all are blocked."""
    steps = stepped(score)
    best = NONE
    for slot in range(len(links.slots)):
        if links.slots[slot, BLOCKERS] == 0 and (
            best == NONE
            or steps[slot] > steps[best]
            or (steps[slot] == steps[best] and rank[slot] < rank[best])
        ):
            best = slot
    return best


@kernel
def unload(
    links: Links,
    h: Array,
    rank: Ranks,
    wanted: Indices,
    priorities: Array,
    w: float,
    until: int,
    order: Indices,
) -> int:
    """Stores box after box by Algorithm 1, every leaf of G being graspable.

    Args:
        links: the graph; taken apart.
        h: (n,) Eq. (1).
        rank: (n,) the order that settles ties.
        wanted: (m,) slots of the requested boxes, by falling priority; one that has been
            stored no longer counts.
        priorities: (m,) their priorities.
        w: the weight of Eq. (3).
        until: stop before this box is stored, or NONE.
        order: (n,) filled with the slots in the order in which they are stored.

    Returns:
        How many boxes were stored; fewer than n when `until` came up or all left are blocked.
    """
    open_requests = np.ones(len(wanted), np.bool_)
    stored = 0
    while stored < len(order):
        l = propagate(links, wanted[open_requests], priorities[open_requests])  # noqa: E741
        best = best_free(links, mixed_score(h, l, w), rank)
        if best in (NONE, until):
            break
        remove(links, best)
        open_requests[wanted == best] = False
        order[stored] = best
        stored += 1
    return stored
