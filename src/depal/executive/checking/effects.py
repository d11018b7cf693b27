"""Whether what an action may set can make its own postcondition true."""

from collections.abc import Iterator
from itertools import product
from math import prod

from depal.executive.checking.findings import Finding, FindingKind, head_of
from depal.executive.conditions import Value, at_once, holds, key_of
from depal.executive.exploring.domains import domains_of
from depal.executive.exploring.grounding import example_arguments, ground_condition, sorts_of
from depal.executive.language import format_condition
from depal.executive.schema import Action, Repository

LARGEST = 20_000
"""Of more combinations of values than this, nothing is said."""


def check_effect(repository: Repository, action: Action) -> Iterator[Finding]:
    """Looks for a state of the world in which the action makes a difference to its own until.

    Args:
        repository: with the declarations.
        action: one whose facts are all declared.
    """
    binding = dict(zip(sorts_of(action), example_arguments(action), strict=True))
    until = ground_condition(repository, action.until, binding, sorts_of(action))
    domains = domains_of([until], {})
    sets = {key_of(fact, binding) for fact in action.sets}
    own = [key for key in until.facts if key in sets]
    others = [key for key in until.facts if key not in sets]
    text = format_condition(action.until)
    if not own:
        what = f"sets nothing that its until depends on: {text}"
        yield Finding(FindingKind.POWERLESS, head_of(action), what)
        return
    own_values = [
        [value for value in domains[key] if value is not None or until.facts[key].type.optional]
        for key in own
    ]
    if prod(map(len, own_values)) * prod(len(domains[key]) for key in others) > LARGEST:
        return

    def true_for(fixed: tuple[Value, ...], chosen: tuple[Value, ...]) -> bool:
        facts = dict(zip([*others, *own], [*fixed, *chosen], strict=True))
        return holds(until.condition, facts, {}, at_once)

    for fixed in product(*(domains[key] for key in others)):
        if any(true_for(fixed, chosen) for chosen in product(*own_values)):
            return
    what = f"whatever it sets, its until never comes true: {text}"
    yield Finding(FindingKind.POWERLESS, head_of(action), what)
