"""Conditions back into text, with no more parentheses than their nesting needs."""

from typing import Final

from depal.executive.conditions import (
    AllOf,
    Always,
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
from depal.executive.schema import Limit

GLUE: Final = "\u00a0"
"""A space at which no line is broken, until the text is finished."""

_ANY, _ALL, _NOT, _LASTING, _ATOM = range(5)
_WHOLE: Final = 1e15


def format_condition(condition: Condition) -> str:
    """A condition as a task file writes it.

    Args:
        condition: any.

    Returns:
        One line; reading it again gives the same condition, nested the same way.
    """
    return glued_condition(condition).replace(GLUE, " ")


def glued_condition(condition: Condition) -> str:  # noqa: PLR0911 - one return a kind
    """The same, with glue inside comparisons, negations and durations."""
    match condition:
        case Always():
            return "true"
        case Holds(fact):
            return fact_text(fact)
        case Compare(fact, op, other):
            right = fact_text(other) if isinstance(other, FactRef) else operand_text(other)
            return f"{fact_text(fact)}{GLUE}{op}{GLUE}{right}"
        case Not(part):
            return f"not{GLUE}{_inside(part, _NOT)}"
        case Lasting(part, seconds):
            return f"{_inside(part, _ATOM)}{GLUE}for{GLUE}{duration_text(seconds)}"
        case AllOf(parts):
            return f" and{GLUE}".join(_inside(part, _NOT) for part in parts)
        case AnyOf(parts):
            return f" or{GLUE}".join(_inside(part, _ALL) for part in parts)


def _inside(condition: Condition, least: int) -> str:
    text = glued_condition(condition)
    return text if _binding(condition) >= least else f"({text})"


def _binding(condition: Condition) -> int:
    """How strongly a condition holds its parts together."""
    match condition:
        case AnyOf():
            return _ANY
        case AllOf():
            return _ALL
        case Not():
            return _NOT
        case Lasting():
            return _LASTING
        case _:
            return _ATOM


def fact_text(fact: FactRef) -> str:
    """`Box.taken`."""
    return f"{operand_text(fact.subject)}.{fact.attribute}"


def operand_text(operand: Operand) -> str:
    """A name or a number."""
    match operand:
        case Var(name):
            return name
        case Literal(bool() as flag):
            return "true" if flag else "false"
        case Literal(str() as name):
            return name
        case Literal(number):
            return number_text(float(number))


def number_text(number: float) -> str:
    """A number in as few digits as give it back."""
    whole = number.is_integer() and abs(number) < _WHOLE
    return str(int(number)) if whole else repr(number)


def limit_text(limit: Limit) -> str:
    """`speed 0.25 m/s`, or `margin at least 0.03 g`."""
    head = f"{limit.quantity}{GLUE}at{GLUE}least" if limit.at_least else limit.quantity
    if isinstance(limit.bound, FactRef):
        return f"{head}{GLUE}{fact_text(limit.bound)}"
    return f"{head}{GLUE}{number_text(limit.bound)}{GLUE}{limit.unit}"


def zone_text(zone: str | FactRef) -> str:
    """The name of a zone, or the fact that tells it."""
    return zone if isinstance(zone, str) else fact_text(zone)


def duration_text(seconds: float) -> str:
    """`5 s`."""
    return f"{number_text(seconds)}{GLUE}s"
