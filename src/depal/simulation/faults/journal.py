"""A disk that takes nothing any more."""

from collections.abc import Iterator, Sequence

from depal.closing import Closing
from depal.errors import JournalError
from depal.executive.journal import Entry, Journal, Record, Snapshot
from depal.simulation.faults.catalogue import Phase
from depal.simulation.faults.chances import Chances

FULL = "nothing was written: the disk is full; make room"


class FaultyJournal(Closing):
    """C3 of the executive's journal: the disk is full until a person has made room."""

    def __init__(self, journal: Journal, chances: Chances) -> None:
        """A journal on a disk that may be full."""
        self._journal, self._chances = journal, chances

    @property
    def last(self) -> int:
        """The number of the last event."""
        return self._journal.last

    def append(self, entries: Sequence[Entry], *, durable: bool) -> int:
        """Writes all of the entries, or none.

        Raises:
            JournalError: the disk is full.
        """
        refuse(self._chances)
        return self._journal.append(entries, durable=durable)

    def read(self, after: int = 0) -> Iterator[Record]:
        """The events after a number."""
        return self._journal.read(after)

    def save_snapshot(self, sequence: int, body: str) -> None:
        """Keeps what all events up to `sequence` amount to."""
        self._journal.save_snapshot(sequence, body)

    def snapshot(self) -> Snapshot | None:
        """The newest snapshot, or None."""
        return self._journal.snapshot()

    def close(self) -> None:
        """Lets go of the journal."""
        self._journal.close()


def refuse(chances: Chances) -> None:
    """A chance for a write to fail.

    Raises:
        JournalError: the disk is full.
    """
    if chances.lasts("C3", Phase.WRITE) is not None:
        raise JournalError(FULL)
