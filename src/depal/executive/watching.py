"""From a change of facts to whatever it can have changed, and nothing else."""

from collections.abc import Iterable, Iterator
from typing import Final, Generic, NamedTuple, TypeVar

from depal.executive.conditions import (
    AllOf,
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
    key_of,
)

Watch = Key | tuple[Key, Value]
"""What a condition waits for: any change of a fact, or its change from or to one value."""

Atomic = Holds | Compare | Lasting
"""A part of a condition that is true or false by itself."""

T = TypeVar("T")
Token = tuple[int, int]
"""Which of the watchers it is; they are told in the order of their tokens."""


class Move(NamedTuple):
    """A fact that has changed, and its values before and after."""

    key: Key
    before: Value = None
    after: Value = None


_ANY: Final = object()
"""Stands for any value of a fact."""


class Watchers(Generic[T]):
    """An index from facts to who waits for them: by key, then by value."""

    def __init__(self) -> None:
        """Nobody waits."""
        self._index: dict[Key, dict[object, dict[Token, T]]] = {}

    def watch(self, watches: Iterable[Watch], token: Token, who: T) -> None:
        """Somebody is to be told of changes."""
        for watch in watches:
            key, value = (watch, _ANY) if isinstance(watch, str) else watch
            by_value = self._index.get(key)
            if by_value is None:
                self._index[key] = {value: {token: who}}
            elif value in by_value:
                by_value[value][token] = who
            else:
                by_value[value] = {token: who}

    def unwatch(self, watches: Iterable[Watch], token: Token) -> None:
        """Somebody is not to be told any more; a watch may occur twice."""
        for watch in watches:
            key, value = (watch, _ANY) if isinstance(watch, str) else watch
            by_value = self._index.get(key)
            waiting = None if by_value is None else by_value.get(value)
            if by_value is None or waiting is None:
                continue
            waiting.pop(token, None)
            if not waiting:
                del by_value[value]
                if not by_value:
                    del self._index[key]

    def __len__(self) -> int:
        """How many facts somebody waits for."""
        return len(self._index)

    def told(self, moves: Iterable[Move]) -> list[tuple[Token, T]]:
        """Everybody whom changes concern, in order."""
        found: dict[Token, T] = {}
        for key, before, after in moves:
            by_value = self._index.get(key)
            if by_value is None:
                continue
            for value in (_ANY, before, after):
                waiting = by_value.get(value)
                if waiting is not None:
                    found.update(waiting)
        return sorted(found.items(), key=_token) if len(found) > 1 else list(found.items())


def _token(entry: tuple[Token, object]) -> Token:
    return entry[0]


def atomics_of(condition: Condition) -> Iterator[Atomic]:
    """The parts of a condition that are true or false by themselves, left to right."""
    match condition:
        case Holds() | Compare() | Lasting():
            yield condition
        case Not(part):
            yield from atomics_of(part)
        case AllOf(parts) | AnyOf(parts):
            for part in parts:
                yield from atomics_of(part)
        case _:
            return


def watches_of(atomic: Holds | Compare, binding: Binding) -> tuple[Watch, ...]:
    """What has to be watched for the value of such a part.

    A comparison with one value is told of that value alone: a thousand trees that wait for
    `kr60.at` must not all be looked at when it moves.
    """
    key = key_of(atomic.fact, binding)
    if isinstance(atomic, Holds):
        return (key,)
    other = atomic.other
    if isinstance(other, FactRef):
        return key, key_of(other, binding)
    if atomic.op in {"=", "!="}:
        return ((key, other.value if isinstance(other, Literal) else binding[other.name]),)
    return (key,)
