"""Branches whose conditions contradict one another."""

from collections.abc import Iterator, Sequence

from depal.executive.checking.findings import FindingKind
from depal.executive.checking.places import Place, Verdict
from depal.executive.checking.solver import satisfiable
from depal.executive.conditions import Always, Condition, Not
from depal.executive.exploring.model import Model
from depal.executive.language import format_condition


def contradictions(model: Model) -> Iterator[Verdict]:
    """The topmost nodes of a tree that no state of the world lets run.

    A node may run when the preconditions on its branch hold and neither it nor any node above
    is accomplished.

    Args:
        model: of the tree.
    """
    dead: set[int] = set()
    for node in model.tree.nodes:
        place = Place.of(model.tree, node)
        if node.parent in dead:
            dead.add(node.index)
            yield Verdict(place, FindingKind.NEVER_ENABLED, "")
            continue
        demands = demands_on(model, node.index)
        if satisfiable(demands, model.domains) is False:
            dead.add(node.index)
            core = [f"'{format_condition(one)}'" for one in _core(model, demands)]
            never = f"{', '.join(core[:-1])} and {core[-1]} never hold at once"
            what = never if len(core) > 1 else f"{core[0]} never holds"
            yield Verdict(place, FindingKind.NEVER_ENABLED, f"can never be enabled: {what}")
        else:
            yield Verdict(place, FindingKind.NEVER_ENABLED, None)


def demands_on(model: Model, index: int) -> list[Condition]:
    """All that has to hold for a node to run, from the root down."""
    demands: list[Condition] = []
    while index >= 0:
        conditions = model.conditions[index]
        until = conditions.until.condition
        ended = until.part if isinstance(until, Not) else Not(until)
        demands += [ended, conditions.within.condition]
        demands += [conditions.when.condition, conditions.edge.condition]
        index = model.tree.nodes[index].parent
    return [one for one in reversed(demands) if not isinstance(one, Always)]


def _core(model: Model, demands: Sequence[Condition]) -> list[Condition]:
    """As few of the demands as contradict one another; leaving one out more would not."""
    core = list(dict.fromkeys(demands))
    for demand in list(core):
        rest = [one for one in core if one is not demand]
        if rest and satisfiable(rest, model.domains) is False:
            core = rest
    return core
