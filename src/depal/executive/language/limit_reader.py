"""Limits as they are written: `speed 0.25 m/s`, or a fact as in `speed cell.speed`."""

from collections.abc import Set as AbstractSet

from depal.executive.language.condition_reader import read_fact
from depal.executive.language.cursor import Cursor
from depal.executive.language.tokens import Kind
from depal.executive.schema import Limit
from depal.executive.units import UNITS


def read_limit(cursor: Cursor, variables: AbstractSet[str]) -> Limit:
    """Takes a quantity, and a number with its unit or a fact.

    Args:
        cursor: before the quantity.
        variables: the parameters of the schema.

    Raises:
        UnreadableError: when there is none; the problem is noted.
    """
    quantity = cursor.name("a quantity, as in speed").text
    if cursor.here.kind is Kind.WORD:
        return Limit(quantity, read_fact(cursor, variables))
    first = cursor.here
    most = cursor.number(f"how much {quantity}: a number and its unit, or a fact")
    unit = cursor.unit(quantity, UNITS)
    if most <= 0.0:
        cursor.note(first, f"{cursor.since(first)} is no limit", "more than 0")
    return Limit(quantity, most, unit)
