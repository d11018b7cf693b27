"""What every drawing of a tree says: labels, preconditions, states."""

from collections.abc import Sequence
from dataclasses import dataclass

from depal.executive.conditions import AllOf, Always, Condition
from depal.executive.exploring.grounding import grounded
from depal.executive.language import format_condition
from depal.executive.tree import Node, NodeState, Standing, Tree

Standings = Sequence[Standing] | None
"""One standing a node, in the order of the tree; None draws the tree without states."""


@dataclass(frozen=True, slots=True)
class Drawn:
    """A node as it is drawn.

    Attributes:
        node: in the tree.
        label: its schema and the things that it is about.
        when: its precondition, empty where there is none.
        met: whether the precondition holds; None without states.
        state: its state; None without states.
        ready: whether it may run: concrete, with an open gate.
        word: the state in words, empty without states.
    """

    node: Node
    label: str
    when: str
    met: bool | None
    state: NodeState | None
    ready: bool
    word: str


def drawn(tree: Tree, standings: Standings) -> list[Drawn]:
    """Every node with its words, in the order of the tree."""
    if standings is None:
        return [Drawn(n, n.label, precondition(n), None, None, False, "") for n in tree.nodes]  # noqa: FBT003 - a field in place
    return [
        Drawn(
            node=node,
            label=node.label,
            when=precondition(node),
            met=standing.pre,
            state=standing.state,
            ready=standing.gate and node.concrete,
            word=_word(node, standing),
        )
        for node, standing in zip(tree.nodes, standings, strict=True)
    ]


def precondition(node: Node) -> str:
    """The condition on a node's edge and its schema's own, in one line; empty where always."""
    parts: list[Condition] = []
    for condition in (
        grounded(node.edge, node.edge_binding),
        grounded(node.schema.when, node.binding),
    ):
        if isinstance(condition, AllOf):
            parts += condition.parts
        elif not isinstance(condition, Always):
            parts.append(condition)
    if not parts:
        return ""
    return format_condition(parts[0] if len(parts) == 1 else AllOf(tuple(parts)))


def postcondition(node: Node) -> str:
    """What a node is for, in one line."""
    return format_condition(grounded(node.schema.until, node.binding))


def _word(node: Node, standing: Standing) -> str:
    """The state; of an enabled node also whether anything comes of it."""
    if standing.state is not NodeState.ENABLED:
        return str(standing.state.value)
    if not standing.gate:
        return "enabled, at rest"
    return "enabled, may run" if node.concrete else "enabled"
