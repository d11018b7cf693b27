"""The nodes that may run and do not, best first, by the resources that they claim."""

import heapq

from depal.executive.nodes import LiveNode

Claim = tuple[str, ...]


class Waiting:
    """Queues by claim; an entry that is no longer true is dropped when it comes up.

    Nodes with the same claim are blocked by the same things, so only the first of each queue
    has to be looked at, however many wait.
    """

    def __init__(self) -> None:
        """Nobody waits."""
        self._queues: dict[Claim, list[tuple[float, tuple[int, int], int, LiveNode]]] = {}
        self._by_tree: dict[int, dict[int, LiveNode]] = {}
        self._tickets = 0

    def put(self, node: LiveNode, rank: float) -> None:
        """A node waits, with its rank; what it had before is stale."""
        self._tickets += 1
        node.ticket = self._tickets
        tree, index = node.place
        self._by_tree.setdefault(tree, {})[index] = node
        entry = (-rank, node.place, node.ticket, node)
        heapq.heappush(self._queues.setdefault(node.action.uses, []), entry)

    def drop(self, node: LiveNode) -> None:
        """A node no longer waits."""
        if node.ticket < 0:
            return
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

    def of_tree(self, tree: int) -> list[LiveNode]:
        """All of a tree that wait."""
        return list(self._by_tree.get(tree, {}).values())
