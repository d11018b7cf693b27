"""What bounds an action: the tightest limit of its own and of every task above it."""

from collections.abc import Collection, Iterable, Iterator, Mapping

from depal.executive.conditions import Binding, FactRef, Facts, key_of
from depal.executive.nodes import LiveNode
from depal.executive.schema import Limit, Repository
from depal.executive.tree import Node, ground
from depal.executive.units import UNITS

Limits = Mapping[str, float]
"""The tightest bound of each limited quantity [base units]; what is missing is not limited."""


def limits_on(node: LiveNode, facts: Facts) -> dict[str, float]:
    """What a node must not exceed now.

    Args:
        node: in an allocated tree.
        facts: what is the case; a limit that is a fact bounds nothing while the fact is empty.

    Returns:
        The tightest of all limits on its branch, quantity by quantity [base units].
    """
    return limits_of(branch_of(node), facts)


def avoided_on(node: LiveNode, facts: Facts) -> frozenset[str]:
    """The zones that a node must not enter now: those of its whole branch."""
    return zones_of(branch_of(node), facts)


def branch_of(node: LiveNode) -> Iterator[Node]:
    """A node of an allocated tree and all above it, as they are grounded."""
    here: LiveNode | None = node
    while here is not None:
        yield here.node
        here = here.parent


def branches_ahead(
    repository: Repository, task: str, args: Iterable[str], actions: Collection[str]
) -> Iterator[tuple[Node, ...]]:
    """The branches of some actions in a task that is not allocated yet.

    Args:
        repository: of schemata.
        task: its name.
        args: the things that its parameters stand for.
        actions: the names of the actions that are asked for.

    Yields:
        Each of them that the task comes down to, with all above it.
    """
    nodes = ground(repository, task, tuple(args)).nodes
    for node in nodes:
        if node.schema.name not in actions:
            continue
        branch, index = [node], node.parent
        while index >= 0:
            branch.append(nodes[index])
            index = nodes[index].parent
        yield tuple(branch)


def limits_of(nodes: Iterable[Node], facts: Facts) -> dict[str, float]:
    """The tightest of all limits of some nodes: the least, of lower bounds the greatest."""
    found: dict[str, float] = {}
    for node in nodes:
        for limit in node.schema.limits:
            bound = bound_of(limit, facts, node.binding)
            if bound is not None:
                tightest = max if limit.at_least else min
                found[limit.quantity] = tightest(bound, found.get(limit.quantity, bound))
    return found


def zones_of(nodes: Iterable[Node], facts: Facts) -> frozenset[str]:
    """The zones that some nodes avoid; a fact that is empty names none."""
    found: set[str] = set()
    for node in nodes:
        for zone in node.schema.avoids:
            name = facts.get(key_of(zone, node.binding)) if isinstance(zone, FactRef) else zone
            if isinstance(name, str):
                found.add(name)
    return frozenset(found)


def bound_of(limit: Limit, facts: Facts, binding: Binding) -> float | None:
    """What one limit allows now [base units]; None for as much as you like."""
    if not isinstance(limit.bound, FactRef):
        return limit.bound * UNITS[limit.unit].factor
    value = facts.get(key_of(limit.bound, binding))
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    return float(value)
