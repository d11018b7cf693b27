"""Walks over the edges of G: T(b), the propagation of priorities, cycles."""

import numpy as np
import numpy.typing as npt

from depal.geometry import kernel, loop_kernel
from depal.selection.links import (
    BLOCKED,
    BLOCKER,
    BLOCKERS,
    EMPTY,
    FIRST_BLOCKED,
    FIRST_BLOCKER,
    NEXT_BLOCKED,
    NEXT_BLOCKER,
    NONE,
    RELATION,
    Indices,
    Links,
)
from depal.selection.score import geometric_rank

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]


@loop_kernel
def mark_reachable(links: Links, slot: int, marked: Mask, stack: Indices) -> int:
    """Marks T(b): everything reachable from a box over its blockers, itself included.

    Args:
        links: the graph.
        slot: the box to start from.
        marked: (slots,) already marked slots are not entered again.
        stack: (slots,) scratch.

    Returns:
        How many slots were newly marked; they are listed at the front of `stack`, not in any
        promised order.
    """
    if marked[slot]:
        return 0
    marked[slot] = True
    stack[0] = slot
    done, found = 0, 1
    while done < found:
        edge = links.slots[stack[done], FIRST_BLOCKER]
        done += 1
        while edge != NONE:
            blocker = links.edges[edge, BLOCKER]
            if not marked[blocker]:
                marked[blocker] = True
                stack[found] = blocker
                found += 1
            edge = links.edges[edge, NEXT_BLOCKER]
    return found


@kernel
def propagate(links: Links, wanted: Indices, priorities: Array) -> Array:
    """Eq. (2): l(b) = max over the requested x with v(b) in T(x) of p(x), 0 where there is none.

    Args:
        links: the graph.
        wanted: (m,) slots of the requested boxes, by falling priority.
        priorities: (m,) their priorities p.

    Returns:
        (slots,) l of every slot.
    """
    slots = len(links.slots)
    inherited = np.zeros(slots)
    marked = np.zeros(slots, np.bool_)
    stack = np.empty(slots, np.int32)
    for index in range(len(wanted)):
        # A box marked before has inherited a priority that is at least as high.
        for position in range(mark_reachable(links, wanted[index], marked, stack)):
            inherited[stack[position]] = priorities[index]
    return inherited


@kernel
def never_free(links: Links) -> Mask:
    """The boxes that stay blocked however many free ones leave: those behind a cycle.

    Returns:
        (slots,) True for the boxes of every cycle and everything that they block.
    """
    slots = len(links.slots)
    left = links.slots[:, BLOCKERS].copy()
    queue = np.empty(slots, np.int32)
    found = 0
    for slot in range(slots):
        if left[slot] == 0:
            queue[found] = slot
            found += 1
    done = 0
    while done < found:
        edge = links.slots[queue[done], FIRST_BLOCKED]
        done += 1
        while edge != NONE:
            blocked = links.edges[edge, BLOCKED]
            left[blocked] -= 1
            if left[blocked] == 0:
                queue[found] = blocked
                found += 1
            edge = links.edges[edge, NEXT_BLOCKED]
    return left > 0


@kernel
def blockers_of(links: Links, slot: int) -> tuple[Indices, Indices]:
    """The slots that block a box, and how (Relation), newest first."""
    count = max(links.slots[slot, BLOCKERS], 0)
    slots = np.empty(count, np.int32)
    relations = np.empty(count, np.int32)
    edge = links.slots[slot, FIRST_BLOCKER]
    for position in range(count):
        slots[position] = links.edges[edge, BLOCKER]
        relations[position] = links.edges[edge, RELATION]
        edge = links.edges[edge, NEXT_BLOCKER]
    return slots, relations


@kernel
def blocker_table(links: Links) -> tuple[Indices, Indices, Indices]:
    """All blockers at once: the blockers of slot i stand at offsets[i] .. offsets[i + 1].

    Returns:
        offsets (slots + 1,), slots of the blockers (edges,), relations (edges,).
    """
    slots = len(links.slots)
    offsets = np.zeros(slots + 1, np.int32)
    for slot in range(slots):
        offsets[slot + 1] = offsets[slot] + max(links.slots[slot, BLOCKERS], 0)
    blockers = np.empty(offsets[slots], np.int32)
    relations = np.empty(offsets[slots], np.int32)
    for slot in range(slots):
        if links.slots[slot, BLOCKERS] == EMPTY:
            continue
        edge = links.slots[slot, FIRST_BLOCKER]
        for position in range(offsets[slot], offsets[slot + 1]):
            blockers[position] = links.edges[edge, BLOCKER]
            relations[position] = links.edges[edge, RELATION]
            edge = links.edges[edge, NEXT_BLOCKER]
    return offsets, blockers, relations


def find_cycle(links: Links, prisms: Array) -> list[int]:
    """One cycle of blockers, in slots, each blocked by the next; empty where there is none.

    Args:
        links: the graph.
        prisms: (slots, 8); their geometry alone decides which cycle is named.

    Returns:
        The cycle met first from the first box behind one, beginning with its first box.
    """
    stuck = never_free(links)
    if not stuck.any():
        return []
    rank = geometric_rank(prisms)
    slots = np.flatnonzero(stuck)
    slot = int(slots[np.argmin(rank[slots])])
    met: dict[int, int] = {}
    path: list[int] = []
    while slot not in met:
        met[slot] = len(path)
        path.append(slot)
        blockers, _ = blockers_of(links, slot)
        # Every box behind a cycle has a blocker that is itself behind one.
        slot = min((int(b) for b in blockers if stuck[b]), key=lambda b: int(rank[b]))
    cycle = path[met[slot] :]
    first = min(range(len(cycle)), key=lambda position: int(rank[cycle[position]]))
    return cycle[first:] + cycle[:first]
