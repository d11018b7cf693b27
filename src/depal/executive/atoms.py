"""The atoms of a task: the parts of its conditions that are true or false by themselves.

A set of atoms is written as a number, one bit an atom. A condition is then a function of the set
of atoms that are true, the same for every tree of the task; a tree only knows which facts its own
atoms look at. What was worked out for a set once holds for all trees.
"""

from collections.abc import Callable, Sequence
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
    Var,
    compared,
    key_of,
    name_of,
)
from depal.executive.spans import Span
from depal.executive.watching import Atomic, Watch, watches_of

Formula = Callable[[int], bool]
"""A condition as a function of the set of atoms that are true."""

_HOLE = "\0"
"""Stands around the number of an argument that is not known yet; no name has it."""


@dataclass(slots=True, eq=False)
class Subject:
    """What one tree is about.

    Attributes:
        words: the facts that its atoms look at, and the things that they compare them with.
        spans: its time conditions.
        watches: what each of its atoms has to be told of.
    """

    words: Sequence[str]
    spans: Sequence[Span]
    watches: Sequence[Sequence[Watch]] = ()


Test = Callable[[Subject], bool]


@dataclass(frozen=True, slots=True)
class Atom:
    """A part of a task's conditions.

    Attributes:
        test: whether it is true of a subject now.
        watches: what it has to be told of.
        own: whether all that it has to be told of is about its task's first argument, or time.
            What others wait for may be shared by any number of trees.
    """

    test: Test
    watches: Callable[[Subject], Sequence[Watch]]
    own: bool


def stand_ins(count: int) -> tuple[str, ...]:
    """So many arguments that are not known yet."""
    return tuple(f"{_HOLE}{position}{_HOLE}" for position in range(count))


def filled(texts: Sequence[str]) -> Callable[[Sequence[str]], tuple[str, ...]]:
    """Texts in which stand-ins begin some, as a function of the arguments."""
    slots = [_slot(text) for text in texts]

    def fill(args: Sequence[str]) -> tuple[str, ...]:
        return tuple([rest if at < 0 else args[at] + rest for at, rest in slots])

    return fill


def _slot(text: str) -> tuple[int, str]:
    """The number of the stand-in, -1 for none, and what follows it."""
    if not text.startswith(_HOLE):
        return -1, text
    _, number, rest = text.split(_HOLE)
    return int(number), rest


def members(numbers: int) -> Sequence[int]:
    """The elements of a set that is written as a number, in order."""
    if not numbers & numbers - 1:  # none, or one, as is usual
        return (numbers.bit_length() - 1,) if numbers else ()
    found = []
    while numbers:
        lowest = numbers & -numbers
        found.append(lowest.bit_length() - 1)
        numbers ^= lowest
    return found


class Atoms:
    """The atoms of one task, found while its conditions are read.

    Attributes:
        found: in the order of their first mention.
        words: what `Subject.words` is for the stand-ins.
    """

    def __init__(self, facts: dict[Key, Value]) -> None:
        """Nothing has been read.

        Args:
            facts: what is the case; tests read it whenever they are made.
        """
        self.found: list[Atom] = []
        self.words: list[str] = []
        self._facts = facts
        self._numbers: dict[object, int] = {}
        self._spans: dict[object, int] = {}

    def time(self, condition: Lasting, binding: Binding) -> bool:
        """Announces a time condition, inner ones first; whether it is a new one.

        `Subject.spans` has them in the order of their announcement.
        """
        count = len(self._spans)
        self._spans.setdefault((condition, frozenset(binding.items())), count)
        return len(self._spans) > count

    def read(self, condition: Condition, binding: Binding) -> tuple[Formula, int]:
        """A condition as a function of the true atoms, and the set of those that it mentions."""
        match condition:
            case Always():
                return (lambda _: True), 0
            case Not(part):
                inner, mentioned = self.read(part, binding)
                return (lambda true: not inner(true)), mentioned
            case AllOf(parts) | AnyOf(parts):
                return self._junction(
                    [self.read(part, binding) for part in parts],
                    every=isinstance(condition, AllOf),
                )
            case Holds() | Compare() | Lasting():
                bit = 1 << self._number(condition, binding)
                return (lambda true: true & bit != 0), bit

    def _junction(self, parts: list[tuple[Formula, int]], *, every: bool) -> tuple[Formula, int]:
        formulas = [formula for formula, _ in parts]
        mentioned = 0
        for _, some in parts:
            mentioned |= some
        if every:
            return (lambda true: all(formula(true) for formula in formulas)), mentioned
        return (lambda true: any(formula(true) for formula in formulas)), mentioned

    def _number(self, atomic: Atomic, binding: Binding) -> int:
        name = (
            (atomic, frozenset(binding.items()))
            if isinstance(atomic, Lasting)
            else _with_names(atomic, binding)
        )
        number = self._numbers.get(name)
        if number is None:
            number = self._numbers[name] = len(self.found)
            self.found.append(
                self._facts_atom(name)
                if isinstance(name, Holds | Compare)
                else _time_atom(self._spans[name])
            )
        return number

    def _facts_atom(self, atomic: Holds | Compare) -> Atom:
        watches = watches_of(atomic, {})
        parts = [self._watch(watch) for watch in watches]
        test = self._set(atomic) if isinstance(atomic, Holds) else self._comparison(atomic)
        own = all(map(_is_own, watches))
        return Atom(test, lambda subject: [part(subject) for part in parts], own)

    def _watch(self, watch: Watch) -> Callable[[Subject], Watch]:
        if isinstance(watch, str):
            at = self._word(watch)
            return lambda subject: subject.words[at]
        key, value = watch
        at, right = self._word(key), self._value(value)
        return lambda subject: (subject.words[at], right(subject))

    def _set(self, atomic: Holds) -> Test:
        get, at = self._facts.get, self._word(key_of(atomic.fact, {}))

        def test(subject: Subject) -> bool:
            value = get(subject.words[at])
            return value is not None and value is not False

        return test

    def _comparison(self, atomic: Compare) -> Test:
        get, op, other = self._facts.get, atomic.op, atomic.other
        at = self._word(key_of(atomic.fact, {}))
        if isinstance(other, FactRef):
            beside = self._word(key_of(other, {}))
            return lambda subject: compared(get(subject.words[at]), op, get(subject.words[beside]))
        right = self._value(other.value if isinstance(other, Literal) else other.name)
        return lambda subject: compared(get(subject.words[at]), op, right(subject))

    def _value(self, value: Value) -> Callable[[Subject], Value]:
        if not isinstance(value, str):
            return lambda _: value
        at = self._word(value)
        return lambda subject: subject.words[at]

    def _word(self, text: str) -> int:
        if text not in self.words:
            self.words.append(text)
        return self.words.index(text)


def _is_own(watch: Watch) -> bool:
    """Whether a watch names the first argument: `Box.taken`, or `kr60.at` becoming Box."""
    texts = (watch,) if isinstance(watch, str) else watch
    return any(isinstance(text, str) and _slot(text)[0] == 0 for text in texts)


def _time_atom(at: int) -> Atom:
    return Atom(
        lambda subject: subject.spans[at].value,
        lambda subject: [subject.spans[at].key],
        own=True,
    )


def _with_names(atomic: Holds | Compare, binding: Binding) -> Holds | Compare:
    """The same about things instead of parameters."""
    fact = _about(atomic.fact, binding)
    if isinstance(atomic, Holds):
        return Holds(fact)
    if isinstance(atomic.other, FactRef):
        return Compare(fact, atomic.op, _about(atomic.other, binding))
    other = atomic.other
    named = Literal(binding[other.name]) if isinstance(other, Var) else other
    return Compare(fact, atomic.op, named)


def _about(fact: FactRef, binding: Binding) -> FactRef:
    return FactRef(Literal(name_of(fact.subject, binding)), fact.attribute)
