"""What happens to the executive: events, and the text that the journal keeps of them.

An event is one atomic change. The same events in the same order give the same state, whoever
applies them: the running engine or a restart that folds the journal.
"""

import json
from dataclasses import dataclass, fields
from enum import Enum
from typing import Any, Final

from depal.errors import JournalError
from depal.executive.conditions import Key, Value

Change = tuple[Key, Value]
"""A fact and its new value."""


class Outcome(Enum):
    """How an attempt ended, as far as the primitive can say; the facts decide the rest."""

    DONE = "done"
    FAILED = "failed"
    CANCELLED = "cancelled"
    TIMEOUT = "timeout"
    UNDECLARED = "undeclared"
    PROBED = "probed"
    UNKNOWN = "unknown"


@dataclass(frozen=True, slots=True)
class Allocated:
    """A task has been grounded and added to the trees."""

    at: float
    tree: int
    schema: str
    args: tuple[str, ...]
    priority: float
    digest: str


@dataclass(frozen=True, slots=True)
class Changed:
    """Facts have changed together, by the world or by a person."""

    at: float
    facts: tuple[Change, ...]
    source: str


@dataclass(frozen=True, slots=True)
class Started:
    """A primitive is about to run; written before it moves anything."""

    at: float
    attempt: int
    tree: int
    node: int


@dataclass(frozen=True, slots=True)
class Ended:
    """An attempt has ended, with the facts that it changed, in one."""

    at: float
    attempt: int
    outcome: Outcome
    facts: tuple[Change, ...]
    reason: str


@dataclass(frozen=True, slots=True)
class CancelAsked:
    """A running attempt is to stop, as soon as its policy lets it."""

    at: float
    attempt: int
    reason: str


@dataclass(frozen=True, slots=True)
class Prioritised:
    """A tree has another priority."""

    at: float
    tree: int
    priority: float


@dataclass(frozen=True, slots=True)
class Withdrawn:
    """A tree is no longer wanted; it ends when nothing of it runs."""

    at: float
    tree: int
    reason: str


@dataclass(frozen=True, slots=True)
class Archived:
    """A tree has ended."""

    at: float
    tree: int
    accomplished: bool


@dataclass(frozen=True, slots=True)
class Retried:
    """A person lets a primitive be tried again after it had used up its retries."""

    at: float
    tree: int
    node: int


@dataclass(frozen=True, slots=True)
class Ticked:
    """Time has come for a time-out, a retry or a time condition."""

    at: float


@dataclass(frozen=True, slots=True)
class ModeChanged:
    """The executive is held (nothing starts) or started."""

    at: float
    held: bool
    source: str


@dataclass(frozen=True, slots=True)
class Restarted:
    """The controller is back; every attempt that had not ended is in doubt."""

    at: float


Event = (
    Allocated
    | Changed
    | Started
    | Ended
    | CancelAsked
    | Prioritised
    | Withdrawn
    | Archived
    | Retried
    | Ticked
    | ModeChanged
    | Restarted
)

_KINDS: Final[dict[str, type[Event]]] = {
    kind.__name__: kind
    for kind in (
        Allocated,
        Changed,
        Started,
        Ended,
        CancelAsked,
        Prioritised,
        Withdrawn,
        Archived,
        Retried,
        Ticked,
        ModeChanged,
        Restarted,
    )
}


_OUTCOMES: Final = {outcome.value: outcome for outcome in Outcome}
_read: Final = json.JSONDecoder().decode


def encode(event: Event) -> str:
    """The canonical text of an event, without its kind and its time."""
    body: dict[str, Any] = {}
    for part in fields(event):
        value = getattr(event, part.name)
        if part.name != "at":
            body[part.name] = value.value if isinstance(value, Outcome) else value
    return json.dumps(body, separators=(",", ":"), sort_keys=True, allow_nan=False)


def decode(at: float, kind: str, body: str) -> Event:
    """The event that a record holds.

    Raises:
        JournalError: it is no event of this version.
    """
    try:
        values = _read(body)
        if kind == "Ended":
            values["outcome"] = _OUTCOMES[values["outcome"]]
        if kind in {"Ended", "Changed"}:
            values["facts"] = tuple([(key, value) for key, value in values["facts"]])
        elif kind == "Allocated":
            values["args"] = tuple(values["args"])
        return _KINDS[kind](at=at, **values)
    except (ValueError, KeyError, TypeError) as error:
        message = f"the journal holds no event of this version: {kind} {body[:80]}"
        raise JournalError(message) from error
