"""Primitives that have used up their retries, and the facts that say so."""

from depal.executive.conditions import Key
from depal.executive.nodes import LiveNode, LiveTree

FAULT, ATTEMPTS = "fault", "attempts"
"""Facts that the engine itself writes, where they are declared."""


def own_key(node: LiveNode, attribute: str) -> Key:
    """Such a fact is about the node's first argument, else about its action."""
    return f"{node.node.args[0] if node.node.args else node.action.name}.{attribute}"


class Faults:
    """Nodes that are not tried again until their fault is cleared, by the fact."""

    def __init__(self) -> None:
        """There is none."""
        self._nodes: dict[Key, dict[tuple[int, int], LiveNode]] = {}

    def __len__(self) -> int:
        """How many facts stand for faults."""
        return len(self._nodes)

    def add(self, node: LiveNode) -> None:
        """A node has used up its retries."""
        node.faulted = True
        self._nodes.setdefault(own_key(node, FAULT), {})[node.place] = node

    def cleared(self, key: Key) -> list[LiveNode]:
        """Takes out the nodes for which a fact stands."""
        return list(self._nodes.pop(key, {}).values())

    def forget(self, tree: LiveTree) -> None:
        """A tree has ended."""
        for node in tree.nodes:
            if node.faulted:
                key = own_key(node, FAULT)
                others = self._nodes.get(key, {})
                others.pop(node.place, None)
                if not others:
                    self._nodes.pop(key, None)
