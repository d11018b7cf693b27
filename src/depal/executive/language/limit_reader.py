"""Limits and zones as they are written: `speed 0.25 m/s`, `margin at least 0.03 g`, `aisle`.

A fact may stand where a number or a zone's name does, as in `speed cell.speed`.
"""

from collections.abc import Set as AbstractSet

from depal.executive.conditions import FactRef
from depal.executive.language.condition_reader import read_fact
from depal.executive.language.cursor import Cursor
from depal.executive.language.tokens import Kind
from depal.executive.schema import Limit
from depal.executive.units import UNITS


def read_limit(cursor: Cursor, variables: AbstractSet[str]) -> Limit:
    """Takes a quantity, `at least` where it is one, and a number with its unit or a fact.

    Args:
        cursor: before the quantity.
        variables: the parameters of the schema.

    Raises:
        UnreadableError: when there is none; the problem is noted.
    """
    quantity = cursor.name("a quantity, as in speed").text
    at_least = cursor.here.text == "at" and not cursor.is_fact
    if at_least:
        cursor.advance()
        cursor.expect("least", "'at'")
    if cursor.here.kind is Kind.WORD:
        return Limit(quantity, read_fact(cursor, variables), at_least=at_least)
    first = cursor.here
    bound = cursor.number(f"how much {quantity}: a number and its unit, or a fact")
    unit = cursor.unit(quantity, UNITS)
    if bound <= 0.0:
        cursor.note(first, f"{cursor.since(first)} is no limit", "more than 0")
    return Limit(quantity, bound, unit, at_least)


def read_zone(cursor: Cursor, variables: AbstractSet[str]) -> str | FactRef:
    """Takes the name of a zone, or the fact that tells it.

    Args:
        cursor: before the name.
        variables: the parameters of the schema.

    Raises:
        UnreadableError: when there is none; the problem is noted.
    """
    return read_fact(cursor, variables) if cursor.is_fact else cursor.name("a zone").text
