"""Conditions as they are written.

    condition := conjunction { or conjunction }
    conjunction := literal { and literal }
    literal := not literal | atom [for DURATION]
    atom := true | ( condition ) | FACT [ = != < <= > >=  NUMBER | NAME | FACT ]

Each connective may be written with the paper's glyphs too.
"""

from collections.abc import Set as AbstractSet
from typing import Final

from depal.executive.conditions import (
    ALWAYS,
    COMPARISONS,
    AllOf,
    AnyOf,
    Compare,
    Condition,
    FactRef,
    Holds,
    Lasting,
    Literal,
    Not,
    Operand,
    Var,
)
from depal.executive.language.cursor import Cursor
from depal.executive.language.tokens import Kind
from depal.executive.language.words import AND, COMPARISON_GLYPHS, NOT, OR

DEEPEST: Final = 50
"""How deep parentheses and negations may be nested."""


def read_condition(cursor: Cursor, variables: AbstractSet[str], depth: int = 0) -> Condition:
    """Takes a condition.

    Args:
        cursor: where it begins.
        variables: names that are parameters of the schema around it.
        depth: how many parentheses and negations are open.

    Returns:
        The condition, nested as the parentheses say.

    Raises:
        UnreadableError: when there is none; the problem is noted.
    """
    parts = [_conjunction(cursor, variables, depth)]
    while cursor.accept(*OR):
        parts.append(_conjunction(cursor, variables, depth))
    return parts[0] if len(parts) == 1 else AnyOf(tuple(parts))


def _conjunction(cursor: Cursor, variables: AbstractSet[str], depth: int) -> Condition:
    parts = [_literal(cursor, variables, depth)]
    while cursor.accept(*AND):
        parts.append(_literal(cursor, variables, depth))
    return parts[0] if len(parts) == 1 else AllOf(tuple(parts))


def _literal(cursor: Cursor, variables: AbstractSet[str], depth: int) -> Condition:
    if depth >= DEEPEST and cursor.here.text in {*NOT, "("}:
        cursor.fail(f"at most {DEEPEST} of them", what="parentheses are nested too deep")
    if cursor.accept(*NOT):
        return Not(_literal(cursor, variables, depth + 1))
    atom = _atom(cursor, variables, depth)
    if cursor.accept("for"):
        return Lasting(atom, cursor.duration("a time"))
    return atom


def _atom(cursor: Cursor, variables: AbstractSet[str], depth: int) -> Condition:
    token = cursor.here
    if cursor.accept("("):
        inner = read_condition(cursor, variables, depth + 1)
        cursor.close(token)
        return inner
    if cursor.accept("true"):
        return ALWAYS
    if token.text == "false":
        cursor.fail("a condition; what never holds is 'not true'")
    if token.kind is not Kind.WORD:
        cursor.fail("a condition, as in Box.taken")
    fact = read_fact(cursor, variables)
    operator = COMPARISON_GLYPHS.get(cursor.here.text, cursor.here.text)
    if operator == "==":
        cursor.fail("'=', which compares", what="'==' is no comparison")
    if operator in COMPARISONS:
        cursor.advance()
        return Compare(fact, operator, _right_side(cursor, variables))
    return Holds(fact)


def _right_side(cursor: Cursor, variables: AbstractSet[str]) -> Operand | FactRef:
    token = cursor.here
    if token.text in {"true", "false"}:
        hint = "the fact alone, or not and the fact"
        cursor.fail(hint, what=f"a flag is not compared with {token.text!r}")
    if token.kind is Kind.NUMBER or token.text == "-":
        value = cursor.number("a number")
        follower = cursor.here
        if follower.text in {"m", "s", "kg", "mm", "ms", "min", "deg", "rad", "g", "cm"}:
            cursor.fail("a plain number", what="a number in a condition has no unit")
        return Literal(value)
    if token.kind is not Kind.WORD:
        cursor.fail("a number, a name or a fact to compare with")
    name = cursor.name("a thing").text
    if cursor.accept("."):
        return FactRef(operand(name, variables), cursor.name("an attribute").text)
    return operand(name, variables)


def read_fact(cursor: Cursor, variables: AbstractSet[str]) -> FactRef:
    """Takes a fact, as in `Box.taken`."""
    subject = cursor.name("a thing").text
    if not cursor.accept("."):
        cursor.fail(f"'.' and an attribute: {subject!r} alone is a thing, a fact is {subject}.ATTR")
    return FactRef(operand(subject, variables), cursor.name("an attribute").text)


def operand(name: str, variables: AbstractSet[str]) -> Operand:
    """A name: of a parameter, else of a thing."""
    return Var(name) if name in variables else Literal(name)
