"""Grounded conditions as functions without arguments, and what they have to be told of."""

from collections.abc import Callable
from dataclasses import dataclass

from depal.executive.conditions import (
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
        due: when it wants to be measured again [s].
        users: how often allocated trees mention it.
    """

    key: Key
    seconds: float
    part: Test
    watches: tuple[Watch, ...]
    since: float | None = None
    value: bool = False
    users: int = 0
    due: float | None = None


SpanOf = Callable[[Lasting, Binding], Span]
"""Finds or makes the one span of a grounded time condition."""


def always() -> bool:
    """The precondition that is left out."""
    return True


Grounded = tuple[Test, tuple[Watch, ...]]
"""A condition as a function of the facts as they are when it is called, and what it waits for."""

Staged = Callable[[Binding], Grounded]
"""A condition whose structure has been read; a binding grounds it."""


class Compiler:
    """Reads each condition once and grounds it as often as it is needed.

    Attributes:
        facts: the engine's facts; grounded conditions read them at every call.
        span_of: where time conditions are kept.
    """

    def __init__(self, facts: dict[Key, Value], span_of: SpanOf) -> None:
        """Nothing has been read yet."""
        self.facts = facts
        self.span_of = span_of
        self._staged: dict[int, tuple[Condition, Staged]] = {}

    def ground(self, condition: Condition, binding: Binding) -> Grounded:
        """The condition for one binding."""
        known = self._staged.get(id(condition))
        if known is None:
            # The condition is kept beside its reading, so that its id stays its own.
            known = (condition, self._read(condition))
            self._staged[id(condition)] = known
        return known[1](binding)

    def _read(self, condition: Condition) -> Staged:
        match condition:
            case Always():
                return lambda _: (always, ())
            case Holds(fact):
                return self._holds(fact)
            case Compare():
                return self._comparison(condition)
            case Not(part):
                return self._negation(self._read(part))
            case AllOf(parts) | AnyOf(parts):
                return _junction(
                    [self._read(part) for part in parts], every=isinstance(condition, AllOf)
                )
            case Lasting():
                return self._lasting(condition)

    def _holds(self, fact: FactRef) -> Staged:
        get, key_for = self.facts.get, _key(fact)

        def ground(binding: Binding) -> Grounded:
            key = key_for(binding)

            def is_set() -> bool:
                value = get(key)
                return value is not None and value is not False

            return is_set, (key,)

        return ground

    def _negation(self, part: Staged) -> Staged:
        def ground(binding: Binding) -> Grounded:
            inner, watches = part(binding)
            return (lambda: not inner()), watches

        return ground

    def _lasting(self, condition: Lasting) -> Staged:
        def ground(binding: Binding) -> Grounded:
            span = self.span_of(condition, binding)
            return (lambda: span.value), (span.key,)

        return ground

    def _comparison(self, condition: Compare) -> Staged:
        get, op, other = self.facts.get, condition.op, condition.other
        key_for = _key(condition.fact)
        if isinstance(other, FactRef):
            other_key_for = _key(other)

            def with_fact(binding: Binding) -> Grounded:
                key, other_key = key_for(binding), other_key_for(binding)
                return (lambda: compared(get(key), op, get(other_key))), (key, other_key)

            return with_fact

        def with_value(binding: Binding) -> Grounded:
            key = key_for(binding)
            right: Value = other.value if isinstance(other, Literal) else binding[other.name]
            if op == "=":
                return (lambda: get(key) == right), ((key, right),)
            if op == "!=":
                return (lambda: get(key) != right), ((key, right),)
            return (lambda: compared(get(key), op, right)), (key,)

        return with_value


def _key(fact: FactRef) -> Callable[[Binding], Key]:
    subject, suffix = fact.subject, f".{fact.attribute}"
    if isinstance(subject, Literal):
        fixed = f"{subject.value}{suffix}"
        return lambda _: fixed
    name = subject.name
    return lambda binding: binding[name] + suffix


def _junction(parts: list[Staged], *, every: bool) -> Staged:
    def two(binding: Binding) -> Grounded:
        (first, first_watches), (second, second_watches) = (part(binding) for part in parts)
        watches = first_watches + second_watches
        if every:
            return (lambda: first() and second()), watches
        return (lambda: first() or second()), watches

    def many(binding: Binding) -> Grounded:
        pairs = [part(binding) for part in parts]
        tests = [test for test, _ in pairs]
        watches = tuple(watch for _, watched in pairs for watch in watched)
        if every:
            return (lambda: all(test() for test in tests)), watches
        return (lambda: any(test() for test in tests)), watches

    return two if len(parts) == 2 else many  # noqa: PLR2004 - a pair
