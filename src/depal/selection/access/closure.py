"""Sets that can leave before some boxes, found without search: a lower and an upper bound.

What all ways of a box name must leave in any case: its closure is a lower bound on the removals.
Where every box of it has one way the closure can leave as it is, and the bound is the answer
(Picard 1976: a minimum closure; here every box has the same cost). Otherwise the best ways are
labelled as in Knuth's generalisation of Dijkstra's algorithm (1977), over sets: an upper bound.
"""

import heapq

from depal.selection.access.ways import Mask, Way, Ways, members


def unavoidable(ways: Ways, targets: Mask) -> Mask:
    """What must leave before and with the targets whatever ways are taken.

    Args:
        ways: all boxes can leave in some order.
        targets: boxes that shall leave.

    Returns:
        The closure under what all ways of a box have in common.
    """
    found, open_boxes = targets, targets
    while open_boxes:
        box = (open_boxes & -open_boxes).bit_length() - 1
        common = -1
        for way in ways.of[box]:
            common &= way.blockers
        new = common & ~found
        found |= new
        open_boxes = (open_boxes | new) & ~(1 << box)
    return found


def labelled(ways: Ways) -> dict[int, tuple[Mask, Way]]:
    """For every box that can leave a small set that can leave with it, and its way.

    Returns:
        Per box the set, itself included, and the way by which it leaves last of them.
    """
    users: dict[int, list[tuple[int, Way]]] = {}
    missing: list[int] = []
    heap: list[tuple[int, int, int, Mask, Way]] = []
    for box in members(ways.present):
        for way in ways.of[box]:
            number = len(missing)
            missing.append(way.blockers.bit_count())
            for blocker in members(way.blockers):
                users.setdefault(blocker, []).append((number, way))
            if not way.blockers:
                heap.append((1, number, box, 1 << box, way))
    heapq.heapify(heap)
    done: dict[int, tuple[Mask, Way]] = {}
    while heap:
        _, _, box, found, way = heapq.heappop(heap)
        if box in done:
            continue
        done[box] = found, way
        for number, user in users.get(box, ()):
            missing[number] -= 1
            if missing[number] == 0 and user.box not in done:
                union = 1 << user.box
                for blocker in members(user.blockers):
                    union |= done[blocker][0]
                heapq.heappush(heap, (union.bit_count(), number, user.box, union, user))
    return done
