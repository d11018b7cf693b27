"""Nodes of several trees that stand for the same step of a task file."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from depal.executive.checking.findings import Finding, FindingKind, head_of, place_of
from depal.executive.schema import Repository, Task
from depal.executive.tree import Node, Tree


@dataclass(frozen=True, slots=True)
class Place:
    """A step of a task, or a root.

    Attributes:
        schema: the task's name, or the root's.
        step: counted from one; 0 for a root.
    """

    schema: str
    step: int

    @classmethod
    def of(cls, tree: Tree, node: Node) -> "Place":
        """The place that a node stands for."""
        if node.parent < 0:
            return cls(node.schema.name, 0)
        above = tree.nodes[node.parent]
        return cls(above.schema.name, above.children.index(node.index) + 1)

    def shown(self, repository: Repository) -> str:
        """As it is written."""
        schema = repository.schemata[self.schema]
        if self.step and isinstance(schema, Task):
            return place_of(schema, self.step)
        return head_of(schema)


@dataclass(frozen=True, slots=True)
class Verdict:
    """What one tree says of one place.

    Attributes:
        place: the step.
        kind: of finding that it would be.
        what: is wrong; empty where that follows from the node above, None where nothing is.
    """

    place: Place
    kind: FindingKind
    what: str | None


def agreed(repository: Repository, verdicts: Iterable[Verdict]) -> Iterator[Finding]:
    """Findings about places with which something is wrong wherever they occur."""
    found: dict[tuple[Place, FindingKind], list[str | None]] = {}
    for verdict in verdicts:
        found.setdefault((verdict.place, verdict.kind), []).append(verdict.what)
    for (place, kind), sayings in found.items():
        said = next((what for what in sayings if what), None)
        if said is not None and None not in sayings:
            yield Finding(kind, place.shown(repository), said)
