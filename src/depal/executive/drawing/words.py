"""What every drawing of a tree says: labels, preconditions, states."""

from collections.abc import Sequence
from dataclasses import dataclass

from depal.executive.conditions import AllOf, Always, Condition
from depal.executive.exploring.grounding import grounded
from depal.executive.language import format_condition
from depal.executive.language.condition_text import GLUE, limit_text, zone_text
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
        within: what must hold as long as anything of it runs, empty where there is none.
        limit: what nothing below may exceed, empty where there is none.
        avoids: the zones that nothing below may enter, empty where there is none.
        met: whether the precondition holds; None without states.
        inside: whether `within` holds; None without states.
        state: its state; None without states.
        ready: whether it may run: concrete, with an open gate.
        word: the state in words, empty without states.
    """

    node: Node
    label: str
    when: str
    within: str
    limit: str
    avoids: str
    met: bool | None
    inside: bool | None
    state: NodeState | None
    ready: bool
    word: str

    @property
    def notes(self) -> tuple[str, ...]:
        """What stands on its edge: conditions, marked where it is known whether they hold."""
        parts = (
            (self.met, self.when, ""),
            (self.inside, self.within, "within "),
            (None, self.limit, "limit "),
            (None, self.avoids, "avoids "),
        )
        return tuple(f"{_mark(holds)}{word}{text}" for holds, text, word in parts if text)

    @property
    def lacking(self) -> bool:
        """Whether one of its own conditions disables it."""
        return self.state is NodeState.DISABLED and False in {self.met, self.inside}


def _mark(holds: bool | None) -> str:  # noqa: FBT001 - what is known of a condition
    return "" if holds is None else "✓ " if holds else "✗ "


def drawn(tree: Tree, standings: Standings) -> list[Drawn]:
    """Every node with its words, in the order of the tree."""
    known: Sequence[Standing | None] = standings or [None] * len(tree.nodes)
    return [_drawn(node, standing) for node, standing in zip(tree.nodes, known, strict=True)]


def _drawn(node: Node, standing: Standing | None) -> Drawn:
    schema = node.schema
    within = grounded(schema.within, node.binding)
    return Drawn(
        node=node,
        label=node.label,
        when=precondition(node),
        within="" if isinstance(within, Always) else format_condition(within),
        limit=", ".join(limit_text(limit).replace(GLUE, " ") for limit in schema.limits),
        avoids=", ".join(map(zone_text, schema.avoids)),
        met=None if standing is None else standing.pre,
        inside=None if standing is None else standing.within,
        state=None if standing is None else standing.state,
        ready=standing is not None and standing.gate and node.concrete,
        word="" if standing is None else _word(node, standing),
    )


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
