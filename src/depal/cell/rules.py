"""What the tasks ask of motions with a box: how far it may lean, and which zones nothing enters.

A motion is planned before its action runs, often before its task is allocated. What will bind it
then is read off the trees of its box, or off the store that comes next.
"""

import math
from collections.abc import Collection
from dataclasses import dataclass

from depal.cell.quantities import TILT
from depal.domain import BoxId
from depal.executive.engine import Engine
from depal.executive.limits import Limits, branch_of, branches_ahead, limits_of, zones_of
from depal.executive.tree import Node

TAKING = frozenset({"kr60_reach", "kr60_reach_into", "kr60_grasp"})
SHOWING = frozenset({"kr60_show", "read_barcode"})
LEAVING = frozenset({"kr60_carry", "kr60_release", "kr60_bring", "kr60_put"})
"""The actions that follow one plan."""

STORE = "store"
"""The task that comes next for a box of which none is allocated."""


@dataclass(frozen=True, slots=True)
class Rules:
    """What a motion keeps to.

    Attributes:
        tilt: how far a held box may lean from upright [rad].
        zones: names of the volumes that arm, tool and held box keep out of.
    """

    tilt: float = math.inf
    zones: frozenset[str] = frozenset()

    @classmethod
    def of(cls, limits: Limits, zones: frozenset[str]) -> "Rules":
        """From the limits and zones of an action."""
        return cls(limits.get(TILT, math.inf), zones)

    def cover(self, others: "Rules") -> bool:
        """Whether what keeps to these keeps to the others as well."""
        return self.tilt <= others.tilt and self.zones >= others.zones

    def after(self, reason: str) -> str:
        """Why there is no motion, with what it would have had to keep to."""
        named = (f"zone {name}" for name in sorted(self.zones))
        kept = [f"out of {zone}" for zone in named if zone not in reason]
        if math.isfinite(self.tilt):
            kept.append(f"within {math.degrees(self.tilt):.3g} deg of tilt")
        return f"{reason}, {' and '.join(kept)}" if kept else reason


NO_RULES = Rules()
"""Whatever the planner thinks right."""


def rules_on(engine: Engine | None, box: BoxId, actions: Collection[str]) -> Rules:
    """What binds some actions on a box, now or as soon as they run.

    Args:
        engine: of the cell; None before there is one, when nothing binds.
        box: that they are about.
        actions: their names.
    """
    if engine is None:
        return NO_RULES
    nodes, facts = _nodes_on(engine, box, actions), engine.state.facts
    return Rules.of(limits_of(nodes, facts), zones_of(nodes, facts))


def limits_on_box(engine: Engine | None, box: BoxId, actions: Collection[str]) -> Limits:
    """The tightest limits of some actions on a box; see `rules_on`."""
    if engine is None:
        return {}
    return limits_of(_nodes_on(engine, box, actions), engine.state.facts)


def _nodes_on(engine: Engine, box: BoxId, actions: Collection[str]) -> list[Node]:
    """All nodes on the branches of some actions on a box; none where no task binds anything."""
    schemata = engine.repository.schemata
    if not any(schema.limits or schema.avoids for schema in schemata.values()):
        return []
    branches = [
        tuple(branch_of(node))
        for tree in engine.state.trees.values()
        if tree.withdrawn is None
        for node in tree.nodes
        if node.node.schema.name in actions and box in node.node.args
    ]
    if not branches and STORE in schemata:
        branches += branches_ahead(engine.repository, STORE, (box,), actions)
    return [node for branch in branches for node in branch]
