"""The edges of G as doubly linked lists in arrays.

Boxes sit in numbered slots. Every edge stands in two lists: with the box that is blocked
(its blockers) and with the box that blocks (those it blocks). So a box leaves in time
proportional to its own edges, and memory is proportional to the edges alone.
"""

from typing import NamedTuple, Self

import numpy as np
import numpy.typing as npt

from depal.geometry import loop_kernel
from depal.selection.relations import A_SHIFT, BOTH, CLASH, relate

Array = npt.NDArray[np.float64]
Indices = npt.NDArray[np.int32]

NONE = -1
EMPTY = -1
"""The number of blockers of a slot without a box."""

BUILT, POOL_FULL = -1, -2

BLOCKERS, FIRST_BLOCKER, FIRST_BLOCKED = range(3)
BLOCKED, BLOCKER, RELATION, NEXT_BLOCKER, LAST_BLOCKER, NEXT_BLOCKED, LAST_BLOCKED = range(7)


class Links(NamedTuple):
    """The arrays: a row per slot and a row per edge.

    Attributes:
        slots: (slots, 3) per slot: how many boxes block its box, or EMPTY where there is none;
            the first edge in which it is blocked and the first in which it blocks, or NONE.
        edges: (edges, 7) per edge: the slot of b1 and of b2, how b2 stands to b1 (Relation),
            and the next and previous edge of the same b1, then of the same b2. A free edge
            names the next free one as its NEXT_BLOCKER.
        free: (2,) the first free edge, and how many are in use.
    """

    slots: Indices
    edges: Indices
    free: Indices

    @classmethod
    def empty(cls, slots: int, edges: int) -> Self:
        """Room for that many boxes and edges, none of them in use."""
        rows = np.empty((edges, 7), np.int32)
        rows[:, NEXT_BLOCKER] = np.arange(1, edges + 1)
        rows[-1:, NEXT_BLOCKER] = NONE
        first = 0 if edges else NONE
        return cls(np.full((slots, 3), NONE, np.int32), rows, np.array([first, 0], np.int32))

    @property
    def blockers(self) -> Indices:
        """(slots,) how many boxes block each slot's box, or EMPTY."""
        return self.slots[:, BLOCKERS]

    def copy(self) -> Self:
        """The same edges, to be changed on their own."""
        return type(self)(self.slots.copy(), self.edges.copy(), self.free.copy())

    def grown(self, slots: int, edges: int) -> Self:
        """The same edges with room for more of both."""
        room = type(self).empty(slots, edges)
        room.slots[: len(self.slots)] = self.slots
        old = len(self.edges)
        room.edges[:old] = self.edges
        room.free[:] = self.free
        if edges > old:  # the new edges go in front of the old free list
            room.edges[-1, NEXT_BLOCKER] = self.free[0]
            room.free[0] = old
        return room


@loop_kernel
def link(links: Links, blocked: int, blocker: int, relation: int) -> bool:
    """Adds an edge; False, and nothing done, when there is no room."""
    edge = links.free[0]
    if edge == NONE:
        return False
    links.free[0] = links.edges[edge, NEXT_BLOCKER]
    links.free[1] += 1
    links.edges[edge, BLOCKED] = blocked
    links.edges[edge, BLOCKER] = blocker
    links.edges[edge, RELATION] = relation
    links.edges[edge, LAST_BLOCKER] = NONE
    links.edges[edge, NEXT_BLOCKER] = links.slots[blocked, FIRST_BLOCKER]
    if links.slots[blocked, FIRST_BLOCKER] != NONE:
        links.edges[links.slots[blocked, FIRST_BLOCKER], LAST_BLOCKER] = edge
    links.slots[blocked, FIRST_BLOCKER] = edge
    links.edges[edge, LAST_BLOCKED] = NONE
    links.edges[edge, NEXT_BLOCKED] = links.slots[blocker, FIRST_BLOCKED]
    if links.slots[blocker, FIRST_BLOCKED] != NONE:
        links.edges[links.slots[blocker, FIRST_BLOCKED], LAST_BLOCKED] = edge
    links.slots[blocker, FIRST_BLOCKED] = edge
    links.slots[blocked, BLOCKERS] += 1
    return True


@loop_kernel
def unlink(links: Links, slot: int) -> None:
    """Takes every edge of a slot away; the slot keeps its box."""
    edge = links.slots[slot, FIRST_BLOCKED]
    while edge != NONE:
        after = links.edges[edge, NEXT_BLOCKED]
        blocked = links.edges[edge, BLOCKED]
        links.slots[blocked, BLOCKERS] -= 1
        _leave_blockers(links, blocked, edge)
        _give_back(links, edge)
        edge = after
    edge = links.slots[slot, FIRST_BLOCKER]
    while edge != NONE:
        after = links.edges[edge, NEXT_BLOCKER]
        _leave_blocked(links, links.edges[edge, BLOCKER], edge)
        _give_back(links, edge)
        edge = after
    links.slots[slot, FIRST_BLOCKED] = NONE
    links.slots[slot, FIRST_BLOCKER] = NONE
    links.slots[slot, BLOCKERS] = 0


@loop_kernel
def _leave_blockers(links: Links, blocked: int, edge: int) -> None:
    before, after = links.edges[edge, LAST_BLOCKER], links.edges[edge, NEXT_BLOCKER]
    if before == NONE:
        links.slots[blocked, FIRST_BLOCKER] = after
    else:
        links.edges[before, NEXT_BLOCKER] = after
    if after != NONE:
        links.edges[after, LAST_BLOCKER] = before


@loop_kernel
def _leave_blocked(links: Links, blocker: int, edge: int) -> None:
    before, after = links.edges[edge, LAST_BLOCKED], links.edges[edge, NEXT_BLOCKED]
    if before == NONE:
        links.slots[blocker, FIRST_BLOCKED] = after
    else:
        links.edges[before, NEXT_BLOCKED] = after
    if after != NONE:
        links.edges[after, LAST_BLOCKED] = before


@loop_kernel
def _give_back(links: Links, edge: int) -> None:
    links.edges[edge, NEXT_BLOCKER] = links.free[0]
    links.free[0] = edge
    links.free[1] -= 1


@loop_kernel
def remove(links: Links, slot: int) -> None:
    """The box in a slot has left: its edges go, the slot is empty."""
    unlink(links, slot)
    links.slots[slot, BLOCKERS] = EMPTY


@loop_kernel
def link_pair(links: Links, a: int, b: int, code: int) -> bool:
    """Adds the edges of a pair code; False when there is no room."""
    b_to_a, a_to_b = code & BOTH, (code >> A_SHIFT) & BOTH
    if b_to_a and not link(links, a, b, b_to_a):
        return False
    return not a_to_b or link(links, b, a, a_to_b)


@loop_kernel
def link_all(
    prisms: Array,
    order: Indices,
    lows: Array,
    highs: Array,
    overlap: float,
    slack: float,
    links: Links,
) -> tuple[int, int]:
    """Finds every edge by a sweep along y, in which both relations need an overlap.

    Args:
        prisms: (n, 8), one per slot.
        order: (n,) the slots by rising `lows`.
        lows: (n,) the lower end of each prism's extent along y [m].
        highs: (n,) the upper end [m].
        overlap: see Tolerances [m].
        slack: see Tolerances [m].
        links: empty, with at least n slots; the edges are added.

    Returns:
        (BUILT, BUILT); or (POOL_FULL, POOL_FULL) when the edges do not fit; or the two slots
        whose boxes are in one place.
    """
    for slot in order:
        links.slots[slot, BLOCKERS] = 0
    for position in range(len(order)):
        a = order[position]
        for later in range(position + 1, len(order)):
            b = order[later]
            if lows[b] >= highs[a]:
                break
            code = relate(prisms, a, b, overlap, slack)
            if code == CLASH:
                return a, b
            if code != 0 and not link_pair(links, a, b, code):
                return POOL_FULL, POOL_FULL
    return BUILT, BUILT


@loop_kernel
def relate_to_all(
    prisms: Array, slot: int, links: Links, overlap: float, slack: float, codes: Indices
) -> int:
    """The pair codes of one slot's prism against every other box, without changing anything.

    Args:
        prisms: (slots, 8).
        slot: the prism that is a of each pair; its slot may still be empty.
        links: says which slots hold a box.
        overlap: see Tolerances [m].
        slack: see Tolerances [m].
        codes: (slots,) filled with the codes, 0 for the slot itself.

    Returns:
        How many edges the codes hold; or NONE when a box is in the same place: `codes` then
        holds CLASH for the first such box.
    """
    edges = 0
    for other in range(len(links.slots)):
        codes[other] = 0
        if other == slot or links.slots[other, BLOCKERS] == EMPTY:
            continue
        code = relate(prisms, slot, other, overlap, slack)
        codes[other] = code
        if code == CLASH:
            return NONE
        edges += int(code & BOTH != 0) + int(code >> A_SHIFT != 0)
    return edges


@loop_kernel
def link_one(links: Links, slot: int, codes: Indices) -> None:
    """Adds the edges that `relate_to_all` found for a slot; there must be room for them."""
    for other in range(len(codes)):
        if codes[other] != 0:
            link_pair(links, slot, other, codes[other])
