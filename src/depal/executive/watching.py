"""From a change of facts to the conditions that it can have changed, and nothing else."""

from collections.abc import Iterable

from depal.executive.compiled import Span, Watch
from depal.executive.nodes import LiveNode

Token = tuple[int, int, int]
"""Tree, node and side of a watched condition; side 2 is a time condition."""

PRE, POST, SPAN = 0, 1, 2


class Watchers:
    """An index from facts to the conditions that wait for them."""

    def __init__(self) -> None:
        """Nobody waits."""
        self._nodes: dict[Watch, dict[Token, LiveNode]] = {}
        self._spans: dict[Watch, dict[str, Span]] = {}

    def watch(self, node: LiveNode) -> None:
        """A node's conditions are to be told of changes."""
        tree, index = node.place
        for side, watches in enumerate(node.watches):
            token = (tree, index, side)
            for watch in watches:
                self._nodes.setdefault(watch, {})[token] = node

    def unwatch(self, node: LiveNode) -> None:
        """A node's conditions are not to be told any more."""
        tree, index = node.place
        for side, watches in enumerate(node.watches):
            for watch in watches:
                waiting = self._nodes.get(watch, {})
                waiting.pop((tree, index, side), None)
                if not waiting:
                    self._nodes.pop(watch, None)

    def watch_span(self, span: Span) -> None:
        """A time condition is to be told of changes of its part."""
        for watch in span.watches:
            self._spans.setdefault(watch, {})[span.key] = span

    def unwatch_span(self, span: Span) -> None:
        """A time condition is no longer there."""
        for watch in span.watches:
            waiting = self._spans.get(watch, {})
            waiting.pop(span.key, None)
            if not waiting:
                self._spans.pop(watch, None)

    def spans(self, watches: Iterable[Watch]) -> list[Span]:
        """The time conditions that changes concern, in the order of their keys."""
        found = {key: span for watch in watches for key, span in self._spans.get(watch, {}).items()}
        return [found[key] for key in sorted(found)]

    def nodes(self, watches: Iterable[Watch]) -> list[tuple[Token, LiveNode]]:
        """The nodes' conditions that changes concern, in the order of trees and nodes."""
        found: dict[Token, LiveNode] = {}
        for watch in watches:
            found.update(self._nodes.get(watch, ()))
        return [(token, found[token]) for token in sorted(found)]
