"""The grounded time conditions of all trees, each once."""

from collections.abc import Iterable

from depal.executive.compiled import Compiler, Span, Watch
from depal.executive.conditions import Binding, Lasting
from depal.executive.nodes import LiveTree, SpanName


class Spans:
    """Time conditions, kept while a tree mentions them.

    They are watched all the time, also where a closed gate lets nodes sleep: how long a part
    has held does not depend on who looks.
    """

    def __init__(self) -> None:
        """There is none."""
        self.compiler: Compiler | None = None
        self._spans: dict[SpanName, Span] = {}
        self._watchers: dict[Watch, dict[str, Span]] = {}
        self._count = 0
        self._preset: dict[str, float] = {}

    def __bool__(self) -> bool:
        """Whether there is any."""
        return bool(self._spans)

    def find(self, condition: Lasting, binding: Binding) -> Span | None:
        """The span of a grounded time condition, where a tree mentions it."""
        return self._spans.get(_named(condition, binding))

    def of(self, condition: Lasting, binding: Binding) -> Span:
        """The span of a grounded time condition; a new one still has to be measured."""
        named = _named(condition, binding)
        span = self._spans.get(named)
        if span is None:
            if self.compiler is None:
                raise LookupError(named)
            part, watches = self.compiler.ground(condition.part, binding)
            self._count += 1
            span = Span(f"for:{self._count}", condition.seconds, part, watches)
            self._spans[named] = span
            span.since = self._preset.pop(_text(named), None)
            for watch in watches:
                self._watchers.setdefault(watch, {})[span.key] = span
        return span

    def use(self, tree: LiveTree, condition: Lasting, binding: Binding) -> Span:
        """A tree mentions a time condition."""
        span = self.of(condition, binding)
        span.users += 1
        tree.spans.append(_named(condition, binding))
        return span

    def release(self, tree: LiveTree) -> None:
        """A tree has ended."""
        for named in tree.spans:
            span = self._spans[named]
            span.users -= 1
            if not span.users:
                del self._spans[named]
                for watch in span.watches:
                    waiting = self._watchers.get(watch, {})
                    waiting.pop(span.key, None)
                    if not waiting:
                        self._watchers.pop(watch, None)

    def concerned(self, watches: Iterable[Watch]) -> list[Span]:
        """The spans that changes concern, in the order of their keys."""
        if not self._watchers:
            return []
        found = {
            key: span for watch in watches for key, span in self._watchers.get(watch, {}).items()
        }
        return [found[key] for key in sorted(found)]

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


def _named(condition: Lasting, binding: Binding) -> SpanName:
    return condition, frozenset(binding.items())


def _text(named: SpanName) -> str:
    return f"{named[0]!r} {sorted(named[1])!r}"
