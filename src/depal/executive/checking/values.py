"""Whether conditions compare facts with values that they can have."""

from collections.abc import Iterator

from depal.executive.checking.findings import Finding, FindingKind, head_of, place_of
from depal.executive.checking.names import check_fact
from depal.executive.conditions import (
    Compare,
    Condition,
    FactRef,
    Literal,
    Var,
    comparisons_of,
    facts_of,
)
from depal.executive.exploring.grounding import declaration_of, known_sorts, sorts_of
from depal.executive.language import format_condition
from depal.executive.schema import (
    FLAG,
    NUMBER,
    TEXT,
    FactDeclaration,
    Repository,
    Schema,
    Task,
)

ORDERED = frozenset({"<", "<=", ">", ">="})


def conditions_in(schema: Schema) -> Iterator[tuple[str, Condition]]:
    """Every condition of a schema with the place where it stands."""
    head = head_of(schema)
    yield f"{head}, when", schema.when
    if isinstance(schema, Task):
        for number, step in enumerate(schema.steps, start=1):
            yield f"{place_of(schema, number)}, when", step.when
    yield f"{head}, until", schema.until
    yield f"{head}, within", schema.within


def check_conditions(repository: Repository) -> Iterator[Finding]:
    """Facts that are not declared, and comparisons that cannot be meant."""
    for schema in repository.schemata.values():
        for where, condition in conditions_in(schema):
            for fact in dict.fromkeys(facts_of(condition)):
                yield from check_fact(repository, schema, fact, where)
            for compare in comparisons_of(condition):
                yield from _check_comparison(repository, schema, compare, where)


def _check_comparison(
    repository: Repository, schema: Schema, compare: Compare, where: str
) -> Iterator[Finding]:
    sorts = sorts_of(schema)
    fact = declaration_of(repository, compare.fact, sorts)
    other = compare.other
    if isinstance(other, Var) and other.name not in sorts:
        what = f"{other.name!r} is no parameter of {head_of(schema)}"
        yield Finding(FindingKind.UNBOUND_VARIABLE, where, what)
        return
    if isinstance(other, FactRef):
        declared = declaration_of(repository, other, sorts)
        right, named = (_kinds(declared), declared.name) if declared else (frozenset(), "")
    elif isinstance(other, Var):
        right, named = frozenset({sorts[other.name]}), f"{other.name}, a {sorts[other.name]}"
    else:
        right, named = _literal_kinds(repository, other), str(other.value)
    if fact is None or not right:
        return
    holds = " or ".join(fact.type.kinds)
    text = format_condition(compare)
    if not _kinds(fact) & right:
        what = f"{fact.name} holds a {holds} and is compared with {named}: {text}"
        yield Finding(FindingKind.WRONG_VALUE, where, what)
    elif compare.op in ORDERED and (NUMBER not in right or NUMBER not in fact.type.kinds):
        what = f"{fact.name} holds a {holds}, which has no order: {text}"
        yield Finding(FindingKind.WRONG_VALUE, where, what)


def _kinds(fact: FactDeclaration) -> frozenset[str]:
    return frozenset(fact.type.kinds)


def _literal_kinds(repository: Repository, literal: Literal) -> frozenset[str]:
    """The kinds of facts that may hold a literal; a name may be a thing of any sort."""
    if isinstance(literal.value, bool):
        return frozenset({FLAG})
    if isinstance(literal.value, str):
        return known_sorts(repository) | {TEXT}
    return frozenset({NUMBER})
