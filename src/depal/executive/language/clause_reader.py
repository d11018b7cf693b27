"""The clauses behind the head of a task, an action or a step, in any order."""

from collections.abc import Callable, Mapping
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from typing import Final, TypeVar

from depal.executive.conditions import ALWAYS, Condition, FactRef
from depal.executive.language.condition_reader import read_condition, read_fact
from depal.executive.language.cursor import Cursor
from depal.executive.language.limit_reader import read_limit, read_zone
from depal.executive.language.tokens import Kind, Token
from depal.executive.language.words import (
    ACTION_CLAUSES,
    CLAUSES,
    CONNECTIVES,
    STEP_CLAUSES,
    TASK_CLAUSES,
    listed,
    meant,
)
from depal.executive.schema import Cancel, Limit

_Item = TypeVar("_Item", str, FactRef, Limit, str | FactRef)

OWNERS: Final[Mapping[str, tuple[str, ...]]] = {
    "a task": TASK_CLAUSES,
    "an action": ACTION_CLAUSES,
    "a step": STEP_CLAUSES,
}
"""Which clauses belong to what."""


@dataclass(slots=True)
class Clauses:
    """What the clauses said, and what is so if they did not; as in Task, Action and Step."""

    when: Condition = ALWAYS
    until: Condition | None = None
    within: Condition = ALWAYS
    limits: tuple[Limit, ...] = ()
    avoids: tuple[str | FactRef, ...] = ()
    keeps: tuple[str, ...] = ()
    uses: tuple[str, ...] = ()
    sets: tuple[FactRef, ...] = ()
    cancel: Cancel = Cancel.IMMEDIATE
    timeout: float | None = None
    retries: int = 0
    backoff: float = 0.0
    probe: str | None = None
    idempotent: bool = False
    bias: float = 0.0


def read_clauses(cursor: Cursor, owner: str, variables: AbstractSet[str]) -> Clauses:
    """Takes every clause up to the end of the line.

    Args:
        cursor: behind the head.
        owner: a key of OWNERS.
        variables: the parameters of the schema.

    Returns:
        What they say.

    Raises:
        UnreadableError: when something is no clause; the problem is noted.
    """
    clauses = Clauses()
    seen: dict[str, Token] = {}
    after_condition = False
    while not cursor.at_end:
        token = cursor.here
        if token.text not in OWNERS[owner]:
            _no_clause(cursor, owner, after_condition=after_condition)
        cursor.advance()
        if token.text in seen:
            first = seen[token.text].place
            cursor.note(token, f"{token.text!r} is given twice, first at {first}", "it once")
        seen.setdefault(token.text, token)
        _read_value(cursor, token.text, clauses, variables)
        after_condition = token.text in {"when", "until", "within"}
    return clauses


def _no_clause(cursor: Cursor, owner: str, *, after_condition: bool) -> None:
    token = cursor.here
    known = OWNERS[owner]
    if token.text in CLAUSES:
        owners = [other for other, words in OWNERS.items() if token.text in words]
        what = f"{token.text!r} belongs to {' or '.join(owners)}, not to {owner}"
        cursor.fail(listed(known), what=what)
    expected = f"a clause of {owner}: {listed(known)}"
    if cursor.is_call and owner != "an action":
        expected += "; a step begins with '-'"
    choices = (*known, *CONNECTIVES) if after_condition else known
    cursor.fail(expected, exists=meant(token.text, choices) if token.kind is Kind.WORD else "")


def _read_value(  # noqa: C901, PLR0912 - one case a clause
    cursor: Cursor, word: str, clauses: Clauses, variables: AbstractSet[str]
) -> None:
    match word:
        case "when":
            clauses.when = read_condition(cursor, variables)
        case "until":
            clauses.until = read_condition(cursor, variables)
        case "within":
            clauses.within = read_condition(cursor, variables)
        case "limit":
            clauses.limits = _limits(cursor, variables)
        case "avoids":
            clauses.avoids = _zones(cursor, variables)
        case "keeps":
            clauses.keeps = _names(cursor, word)
        case "uses":
            clauses.uses = _names(cursor, word)
        case "sets":
            clauses.sets = _facts(cursor, variables)
        case "cancel":
            clauses.cancel = _policy(cursor)
        case "timeout":
            clauses.timeout = cursor.duration("a timeout")
        case "retries":
            clauses.retries = cursor.count("how often it is tried again", least=0)
        case "backoff":
            clauses.backoff = cursor.duration("a back-off")
        case "probe":
            clauses.probe = cursor.name("a probe").text
        case "idempotent":
            clauses.idempotent = True
        case _:
            clauses.bias = cursor.number("a bias, a number as in 0.2")


def _names(cursor: Cursor, word: str) -> tuple[str, ...]:
    return _list(cursor, word, lambda: cursor.name("a resource").text)


def _facts(cursor: Cursor, variables: AbstractSet[str]) -> tuple[FactRef, ...]:
    return _list(cursor, "sets", lambda: read_fact(cursor, variables))


def _limits(cursor: Cursor, variables: AbstractSet[str]) -> tuple[Limit, ...]:
    return _list(cursor, "limit", lambda: read_limit(cursor, variables))


def _zones(cursor: Cursor, variables: AbstractSet[str]) -> tuple[str | FactRef, ...]:
    return _list(cursor, "avoids", lambda: read_zone(cursor, variables))


def _list(cursor: Cursor, word: str, read: Callable[[], _Item]) -> tuple[_Item, ...]:
    items: list[_Item] = []
    while True:
        token = cursor.here
        item = read()
        if item in items:
            cursor.note(token, f"{cursor.since(token)} stands twice in {word!r}", "it once")
        else:
            items.append(item)
        if not cursor.accept(","):
            return tuple(items)


def _policy(cursor: Cursor) -> Cancel:
    token = cursor.here
    policies = tuple(policy.value for policy in Cancel)
    if token.text not in policies:
        exists = meant(token.text, policies) if token.kind is Kind.WORD else ""
        cursor.fail(f"how it is cancelled: {listed(policies)}", exists=exists)
    return Cancel(cursor.advance().text)
