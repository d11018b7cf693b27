"""The journal as the store's side tells it: numbered events, each told once."""

from dataclasses import dataclass
from typing import Any, Protocol

PER_RUN = 10**9
"""Event n of run r has the number r * PER_RUN + n: it rises over all runs."""


@dataclass(frozen=True, slots=True)
class Event:
    """Something that happened.

    Attributes:
        sequence: its number.
        run: whose.
        at: on the cell's clock [s].
        kind: the name of the event in the executive's journal.
        body: what it says.
    """

    sequence: int
    run: int
    at: float
    kind: str
    body: dict[str, Any]


class Events(Protocol):
    """Where events are read; any thread may."""

    def after(self, sequence: int, limit: int) -> tuple[Event, ...]:
        """The events after a number, in order."""
        ...

    @property
    def last(self) -> int:
        """The number of the newest event; 0 where there is none."""
        ...
