"""Grounded conditions as functions without arguments, and what they have to be told of."""

from collections.abc import Callable
from dataclasses import dataclass

from depal.executive.conditions import (
    COMPARISONS,
    AllOf,
    Always,
    AnyOf,
    Binding,
    Compare,
    Condition,
    FactRef,
    Holds,
    Key,
    Lasting,
    Literal,
    Not,
    Value,
    compared,
    key_of,
)

Test = Callable[[], bool]

Watch = Key | tuple[Key, Value]
"""What a condition waits for: any change of a fact, or its change from or to one value."""


@dataclass(slots=True)
class Span:
    """A grounded time condition.

    Attributes:
        key: the name under which others watch it.
        seconds: for how long its part must hold.
        part: its part.
        watches: what its part waits for.
        since: since when the part holds without a break, None while it does not [s].
        value: whether it has held for long enough.
        users: how often allocated trees mention it.
    """

    key: Key
    seconds: float
    part: Test
    watches: tuple[Watch, ...]
    since: float | None = None
    value: bool = False
    users: int = 0


SpanOf = Callable[[Lasting, Binding], Span]
"""Finds or makes the one span of a grounded time condition."""


def always() -> bool:
    """The precondition that is left out."""
    return True


def compiled(
    condition: Condition, binding: Binding, facts: dict[Key, Value], span_of: SpanOf
) -> tuple[Test, tuple[Watch, ...]]:
    """A condition as a function of the facts as they are when it is called.

    Args:
        condition: as written.
        binding: what its parameters stand for.
        facts: the engine's facts; read at every call.
        span_of: where time conditions are kept.

    Returns:
        The function, and everything whose change can change its value.
    """
    get = facts.get
    match condition:
        case Always():
            return always, ()
        case Holds(fact):
            key = key_of(fact, binding)

            def is_set() -> bool:
                value = get(key)
                return value is not None and value is not False

            return is_set, (key,)
        case Compare():
            return _comparison(condition, binding, facts)
        case Not(part):
            inner, watches = compiled(part, binding, facts, span_of)
            return (lambda: not inner()), watches
        case AllOf(parts) | AnyOf(parts):
            pairs = [compiled(part, binding, facts, span_of) for part in parts]
            watched = tuple(watch for _, watches in pairs for watch in watches)
            return _joined([test for test, _ in pairs], every=isinstance(condition, AllOf)), watched
        case Lasting():
            span = span_of(condition, binding)
            return (lambda: span.value), (span.key,)


def _joined(tests: list[Test], *, every: bool) -> Test:
    first, second, *more = tests
    if more:
        return (
            (lambda: all(test() for test in tests))
            if every
            else (lambda: any(test() for test in tests))
        )
    return (lambda: first() and second()) if every else (lambda: first() or second())


def _comparison(
    condition: Compare, binding: Binding, facts: dict[Key, Value]
) -> tuple[Test, tuple[Watch, ...]]:
    get, op, key = facts.get, condition.op, key_of(condition.fact, binding)
    other = condition.other
    if isinstance(other, FactRef):
        other_key = key_of(other, binding)
        return (lambda: compared(get(key), op, get(other_key))), (key, other_key)
    right: Value = other.value if isinstance(other, Literal) else binding[other.name]
    if op == "=":
        return (lambda: get(key) == right), ((key, right),)
    if op == "!=":
        return (lambda: get(key) != right), ((key, right),)
    compare = COMPARISONS[op]

    def ordered() -> bool:
        left = get(key)
        return (
            isinstance(left, int | float)
            and isinstance(right, int | float)
            and compare(left, right)
        )

    return ordered, (key,)
