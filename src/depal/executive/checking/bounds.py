"""Whether limits are of quantities that something keeps, and zones are there."""

from collections.abc import Collection, Iterator, Mapping

from depal.errors import did_you_mean
from depal.executive.checking.findings import Finding, FindingKind, head_of
from depal.executive.checking.names import check_fact
from depal.executive.conditions import FactRef
from depal.executive.exploring.grounding import declaration_of, sorts_of
from depal.executive.schema import FLAG, NUMBER, Limit, Repository, Schema
from depal.executive.units import UNITS, Quantity


def check_bounds(repository: Repository) -> Iterator[Finding]:
    """Facts behind limits that are no declared number, behind `avoids` that name nothing."""
    for schema in repository.schemata.values():
        for limit in schema.limits:
            if isinstance(limit.bound, FactRef):
                yield from _check_number(repository, schema, limit.quantity, limit.bound)
        for zone in schema.avoids:
            if isinstance(zone, FactRef):
                yield from _check_zone_fact(repository, schema, zone)


def check_quantities(repository: Repository, known: Mapping[str, Quantity]) -> Iterator[Finding]:
    """Limits of quantities that no primitive keeps, from the wrong side, or in another's units.

    Args:
        repository: any.
        known: the quantities that primitives keep, by their names.
    """
    for schema in repository.schemata.values():
        where = f"{head_of(schema)}, limit"
        for limit in schema.limits:
            quantity = known.get(limit.quantity)
            if quantity is None:
                exists = did_you_mean(limit.quantity, known)
                what = f"nothing keeps a limit of {limit.quantity!r}"
                yield Finding(FindingKind.UNKNOWN_QUANTITY, where, what, exists)
                continue
            if limit.unit and UNITS[limit.unit].base != quantity.base:
                what = f"{limit.quantity} is measured in {quantity.base}, not in {limit.unit}"
                yield Finding(FindingKind.WRONG_VALUE, where, what)
            if limit.at_least != quantity.at_least:
                yield Finding(FindingKind.WRONG_VALUE, where, _wrong_side(limit))


def check_zones(repository: Repository, known: Collection[str]) -> Iterator[Finding]:
    """Zones that a cell does not have.

    Args:
        repository: any.
        known: the names of the cell's zones.
    """
    for schema in repository.schemata.values():
        for zone in schema.avoids:
            if isinstance(zone, str) and zone not in known:
                exists = did_you_mean(zone, known) if known else "its file names none"
                what = f"the cell has no zone {zone!r}"
                yield Finding(FindingKind.UNKNOWN_ZONE, f"{head_of(schema)}, avoids", what, exists)


def _wrong_side(limit: Limit) -> str:
    if limit.at_least:
        return f"{limit.quantity} is bounded from above: without 'at least'"
    return f"{limit.quantity} is bounded from below: write 'limit {limit.quantity} at least'"


def _check_number(
    repository: Repository, schema: Schema, quantity: str, fact: FactRef
) -> Iterator[Finding]:
    where = f"{head_of(schema)}, limit"
    yield from check_fact(repository, schema, fact, where)
    declared = declaration_of(repository, fact, sorts_of(schema))
    if declared is not None and NUMBER not in declared.type.kinds:
        what = f"{declared.name} holds a {' or '.join(declared.type.kinds)}, and limits {quantity}"
        yield Finding(FindingKind.WRONG_VALUE, where, what)


def _check_zone_fact(repository: Repository, schema: Schema, fact: FactRef) -> Iterator[Finding]:
    where = f"{head_of(schema)}, avoids"
    yield from check_fact(repository, schema, fact, where)
    declared = declaration_of(repository, fact, sorts_of(schema))
    if declared is not None and set(declared.type.kinds) <= {FLAG, NUMBER}:
        what = f"{declared.name} holds a {' or '.join(declared.type.kinds)}, and no zone's name"
        yield Finding(FindingKind.WRONG_VALUE, where, what)
