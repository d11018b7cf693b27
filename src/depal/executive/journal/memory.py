"""A journal that is forgotten with the process: for tests and studies."""

from collections.abc import Iterator, Sequence

from depal.closing import Closing
from depal.errors import JournalError
from depal.executive.journal.records import Entry, Record, Snapshot, check_covered, checked


class MemoryJournal(Closing):
    """Behaves as `SqliteJournal` does, without a file."""

    def __init__(self) -> None:
        """An empty journal."""
        self._records: list[Record] = []
        self._snapshots: dict[int, str] = {}
        self._commits: list[int] = []
        self._closed = False

    @property
    def records(self) -> tuple[Record, ...]:
        """All events."""
        return tuple(self._records)

    @property
    def commits(self) -> tuple[int, ...]:
        """The last number of each append: where a crash can leave a journal."""
        return tuple(self._commits)

    @property
    def last(self) -> int:
        """The number of the last event; 0 in an empty journal."""
        self._check_open()
        return len(self._records)

    def append(self, entries: Sequence[Entry], *, durable: bool) -> int:
        """Keeps all of the entries, or none; `durable` makes no difference here."""
        del durable
        first = self.last + 1
        fresh = [Record(sequence, *checked(entry)) for sequence, entry in enumerate(entries, first)]
        if fresh:
            self._records += fresh
            self._commits.append(len(self._records))
        return len(self._records)

    def read(self, after: int = 0) -> Iterator[Record]:
        """The events after a number, one by one, up to the last one when the reader gets there."""
        position = max(after, 0)
        while position < self.last:
            yield self._records[position]
            position += 1

    def save_snapshot(self, sequence: int, body: str) -> None:
        """Keeps what all events up to `sequence` amount to."""
        check_covered(sequence, self.last)
        self._snapshots[sequence] = body

    def snapshot(self) -> Snapshot | None:
        """The newest snapshot, or None."""
        self._check_open()
        newest = max(self._snapshots, default=None)
        return None if newest is None else Snapshot(newest, self._snapshots[newest])

    def cut(self, sequence: int) -> "MemoryJournal":
        """A copy as it was after that event, the snapshots included.

        Args:
            sequence: 0 to `last`; a real crash leaves one of 0 and `commits`.

        Raises:
            JournalError: there is no such event.
        """
        if not 0 <= sequence <= len(self._records):
            raise JournalError(
                f"the journal cannot be cut after event {sequence}; "
                f"expected 0 to {len(self._records)}"
            )
        copy = MemoryJournal()
        copy._records = self._records[:sequence]
        copy._snapshots = {n: body for n, body in self._snapshots.items() if n <= sequence}
        copy._commits = [n for n in self._commits if n <= sequence]
        return copy

    def close(self) -> None:
        """Lets go of the journal; `records`, `commits` and `cut` stay."""
        self._closed = True

    def _check_open(self) -> None:
        if self._closed:
            raise JournalError("the journal is closed")
