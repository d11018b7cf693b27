"""Finite domains: as few values as a set of conditions can tell apart.

A flag is false or true. Of numbers, the compared ones are kept, one between each two of them,
and one beyond either end. Of names, the compared ones are kept, and for every fact that may be
compared with another a name of its own that occurs nowhere.
"""

from collections.abc import Iterable, Mapping
from itertools import pairwise

from depal.executive.conditions import (
    FactRef,
    Lasting,
    Literal,
    Value,
    comparisons_of,
    key_of,
    lasting_of,
)
from depal.executive.exploring.grounding import Grounded
from depal.executive.language import format_condition
from depal.executive.schema import FLAG, NUMBER, TEXT, FactDeclaration

Domains = Mapping[str, tuple[Value, ...]]
"""The values of each fact, the one that it has while unset first."""

MOST_STRANGERS = 3
"""How many names that occur nowhere a group of compared facts is given at the most."""


def lasting_key(lasting: Lasting) -> str:
    """The stand-in for a time condition: a flag that says whether its time has passed."""
    return format_condition(lasting)


def domains_of(conditions: Iterable[Grounded], more: Mapping[str, FactDeclaration]) -> Domains:
    """The domain of every fact that conditions mention, and of their time conditions.

    Args:
        conditions: grounded.
        more: further facts that are wanted.

    Returns:
        Facts in the order in which they come up, then time conditions.
    """
    listed = list(conditions)
    facts = {key: fact for item in listed for key, fact in item.facts.items()} | dict(more)
    groups: dict[str, set[str]] = {key: {key} for key in facts}
    constants: dict[str, set[bool | float | str]] = {key: set() for key in facts}
    for compare in (part for item in listed for part in comparisons_of(item.condition)):
        left = key_of(compare.fact, {})
        if left not in facts:
            continue
        if isinstance(compare.other, Literal):
            constants[left].add(compare.other.value)
        elif isinstance(compare.other, FactRef) and (right := key_of(compare.other, {})) in facts:
            joined = groups[left] | groups[right]
            for key in joined:
                groups[key] = joined
    things = {thing: sort for item in listed for thing, sort in item.things.items()}
    domains = {
        key: _values(fact, _fitting(fact, groups[key], constants, things), len(groups[key]))
        for key, fact in facts.items()
    }
    times = {lasting_key(part) for item in listed for part in lasting_of(item.condition)}
    return domains | dict.fromkeys(sorted(times), (False, True))


def _fitting(
    fact: FactDeclaration,
    group: set[str],
    constants: Mapping[str, set[bool | float | str]],
    things: Mapping[str, str],
) -> set[bool | float | str]:
    """The constants of a group that are not known to be things of another sort."""
    return {
        constant
        for key in group
        for constant in constants[key]
        if not isinstance(constant, str)
        or TEXT in fact.type.kinds
        or things.get(constant, fact.type.kinds[0]) in fact.type.kinds
    }


def _values(
    fact: FactDeclaration, constants: set[bool | float | str], linked: int
) -> tuple[Value, ...]:
    kinds = fact.type.kinds
    values: list[Value] = [] if kinds == (FLAG,) else [None]
    if FLAG in kinds:
        values += [False, True]
    if NUMBER in kinds:
        values += _numbers({float(c) for c in constants if not isinstance(c, bool | str)})
    names = [kind for kind in kinds if kind not in {FLAG, NUMBER}]
    if names:
        values += sorted(c for c in constants if isinstance(c, str))
        values += _strangers(names[-1], min(linked, MOST_STRANGERS))
    return tuple(values)


def _strangers(kind: str, count: int) -> list[str]:
    word = "text" if kind == TEXT else kind.lower()
    return [f"other_{word}{number if number > 1 else ''}" for number in range(1, count + 1)]


def _numbers(constants: set[float]) -> list[float]:
    if not constants:
        return [1.0]
    ordered = sorted(constants)
    between = [(low + high) / 2 for low, high in pairwise(ordered)]
    return sorted([ordered[0] - 1.0, *ordered, *between, ordered[-1] + 1.0])
