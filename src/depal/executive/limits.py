"""What bounds an action: the tightest limit of its own and of every task above it."""

from collections.abc import Mapping

from depal.executive.conditions import Binding, FactRef, Facts, key_of
from depal.executive.nodes import LiveNode
from depal.executive.schema import Limit
from depal.executive.units import UNITS

Limits = Mapping[str, float]
"""The greatest value of each limited quantity [SI]; what is missing is not limited."""


def limits_on(node: LiveNode, facts: Facts) -> dict[str, float]:
    """What a node must not exceed now.

    Args:
        node: in an allocated tree.
        facts: what is the case; a limit that is a fact bounds nothing while the fact is empty.

    Returns:
        The least of all limits on its branch, quantity by quantity [SI].
    """
    found: dict[str, float] = {}
    here: LiveNode | None = node
    while here is not None:
        for limit in here.node.schema.limits:
            most = bound_of(limit, facts, here.node.binding)
            if most is not None:
                found[limit.quantity] = min(most, found.get(limit.quantity, most))
        here = here.parent
    return found


def bound_of(limit: Limit, facts: Facts, binding: Binding) -> float | None:
    """How much one limit allows now [SI]; None for as much as you like."""
    if not isinstance(limit.most, FactRef):
        return limit.most * UNITS[limit.unit].factor
    value = facts.get(key_of(limit.most, binding))
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    return float(value)
