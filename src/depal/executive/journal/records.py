"""What a journal holds, and the seam behind which it is kept."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from types import TracebackType
from typing import NamedTuple, Protocol, Self

from depal.errors import JournalError


class Entry(NamedTuple):
    """An event to be written.

    Attributes:
        at: when it happened [s], on the caller's clock; finite.
        kind: what sort of event it is.
        body: the event itself, canonical JSON text.
    """

    at: float
    kind: str
    body: str


class Record(NamedTuple):
    """An event that was written. A named tuple, because a restart makes many of them.

    Attributes:
        sequence: its number: 1, 2, 3 and so on without a gap.
        at: when it happened [s], on the caller's clock.
        kind: what sort of event it is.
        body: the event itself, canonical JSON text.
    """

    sequence: int
    at: float
    kind: str
    body: str


@dataclass(frozen=True, slots=True)
class Snapshot:
    """What all events up to a number amount to, so that a restart folds only the rest.

    Attributes:
        sequence: the number of the last event that it covers; 0 covers none.
        body: the state, as text; the caller says how.
    """

    sequence: int
    body: str


class Journal(Protocol):
    """An append-only list of events, and the latest snapshots of what they amount to.

    Every method raises `JournalError` where the journal is damaged, full or closed.
    """

    @property
    def last(self) -> int:
        """The number of the last event; 0 in an empty journal."""

    def append(self, entries: Sequence[Entry], *, durable: bool) -> int:
        """Writes all of the entries, or none.

        Args:
            entries: the events, in order; none of them changes nothing.
            durable: whether they survive a power cut from here on, and with them everything
                written before. Otherwise they survive the end of this process, and a power cut
                may take the latest of them, always from the end.

        Returns:
            The number of the last event.

        Raises:
            JournalError: nothing was appended; when the cause is gone, append again.
        """

    def read(self, after: int = 0) -> Iterator[Record]:
        """The events after a number, one by one, up to the last one when the reader gets there.

        Raises:
            JournalError: an event is missing or was edited; all before it are as written.
        """

    def save_snapshot(self, sequence: int, body: str) -> None:
        """Keeps what all events up to `sequence` amount to; only the newest few are kept."""

    def snapshot(self) -> Snapshot | None:
        """The newest snapshot that is intact, or None."""

    def close(self) -> None:
        """Lets go of the journal; closing twice is allowed."""

    def __enter__(self) -> Self:
        """The journal itself."""

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Closes it."""


def checked(entry: Entry) -> Entry:
    """The entry as it will be read back.

    Raises:
        JournalError: its time is not finite, or a text is no Unicode text.
    """
    at, kind, body = entry
    if not math.isfinite(at):
        raise JournalError(
            f"nothing was appended: an event of kind {kind!r} happened at {at}; "
            "expected a finite number of seconds"
        )
    try:
        kind.encode()
        body.encode()
    except UnicodeEncodeError as error:
        raise JournalError(
            f"nothing was appended: an event of kind {kind!r} at {at} s is no text: {error}"
        ) from error
    return Entry(at + 0.0, kind, body)  # an integer becomes a float, and minus zero becomes zero


def check_covered(sequence: int, last: int) -> None:
    """Refuses a snapshot of events that do not exist.

    Raises:
        JournalError: the number is not among 0 to `last`.
    """
    if not 0 <= sequence <= last:
        raise JournalError(
            f"a snapshot of the events up to {sequence} cannot be kept; "
            f"expected 0 to {last}, the last event"
        )
