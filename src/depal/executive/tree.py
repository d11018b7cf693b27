"""Allocated trees: grounded schemata, and the states of their nodes by definition.

`sweep` is the meaning of the states. The engine computes the same incrementally; that both
agree after every event is its first law.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from depal.errors import Problem, TaskError, did_you_mean
from depal.executive.conditions import (
    ALWAYS,
    Binding,
    Condition,
    Facts,
    Lasted,
    holds,
    name_of,
)
from depal.executive.schema import Action, Repository, Schema, Task

DEEPEST = 50
"""A tree deeper than this decomposes into itself."""


class NodeState(Enum):
    """The state of a node, section II-B. Accomplished goes before disabled before enabled."""

    ENABLED = "enabled"
    DISABLED = "disabled"
    ACCOMPLISHED = "accomplished"


@dataclass(slots=True, eq=False)
class Node:
    """A grounded schema in a tree; not changed once it is made.

    It is no frozen dataclass because those take three times as long to make, and a tree has a
    dozen of them.

    Attributes:
        index: its place in the tree's `nodes`; parents come before their children.
        parent: the index of its parent, -1 for the root.
        schema: the schema that it grounds.
        args: the things that the schema's parameters stand for, in order.
        binding: the same by parameter.
        edge: the precondition on the edge from its parent; always true for the root.
        edge_binding: what the parent's parameters stand for.
        bias: of the step, a constant part of the emphasis.
        depth: 0 for the root.
        children: their indices.
    """

    index: int
    parent: int
    schema: Schema
    args: tuple[str, ...]
    binding: Binding
    edge: Condition
    edge_binding: Binding
    bias: float
    depth: int
    children: Sequence[int]

    @property
    def concrete(self) -> bool:
        """Whether it is a primitive."""
        return isinstance(self.schema, Action)

    @property
    def label(self) -> str:
        """As it is written: "take(b1)"."""
        return f"{self.schema.name}({', '.join(self.args)})"


@dataclass(frozen=True, slots=True)
class Tree:
    """An allocated task.

    Attributes:
        nodes: the root first, every parent before its children, in the order of the steps.
    """

    nodes: tuple[Node, ...]

    @property
    def root(self) -> Node:
        """The allocated task itself."""
        return self.nodes[0]


@dataclass(frozen=True, slots=True)
class Standing:
    """What a sweep says of one node.

    Attributes:
        pre: the edge's precondition and the schema's own hold.
        within: what must hold as long as anything of it runs does hold.
        post: the postcondition holds.
        live: all preconditions along the branch hold, and all that must hold there throughout.
        gate: live, not accomplished, and the parent's gate is open: it may run.
        kept: its gate would be open if all held that must hold throughout: it keeps what it keeps.
        state: what is shown.
    """

    pre: bool
    within: bool
    post: bool
    live: bool
    gate: bool
    kept: bool
    state: NodeState


def ground(repository: Repository, name: str, args: Sequence[str]) -> Tree:
    """Decomposes a task down to its primitives.

    Args:
        repository: of schemata.
        name: the task to allocate.
        args: the things that its parameters stand for.

    Returns:
        The tree, all its nodes grounded.

    Raises:
        TaskError: an unknown task or subtask, a wrong number of arguments, or a task that
            decomposes into itself without end.
    """
    given = tuple(args)
    root = _schema(repository, name, given)
    draft = _Draft(repository, name)
    draft.add(root, given, -1, ALWAYS, {}, 0.0, 0)
    return Tree(tuple(draft.nodes))


class _Draft:
    """A tree under construction, depth first."""

    def __init__(self, repository: Repository, name: str) -> None:
        self.repository = repository
        self.name = name
        self.nodes: list[Node] = []

    def add(
        self,
        schema: Schema,
        args: tuple[str, ...],
        parent: int,
        edge: Condition,
        edge_binding: Binding,
        bias: float,
        depth: int,
    ) -> int:
        """Adds a schema and everything below it; its index."""
        if depth > DEEPEST:
            what = f"{self.name} decomposes into itself without end"
            raise TaskError("", [Problem(schema.name, what, "a task that ends in actions")])
        index = len(self.nodes)
        binding = {param.name: arg for param, arg in zip(schema.params, args, strict=True)}
        below: list[int] = []
        self.nodes.append(
            Node(index, parent, schema, args, binding, edge, edge_binding, bias, depth, below)
        )
        if isinstance(schema, Task):
            for step in schema.steps:
                given = tuple([name_of(arg, binding) for arg in step.args])
                subtask = _schema(self.repository, step.schema, given)
                below.append(
                    self.add(subtask, given, index, step.when, binding, step.bias, depth + 1)
                )
        return index


def _schema(repository: Repository, name: str, args: tuple[str, ...]) -> Schema:
    schema = repository.schemata.get(name)
    if schema is None:
        exists = did_you_mean(name, repository.schemata)
        raise TaskError("", [Problem("tasks", f"unknown task {name!r}", exists=exists)])
    if len(args) != len(schema.params):
        names = ", ".join(param.name for param in schema.params)
        what = f"{name} takes {len(schema.params)} arguments, {len(args)} given"
        raise TaskError("", [Problem(f"{name}({', '.join(args)})", what, f"{name}({names})")])
    return schema


def sweep(tree: Tree, facts: Facts, lasted: Lasted) -> list[Standing]:
    """The state of every node, from scratch.

    Args:
        tree: what is allocated.
        facts: what is the case.
        lasted: tells of a time condition whether its part has held for long enough.

    Returns:
        One standing a node, in the order of `tree.nodes`.
    """
    standings: list[Standing] = []
    for node in tree.nodes:
        binding = node.binding
        pre = holds(node.edge, facts, node.edge_binding, lasted) and holds(
            node.schema.when, facts, binding, lasted
        )
        within = holds(node.schema.within, facts, binding, lasted)
        post = holds(node.schema.until, facts, binding, lasted)
        parent = standings[node.parent] if node.parent >= 0 else None
        live = pre and within and (parent is None or parent.live)
        gate = live and not post and (parent is None or parent.gate)
        kept = pre and not post and (parent is None or parent.kept)
        state = state_of(live=live, post=post)
        standings.append(Standing(pre, within, post, live, gate, kept, state))
    return standings


def state_of(*, live: bool, post: bool) -> NodeState:
    """Accomplished, then disabled, then enabled."""
    if post:
        return NodeState.ACCOMPLISHED
    return NodeState.ENABLED if live else NodeState.DISABLED
