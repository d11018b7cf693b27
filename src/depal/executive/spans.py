"""The grounded time conditions of all trees, each once."""

from collections.abc import Iterable
from dataclasses import dataclass

from depal.executive.conditions import Binding, Facts, Key, Lasting, holds
from depal.executive.watching import Move, Watch, Watchers, atomics_of, watches_of

SpanName = tuple[Lasting, frozenset[tuple[str, str]]]
"""A time condition and the things that it is about."""


@dataclass(slots=True, eq=False)
class Span:
    """A grounded time condition.

    Attributes:
        number: in the order of their making.
        key: the name under which others watch it.
        condition: as written.
        binding: what its parameters stand for.
        watches: what its part waits for.
        since: since when the part holds without a break, None while it does not [s].
        value: whether it has held for long enough.
        due: when it wants to be measured again [s].
        users: how often allocated trees mention it.
    """

    number: int
    key: Key
    condition: Lasting
    binding: Binding
    watches: tuple[Watch, ...]
    since: float | None = None
    value: bool = False
    users: int = 0
    due: float | None = None

    @property
    def name(self) -> SpanName:
        """What it is found by."""
        return _named(self.condition, self.binding)

    def elapsed_at(self) -> float | None:
        """When its part will have held for long enough [s]; None while it does not hold."""
        return None if self.since is None else self.since + self.condition.seconds


class Spans:
    """Time conditions, kept while a tree mentions them.

    They are watched all the time, also where nobody needs them: how long a part has held does
    not depend on who looks.
    """

    def __init__(self, facts: Facts) -> None:
        """There is none.

        Args:
            facts: what is the case, for the parts.
        """
        self._facts = facts
        self._spans: dict[SpanName, Span] = {}
        self._watchers: Watchers[Span] = Watchers()
        self._count = 0
        self._preset: dict[str, float] = {}

    def __bool__(self) -> bool:
        """Whether there is any."""
        return bool(self._spans)

    def has_lasted(self, condition: Lasting, binding: Binding) -> bool:
        """Whether the part of a time condition that a tree mentions has held for long enough."""
        span = self._spans.get(_named(condition, binding))
        return span is not None and span.value

    def holds(self, span: Span) -> bool:
        """Whether the part holds now."""
        return holds(span.condition.part, self._facts, span.binding, self.has_lasted)

    def use(self, condition: Lasting, binding: Binding) -> Span:
        """A tree mentions a time condition; a new one still has to be measured."""
        named = _named(condition, binding)
        span = self._spans.get(named)
        if span is None:
            self._count += 1
            watches = self._watches(condition, binding)
            span = Span(self._count, f"for:{self._count}", condition, binding, watches)
            span.since = self._preset.pop(_text(named), None)
            self._spans[named] = span
            self._watchers.watch(watches, (0, span.number), span)
        span.users += 1
        return span

    def release(self, spans: Iterable[Span]) -> None:
        """A tree has ended."""
        for span in spans:
            span.users -= 1
            if not span.users:
                del self._spans[span.name]
                self._watchers.unwatch(span.watches, (0, span.number))

    def concerned(self, moves: Iterable[Move]) -> list[Span]:
        """The spans that changes concern, in the order of their making."""
        return [span for _, span in self._watchers.told(moves)]

    def since(self) -> dict[str, float]:
        """Since when the part of each holds, by its condition and things."""
        return {
            _text(named): span.since
            for named, span in self._spans.items()
            if span.since is not None
        }

    def preset(self, since: dict[str, float]) -> None:
        """What `since` gave, for the spans of the trees that are allocated next."""
        self._preset = since

    def _watches(self, condition: Lasting, binding: Binding) -> tuple[Watch, ...]:
        """What the part waits for; inner time conditions are there already."""
        watches: list[Watch] = []
        for atomic in atomics_of(condition.part):
            if isinstance(atomic, Lasting):
                watches.append(self._spans[_named(atomic, binding)].key)
            else:
                watches += watches_of(atomic, binding)
        return tuple(watches)


def _named(condition: Lasting, binding: Binding) -> SpanName:
    return condition, frozenset(binding.items())


def _text(named: SpanName) -> str:
    return f"{named[0]!r} {sorted(named[1])!r}"
