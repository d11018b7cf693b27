"""Allocated trees as the engine keeps them: what is awake, what may run, what has failed."""

from dataclasses import dataclass, field

from depal.executive.compiled import Test, Watch, always
from depal.executive.conditions import Lasting
from depal.executive.schema import Action
from depal.executive.tree import Node

SpanName = tuple[Lasting, frozenset[tuple[str, str]]]
"""A time condition and the things that it is about."""


Token = tuple[int, int, int]
"""Tree, node and side of a watched condition."""


@dataclass(slots=True, eq=False)
class LiveNode:
    """A node and its moving parts.

    A node is awake while its parent's gate is open. Only then are its conditions watched; below
    a closed gate nothing can run, and what is shown there is swept when somebody looks.

    Attributes:
        node: what it grounds.
        action: its schema where it is concrete; asked of concrete nodes only.
        tree: whose it is.
        place: its tree's number and its index in it: a total order of all nodes.
        parent: the node above, None for the root.
        children: the nodes below.
        pre: the preconditions of its edge and of its schema.
        post: its postcondition.
        entries: what `pre` and `post` wait for; None until it first wakes.
        awake: whether it is watched.
        holds_pre: the value of `pre`, while awake.
        holds_post: the value of `post`, while awake.
        gate: whether it may run.
        attempt: the attempt that runs, or None.
        failures: how often its primitive has failed in a row.
        retry_at: not before then is it tried again [s].
        faulted: whether it has used up its retries.
        waiting_since: since when it could run and does not [s].
        ticket: which entry of a queue stands for it; others are stale.
    """

    node: Node
    action: Action
    tree: "LiveTree"
    place: tuple[int, int]
    parent: "LiveNode | None"
    children: list["LiveNode"] = field(default_factory=list)
    pre: Test = always
    post: Test = always
    entries: tuple[tuple[Watch, Token], ...] | None = None
    awake: bool = False
    holds_pre: bool = False
    holds_post: bool = False
    gate: bool = False
    attempt: int | None = None
    failures: int = 0
    retry_at: float = 0.0
    faulted: bool = False
    waiting_since: float = 0.0
    ticket: int = -1

    def is_within(self, ancestor: "LiveNode") -> bool:
        """Whether it is that node or stands below it."""
        here: LiveNode | None = self
        while here is not None:
            if here is ancestor:
                return True
            here = here.parent
        return False


@dataclass(slots=True, eq=False)
class LiveTree:
    """An allocated task.

    Attributes:
        number: in the order of allocation.
        nodes: the root first.
        priority: of the request that it serves; the root's own contribution to emphasis.
        digest: of the task file that it came from.
        withdrawn: why it is no longer wanted, None while it is.
        running: its attempts that run.
        spans: the time conditions that it mentions.
    """

    number: int
    nodes: list[LiveNode]
    priority: float
    digest: str
    withdrawn: str | None = None
    running: dict[int, LiveNode] = field(default_factory=dict)
    spans: list[SpanName] = field(default_factory=list)

    @property
    def root(self) -> LiveNode:
        """The allocated task itself."""
        return self.nodes[0]


@dataclass(slots=True, eq=False)
class Attempt:
    """One run of a primitive.

    Attributes:
        number: of the attempt; messages repeat under it.
        node: whose primitive.
        started: when [s].
        deadline: when it is broken off [s], None for never.
        cancel: why it is to stop, None while it is not.
        in_doubt: whether the controller has restarted since.
    """

    number: int
    node: LiveNode
    started: float
    deadline: float | None
    cancel: str | None = None
    in_doubt: bool = False
