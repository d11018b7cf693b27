"""Grounding a task again and again: what does not depend on the arguments is worked out once."""

from collections.abc import Sequence

from depal.executive.atoms import filled
from depal.executive.tree import Node


class Stamp:
    """Makes the nodes of one task for any arguments.

    Nodes that stand for the same things share what says so.
    """

    def __init__(self, nodes: Sequence[Node]) -> None:
        """Takes the shape of a tree.

        Args:
            nodes: grounded for stand-ins.
        """
        given: dict[tuple[str, ...], int] = {}
        bound: dict[tuple[tuple[str, str], ...], int] = {}
        self._rows = [
            (
                node,
                given.setdefault(node.args, len(given)),
                bound.setdefault(tuple(node.binding.items()), len(bound)),
                bound.setdefault(tuple(node.edge_binding.items()), len(bound)),
            )
            for node in nodes
        ]
        self._given = [filled(args) for args in given]
        self._bound = [
            (tuple(name for name, _ in items), filled([thing for _, thing in items]))
            for items in bound
        ]

    def nodes(self, args: Sequence[str]) -> list[Node]:
        """The nodes for these arguments, the same as `tree.ground` would make."""
        given = [fill(args) for fill in self._given]
        bound = [dict(zip(names, fill(args), strict=True)) for names, fill in self._bound]
        return [
            Node(
                plain.index,
                plain.parent,
                plain.schema,
                given[own],
                bound[binding],
                plain.edge,
                bound[edge],
                plain.bias,
                plain.depth,
                plain.children,
            )
            for plain, own, binding, edge in self._rows
        ]
