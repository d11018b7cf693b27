"""Checks a repository without running anything."""

from collections.abc import Collection, Iterator, Mapping

from depal.executive.checking.bounds import check_bounds, check_quantities, check_zones
from depal.executive.checking.branches import contradictions
from depal.executive.checking.calls import Calls
from depal.executive.checking.effects import check_effect
from depal.executive.checking.findings import Finding, FindingKind, head_of
from depal.executive.checking.names import check_names
from depal.executive.checking.places import Verdict, agreed
from depal.executive.checking.runs import contentions, reach, shared_changes, unreached
from depal.executive.checking.values import check_conditions
from depal.executive.exploring.grounding import example_arguments
from depal.executive.exploring.model import Model
from depal.executive.schema import Action, Repository
from depal.executive.tree import ground
from depal.executive.units import Quantity


def check(
    repository: Repository,
    primitives: Collection[str] | None = None,
    quantities: Mapping[str, Quantity] | None = None,
    zones: Collection[str] | None = None,
) -> list[Finding]:
    """Everything that is wrong with a repository, and what is worth knowing about it.

    Args:
        repository: any that could be read.
        primitives: the names that are bound to code; None where that is not known yet.
        quantities: whose limits primitives keep, by name; None where that is not known yet.
        zones: the names of the cell's zones; None where that is not known yet.

    Returns:
        Mistakes in the order of the schemata, then remarks; each only once.
    """
    calls = Calls(repository)
    found = [*check_names(repository, primitives), *check_conditions(repository)]
    found += check_bounds(repository)
    found += check_quantities(repository, quantities) if quantities is not None else []
    found += check_zones(repository, zones) if zones is not None else []
    found += calls.findings()
    broken = _broken(repository, found) | {name for circle in calls.endless for name in circle}
    for schema in repository.schemata.values():
        if isinstance(schema, Action) and schema.name not in broken:
            found += check_effect(repository, schema)
    found += _check_trees(repository, calls, broken)
    order = {head_of(schema): place for place, schema in enumerate(repository.schemata.values())}
    unique = dict.fromkeys(found)
    return sorted(unique, key=lambda one: (not one.serious, _place(order, one)))


def _place(order: dict[str, int], finding: Finding) -> int:
    return next((n for head, n in order.items() if finding.where.startswith(head)), len(order))


def _broken(repository: Repository, found: Collection[Finding]) -> set[str]:
    wheres = [one.where for one in found if one.breaking]
    return {
        schema.name
        for schema in repository.schemata.values()
        if any(where.startswith(head_of(schema)) for where in wheres)
    }


def _check_trees(repository: Repository, calls: Calls, broken: set[str]) -> Iterator[Finding]:
    """What only whole trees show, of every task that nobody calls."""
    verdicts: list[Verdict] = []
    told: set[tuple[FindingKind, str]] = set()
    for root in calls.roots:
        if calls.below(root) & broken:
            continue
        schema = repository.schemata[root]
        model = Model(repository, ground(repository, root, example_arguments(schema)))
        reached = reach(model)
        verdicts += contradictions(model)
        verdicts += unreached(model, reached)
        for remark in (*contentions(model), *shared_changes(model)):
            about = remark.where if remark.kind is FindingKind.SHARED_CHANGE else remark.what
            if (remark.kind, about) not in told:
                told.add((remark.kind, about))
                yield remark
    yield from agreed(repository, verdicts)
