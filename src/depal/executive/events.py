"""What happens to the executive: events, and the text that the journal keeps of them.

An event is one atomic change. The same events in the same order give the same state, whoever
applies them: the running engine or a restart that folds the journal.
"""

import json
from collections.abc import Iterable, Iterator
from enum import Enum
from itertools import islice
from typing import Any, Final, Protocol, get_args

import msgspec

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


class Happening(msgspec.Struct, frozen=True, tag=True, forbid_unknown_fields=True):
    """What all events have: when they happened [s]."""

    at: float


class Allocated(Happening, frozen=True):
    """A task has been grounded and added to the trees."""

    tree: int
    schema: str
    args: tuple[str, ...]
    priority: float
    digest: str


class Changed(Happening, frozen=True):
    """Facts have changed together, by the world or by a person."""

    facts: tuple[Change, ...]
    source: str


class Started(Happening, frozen=True):
    """A primitive is about to run; written before it moves anything."""

    attempt: int
    tree: int
    node: int


class Ended(Happening, frozen=True):
    """An attempt has ended, with the facts that it changed, in one."""

    attempt: int
    outcome: Outcome
    facts: tuple[Change, ...]
    reason: str


class CancelAsked(Happening, frozen=True):
    """A running attempt is to stop, as soon as its policy lets it."""

    attempt: int
    reason: str


class Prioritised(Happening, frozen=True):
    """A tree has another priority."""

    tree: int
    priority: float


class Withdrawn(Happening, frozen=True):
    """A tree is no longer wanted; it ends when nothing of it runs."""

    tree: int
    reason: str


class Archived(Happening, frozen=True):
    """A tree has ended."""

    tree: int
    accomplished: bool


class Retried(Happening, frozen=True):
    """A person lets a primitive be tried again after it had used up its retries."""

    tree: int
    node: int


class Ticked(Happening, frozen=True):
    """Time has come for a time-out, a retry or a time condition."""


class ModeChanged(Happening, frozen=True):
    """The executive is held (nothing starts) or started."""

    held: bool
    source: str


class Restarted(Happening, frozen=True):
    """The controller is back; every attempt that had not ended is in doubt."""


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

_KINDS: Final[dict[str, type[Event]]] = {kind.__name__: kind for kind in get_args(Event)}
_OUTCOMES: Final = {outcome.value: outcome for outcome in Outcome}
_read: Final = json.JSONDecoder().decode
_read_together: Final = msgspec.json.Decoder(list[Event]).decode

TOGETHER = 1000
"""So many records are read together."""


class Kept(Protocol):
    """What a journal keeps of an event."""

    @property
    def at(self) -> float:
        """When it happened [s]."""

    @property
    def kind(self) -> str:
        """Its kind."""

    @property
    def body(self) -> str:
        """All else, as text."""


def encode(event: Event) -> str:
    """The canonical text of an event, without its kind and its time."""
    body: dict[str, Any] = {}
    for name in event.__struct_fields__:
        value = getattr(event, name)
        if name != "at":
            body[name] = value.value if isinstance(value, Outcome) else value
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


def decoded(records: Iterable[Kept]) -> Iterator[Event]:
    """The events that records hold, as `decode` gives them one by one, in a fifth of the time.

    Raises:
        JournalError: one of them is no event of this version; all before it come first.
    """
    records = iter(records)
    while together := list(islice(records, TOGETHER)):
        try:
            events = _read_together(f"[{','.join(map(_line, together))}]")
        except ValueError:  # one of them is strange: one by one it shows which, and how
            for record in together:
                yield decode(record.at, record.kind, record.body)
        else:
            yield from events


def _line(record: Kept) -> str:
    """A record as one text; where two texts give a time or a kind, the record's own counts."""
    comma = "," if len(record.body) > len("{}") else ""
    return f'{record.body[:-1]}{comma}"at":{record.at!r},"type":"{record.kind}"}}'
