"""From a change of facts to the conditions that it can have changed, and nothing else."""

from collections.abc import Iterable

from depal.executive.compiled import Watch
from depal.executive.nodes import LiveNode, Token

PRE, POST = 0, 1


class Watchers:
    """An index from facts to the conditions that wait for them."""

    def __init__(self) -> None:
        """Nobody waits."""
        self._nodes: dict[Watch, dict[Token, LiveNode]] = {}

    def watch(self, node: LiveNode) -> None:
        """A node's conditions are to be told of changes."""
        index = self._nodes
        for watch, token in node.entries or ():
            waiting = index.get(watch)
            if waiting is None:
                index[watch] = {token: node}
            else:
                waiting[token] = node

    def unwatch(self, node: LiveNode) -> None:
        """A node's conditions are not to be told any more."""
        index = self._nodes
        for watch, token in node.entries or ():
            waiting = index.get(watch)
            if waiting is not None:
                waiting.pop(token, None)
                if not waiting:
                    del index[watch]

    def nodes(self, watches: Iterable[Watch]) -> list[tuple[Token, LiveNode]]:
        """The nodes' conditions that changes concern, in the order of trees and nodes."""
        found: dict[Token, LiveNode] = {}
        get = self._nodes.get
        for watch in watches:
            waiting = get(watch)
            if waiting:
                found.update(waiting)
        return sorted(found.items(), key=_token)


def _token(entry: tuple[Token, LiveNode]) -> Token:
    return entry[0]
