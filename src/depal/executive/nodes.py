"""Allocated trees as the engine keeps them: what is true, what may run, what has failed."""

from dataclasses import dataclass, field

from depal.executive.atoms import Subject
from depal.executive.plan import SHUT, Gates, Plan
from depal.executive.schema import Action
from depal.executive.tree import Node


@dataclass(slots=True, eq=False)
class LiveNode:
    """A node and its moving parts.

    Attributes:
        node: what it grounds.
        action: its schema where it is concrete; asked of concrete nodes only.
        tree: whose it is.
        place: its tree's number and its index in it: a total order of all nodes.
        parent: the node above, None for the root.
        attempt: the attempt that runs, or None.
        failures: how often its primitive has failed in a row.
        retry_at: not before then is it tried again [s].
        faulted: whether it has used up its retries.
        waiting_since: since when it could run and does not [s].
        rank: what orders it among those that wait, the greatest first.
        ticket: which entry of a queue stands for it; others are stale.
    """

    node: Node
    action: Action
    tree: "LiveTree"
    place: tuple[int, int]
    parent: "LiveNode | None"
    attempt: int | None = None
    failures: int = 0
    retry_at: float = 0.0
    faulted: bool = False
    waiting_since: float = 0.0
    rank: float = 0.0
    ticket: int = -1

    @property
    def gate(self) -> bool:
        """Whether it may run."""
        return self.tree.gates.open >> self.place[1] & 1 == 1

    @property
    def kept(self) -> bool:
        """Whether it could run if all held that must hold throughout."""
        return self.tree.gates.kept >> self.place[1] & 1 == 1

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
        plan: of its task.
        subject: what it is about.
        nodes: the root first; none once it has ended.
        priority: of the request that it serves; the root's own contribution to emphasis.
        digest: of the task file that it came from.
        withdrawn: why it is no longer wanted, None while it is.
        running: its attempts that run.
        true: its atoms that are true, of those that are watched.
        watched: its atoms that are told of changes; none when it is shut.
        gates: what that means for its nodes.
    """

    number: int
    plan: Plan
    subject: Subject
    nodes: list[LiveNode]
    priority: float
    digest: str
    withdrawn: str | None = None
    running: dict[int, LiveNode] = field(default_factory=dict)
    true: int = 0
    watched: int = 0
    gates: Gates = SHUT

    @property
    def root(self) -> LiveNode:
        """The allocated task itself."""
        return self.nodes[0]

    @property
    def ended(self) -> bool:
        """Whether it is to be archived: accomplished or withdrawn, and nothing of it runs."""
        if self.running:
            return False
        return self.withdrawn is not None or self.gates.accomplished & 1 == 1


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
