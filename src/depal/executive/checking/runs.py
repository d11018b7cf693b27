"""What the runs of a task show: nodes that none reaches, and primitives that contend."""

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from depal.executive.checking.branches import demands_on
from depal.executive.checking.findings import Finding, FindingKind, head_of
from depal.executive.checking.places import Place, Verdict
from depal.executive.checking.solver import satisfiable
from depal.executive.conditions import FactRef, Holds, Literal
from depal.executive.exploring.model import Facts, Model, changed
from depal.executive.tree import Node

LIMIT = 1_500
"""Of a task with more sets of facts than this, nothing is said here; `explore` walks it."""

NAMED = 3
"""How many steps that depend on a change are named."""


@dataclass(frozen=True, slots=True)
class Reach:
    """What the runs of one tree come by.

    Attributes:
        complete: whether all of them were walked.
        gates: the nodes whose gates are open at some time.
    """

    complete: bool
    gates: frozenset[int]


def reach(model: Model, limit: int = LIMIT) -> Reach:
    """Walks the facts alone: every open primitive may succeed, the world may do what it likes."""
    seen = dict.fromkeys(model.starts())
    frontier = deque(seen)
    gates: set[int] = set()
    raised = _raised_by_the_world(model)
    while frontier and len(seen) < limit:
        facts = frontier.popleft()
        view = model.view(facts)
        gates |= {index for index, one in enumerate(view.standings) if one.gate}
        following = [*_following(model, facts, view.open)]
        following += [changed(facts, {place: True}) for place in raised]
        for after in following:
            if after not in seen:
                seen[after] = None
                frontier.append(after)
    return Reach(not frontier, frozenset(gates))


def _raised_by_the_world(model: Model) -> list[int]:
    """Flags that primitives of the tree only ever lower: somebody else must raise them."""
    lowered = []
    for place in sorted({place for one in model.primitives for place in one.sets}):
        key = model.keys[place]
        raising = (
            satisfiable(
                [model.conditions[one.node.index].until.condition, _flag(key)], model.domains
            )
            for one in model.primitives
            if place in one.sets
        )
        if model.domains[key] == (False, True) and not any(raising):
            lowered.append(place)
    return lowered


def _flag(key: str) -> Holds:
    subject, attribute = key.split(".", 1)
    return Holds(FactRef(Literal(subject), attribute))


def _following(model: Model, facts: Facts, ready: frozenset[int]) -> Iterator[Facts]:
    for place in sorted(ready):
        yield from model.effects(place, facts)
    for place in model.world:
        for value in model.settable(place, facts):
            yield model.settled(changed(facts, {place: value}))
    for _, after in model.time_passes(facts):
        yield after


def unreached(model: Model, reached: Reach) -> Iterator[Verdict]:
    """The topmost nodes whose gates never open in any run, though their conditions agree."""
    if not reached.complete:
        return
    for node in model.tree.nodes:
        place = Place.of(model.tree, node)
        if node.index in reached.gates:
            yield Verdict(place, FindingKind.UNREACHABLE, None)
        elif node.parent >= 0 and node.parent not in reached.gates:
            yield Verdict(place, FindingKind.UNREACHABLE, "")
        elif satisfiable(demands_on(model, node.index), model.domains):
            what = "no run reaches it: nothing sets the facts that it needs"
            yield Verdict(place, FindingKind.UNREACHABLE, what)


def contentions(model: Model) -> Iterator[Finding]:
    """Pairs that some facts let run at once and that want the same unit, with who gets it."""
    where = head_of(model.tree.root.schema)
    for first, second in combinations(model.primitives, 2):
        scarce = [
            name
            for name in first.action.uses
            if name in second.action.uses
            and name in model.resources
            and model.resources[name].capacity == 1
        ]
        demands = [*demands_on(model, first.node.index), *demands_on(model, second.node.index)]
        if scarce and satisfiable(demands, model.domains):
            winner, why = _winner(model.tree.nodes, first.node, second.node)
            pair = f"{first.node.label} and {second.node.label}"
            what = f"{pair} contend for {', '.join(scarce)}: {winner.label} wins, {why}"
            yield Finding(FindingKind.CONTENTION, where, what)


def _winner(nodes: Sequence[Node], first: Node, second: Node) -> tuple[Node, str]:
    """The greater bias below the task that both are part of, else the earlier step."""
    above, beside = _branch(nodes, first), _branch(nodes, second)
    shared = set(above) & set(beside)
    biases = [
        sum(nodes[index].bias for index in branch if index not in shared)
        for branch in (above, beside)
    ]
    if biases[0] == biases[1]:
        return first, "the earlier step"
    return (first if biases[0] > biases[1] else second), "the greater bias"


def _branch(nodes: Sequence[Node], node: Node) -> list[int]:
    branch = [node.index]
    while nodes[branch[-1]].parent >= 0:
        branch.append(nodes[branch[-1]].parent)
    return branch


def shared_changes(model: Model) -> Iterator[Finding]:
    """Actions that change several facts on which different branches depend."""
    for primitive in model.primitives:
        readers: dict[str, set[int]] = {}
        for place in primitive.sets:
            key = model.keys[place]
            readers[key] = {
                node.index
                for node, conditions in zip(model.tree.nodes, model.conditions, strict=True)
                if any(key in one.facts for one in conditions if one is not conditions.until)
            }
        read = [key for key, nodes in readers.items() if nodes]
        nodes = sorted(set().union(*readers.values()))
        if len(readers) > 1 and read and len(nodes) > 1:
            labels = [model.tree.nodes[index].label for index in nodes]
            more = f" and {len(labels) - NAMED} more" if len(labels) > NAMED else ""
            facts = ", ".join(readers)
            who = f"{', '.join(labels[:NAMED])}{more}"
            what = f"changes {facts}, which {who} depend on: they must arrive as one change"
            yield Finding(FindingKind.SHARED_CHANGE, head_of(primitive.action), what)
