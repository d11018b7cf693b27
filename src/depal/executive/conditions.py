"""Conditions over facts: as written, grounded in names, explained.

A fact's value is a flag, a number, a text, the name of a thing, or None where it is empty. The
world is closed: what is not set is false, and no comparison with it holds.
"""

import operator
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Final

Value = bool | int | float | str | None
"""What a fact holds."""

Key = str
"""A fact of one thing, as in "b1.taken"."""

Facts = Mapping[Key, Value]

COMPARISONS: Final[Mapping[str, Callable[..., bool]]] = {
    "=": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}


@dataclass(frozen=True, slots=True)
class Var:
    """A parameter of the schema that a condition stands in."""

    name: str


@dataclass(frozen=True, slots=True)
class Literal:
    """A number, or the name of one thing, as in `reader`."""

    value: bool | float | str


@dataclass(frozen=True, slots=True)
class FactRef:
    """A fact, as in `Box.taken`; its subject is a parameter or the name of one thing."""

    subject: Var | Literal
    attribute: str


Operand = Var | Literal


@dataclass(frozen=True, slots=True)
class Always:
    """True, the precondition that is left out."""


@dataclass(frozen=True, slots=True)
class Holds:
    """A fact that is set and not false."""

    fact: FactRef


@dataclass(frozen=True, slots=True)
class Compare:
    """A fact compared with a number, a name, a parameter or another fact.

    Attributes:
        fact: the left side.
        op: a key of COMPARISONS; with an empty side only `!=` holds.
        other: the right side.
    """

    fact: FactRef
    op: str
    other: Operand | FactRef


@dataclass(frozen=True, slots=True)
class Not:
    """A condition that does not hold."""

    part: "Condition"


@dataclass(frozen=True, slots=True)
class AllOf:
    """Conditions that hold together; at least two."""

    parts: tuple["Condition", ...]


@dataclass(frozen=True, slots=True)
class AnyOf:
    """Conditions of which one holds; at least two."""

    parts: tuple["Condition", ...]


@dataclass(frozen=True, slots=True)
class Lasting:
    """A condition that has held without a break for some time [s]."""

    part: "Condition"
    seconds: float


Condition = Always | Holds | Compare | Not | AllOf | AnyOf | Lasting

ALWAYS: Final = Always()

Binding = Mapping[str, str]
"""The things that a schema's parameters stand for, by parameter."""


def name_of(operand: Operand, binding: Binding) -> str:
    """The thing that an argument or a subject names."""
    return binding[operand.name] if isinstance(operand, Var) else str(operand.value)


def key_of(fact: FactRef, binding: Binding) -> Key:
    """The key of a fact once its subject is known."""
    return f"{name_of(fact.subject, binding)}.{fact.attribute}"


def facts_of(condition: Condition) -> Iterator[FactRef]:
    """Every fact that a condition mentions, left to right, with repetitions."""
    match condition:
        case Always():
            return
        case Holds(fact):
            yield fact
        case Compare(fact, _, other):
            yield fact
            if isinstance(other, FactRef):
                yield other
        case Not(part) | Lasting(part, _):
            yield from facts_of(part)
        case AllOf(parts) | AnyOf(parts):
            for part in parts:
                yield from facts_of(part)


def comparisons_of(condition: Condition) -> Iterator[Compare]:
    """Every comparison inside, left to right."""
    match condition:
        case Compare():
            yield condition
        case Not(part) | Lasting(part, _):
            yield from comparisons_of(part)
        case AllOf(parts) | AnyOf(parts):
            for part in parts:
                yield from comparisons_of(part)
        case _:
            return


def lasting_of(condition: Condition) -> Iterator[Lasting]:
    """Every time condition inside, the inner ones first."""
    match condition:
        case Not(part):
            yield from lasting_of(part)
        case AllOf(parts) | AnyOf(parts):
            for part in parts:
                yield from lasting_of(part)
        case Lasting(part, _):
            yield from lasting_of(part)
            yield condition
        case _:
            return


def holds(  # noqa: PLR0911 - one return a kind of condition
    condition: Condition, facts: Facts, binding: Binding, lasted: "Lasted"
) -> bool:
    """The value of a condition, evaluated from scratch: the meaning of all the others.

    Args:
        condition: as written.
        facts: what is the case.
        binding: what the parameters stand for.
        lasted: tells of a time condition whether its part has held for long enough.

    Returns:
        Whether it holds.
    """
    match condition:
        case Always():
            return True
        case Holds(fact):
            return is_set(facts.get(key_of(fact, binding)))
        case Compare(fact, op, other):
            left = facts.get(key_of(fact, binding))
            if isinstance(other, FactRef):
                return compared(left, op, facts.get(key_of(other, binding)))
            right: Value = other.value if isinstance(other, Literal) else binding[other.name]
            return compared(left, op, right)
        case Not(part):
            return not holds(part, facts, binding, lasted)
        case AllOf(parts):
            return all(holds(part, facts, binding, lasted) for part in parts)
        case AnyOf(parts):
            return any(holds(part, facts, binding, lasted) for part in parts)
        case Lasting(part, _):
            return holds(part, facts, binding, lasted) and lasted(condition, binding)


Lasted = Callable[[Lasting, Binding], bool]
"""Whether the part of a grounded time condition has held for long enough by now."""


def at_once(_: Lasting, __: Binding) -> bool:
    """A world in which time conditions hold as soon as their part does."""
    return True


def is_set(value: Value) -> bool:
    """Whether a fact counts as true: set, and not a false flag. Zero is a number, and set."""
    return value is not None and value is not False


def compared(left: Value, op: str, right: Value) -> bool:
    """A comparison in a closed world: numbers with numbers, names with names."""
    if op == "=":
        return left is not None and right is not None and left == right
    if op == "!=":
        return left is None or right is None or left != right
    if isinstance(left, int | float) and isinstance(right, int | float):
        return COMPARISONS[op](left, right)
    return False
