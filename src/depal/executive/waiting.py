"""The nodes that may run and do not, best first, by the resources that they claim."""

import heapq
from collections.abc import Sequence

from depal.executive.nodes import LiveNode

Claim = tuple[str, ...]


ROOM = 64
"""So many entries a queue may have before its stale ones are swept out."""


class Waiting:
    """Queues by claim; an entry that is no longer true is dropped when it comes up.

    Nodes with the same claim are blocked by the same things, so only the first of each queue
    has to be looked at, however many wait.
    """

    def __init__(self) -> None:
        """Nobody waits; `version` is another number whenever that has changed."""
        self._queues: dict[Claim, list[tuple[float, tuple[int, int], int, LiveNode]]] = {}
        self._by_tree: dict[int, dict[int, LiveNode]] = {}
        self._tickets = 0
        self._roomy: dict[Claim, int] = {}
        self.version = 0

    def put(self, node: LiveNode, rank: float) -> None:
        """A node waits, with its rank; what it had before is stale."""
        self.version += 1
        self._tickets += 1
        node.ticket, node.rank = self._tickets, rank
        tree, index = node.place
        self._by_tree.setdefault(tree, {})[index] = node
        claim = node.action.uses
        queue = self._queues.setdefault(claim, [])
        heapq.heappush(queue, (-rank, node.place, node.ticket, node))
        if len(queue) > self._roomy.get(claim, ROOM):
            # Stale entries would keep the nodes of ended trees alive.
            queue[:] = [entry for entry in queue if entry[2] == entry[3].ticket]
            heapq.heapify(queue)
            self._roomy[claim] = max(ROOM, 2 * len(queue))

    def drop(self, node: LiveNode) -> None:
        """A node no longer waits."""
        if node.ticket < 0:
            return
        self.version += 1
        node.ticket = -1
        tree, index = node.place
        waiting = self._by_tree[tree]
        del waiting[index]
        if not waiting:
            del self._by_tree[tree]

    def waits(self, node: LiveNode) -> bool:
        """Whether a node waits."""
        return node.ticket >= 0

    def __bool__(self) -> bool:
        """Whether anybody waits."""
        return bool(self._by_tree)

    def firsts(self, closed: set[str]) -> list[tuple[float, tuple[int, int], LiveNode]]:
        """The best of every claim without a closed resource: minus its rank, its place, itself."""
        found = []
        for claim, queue in self._queues.items():
            if not closed.isdisjoint(claim):
                continue
            while queue and queue[0][2] != queue[0][3].ticket:
                heapq.heappop(queue)
            if queue:
                found.append((queue[0][0], queue[0][1], queue[0][3]))
        return found

    def of_tree(self, tree: int) -> Sequence[LiveNode]:
        """All of a tree that wait."""
        waiting = self._by_tree.get(tree)
        return list(waiting.values()) if waiting else ()
