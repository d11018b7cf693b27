"""A journal in a file of SQLite, with a write-ahead log."""

import sqlite3
import zlib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from depal.closing import Closing
from depal.errors import JournalError
from depal.executive.journal.chain import GENESIS, damaged, forge, seal, sealed, walk
from depal.executive.journal.lock import WriterLock
from depal.executive.journal.records import Entry, Record, Snapshot, check_covered, checked
from depal.executive.journal.storage import connect, explain

PAGE = 1000
"""How many events are fetched at a time."""

TAIL = 1000
"""How many events at the end are checked when a journal is opened, at the most."""

KEPT = 3
"""How many snapshots are kept."""

_INSERT = "INSERT INTO events (sequence, at, kind, body, digest) VALUES (?, ?, ?, ?, ?)"
_SELECT = (
    "SELECT sequence, at, kind, body, digest FROM events "
    "WHERE sequence > ? ORDER BY sequence LIMIT ?"
)


class SqliteJournal(Closing):
    """A journal that outlives the process and, where asked, a power cut.

    One writer, any number of readers at the same time. Used by the thread that opened it.
    """

    def __init__(self, path: Path, *, schema_version: int = 1, readonly: bool = False) -> None:
        """Opens the journal and checks its end; a writer makes it where there is none.

        Args:
            path: the file.
            schema_version: the newest version of the events that the caller understands; a
                writer marks the file with it.
            readonly: whether it is opened for reading only, beside a writer or after it.

        Raises:
            JournalError: it is no journal, is damaged, was written by a newer depal, or somebody
                else writes it.
        """
        self._path = path.resolve()
        self._durable = False
        self._head: tuple[int, bytes] | None = None
        self._connection: sqlite3.Connection | None = None
        self._lock = None if readonly else WriterLock(self._path)
        try:
            with self._explained("it was not opened"):
                self._connection = connect(self._path, schema_version, readonly=readonly)
                self._check_end()
                if not readonly:
                    self._mark(schema_version)
        except BaseException:
            self.close()
            raise

    @property
    def last(self) -> int:
        """The number of the last event; 0 in an empty journal."""
        with self._explained():
            return self._load_head()[0]

    def append(self, entries: Sequence[Entry], *, durable: bool) -> int:
        """Writes all of the entries, or none: one transaction. See `Journal.append`."""
        self._check_writable()
        fresh = [checked(entry) for entry in entries]
        with self._explained("nothing was appended"):
            last, digest = self._load_head()
            if not fresh:
                return last
            rows = forge(digest, last, fresh)
            self._set_durable(durable=durable)
            with self._transaction() as connection:
                connection.executemany(_INSERT, rows)
        self._head = rows[-1][0], rows[-1][4]
        return rows[-1][0]

    def read(self, after: int = 0) -> Iterator[Record]:
        """The events after a number, one by one, each checked. See `Journal.read`."""
        position = max(after, 0)
        while position < self.last:
            with self._explained(f"reading stopped after event {position}"):
                digest = self._digest(position)
                rows = self._open().execute(_SELECT, (position, PAGE)).fetchall()
            if not rows:
                raise damaged(str(self._path), position + 1, "is missing")
            yield from walk(str(self._path), digest, position, rows)
            position = rows[-1][0]

    def save_snapshot(self, sequence: int, body: str) -> None:
        """Keeps what all events up to `sequence` amount to, and the two snapshots before it.

        A power cut may take it, as it may take the latest events; never the events without it.
        """
        self._check_writable()
        check_covered(sequence, self.last)
        with self._explained("the snapshot was not kept"):
            packed = zlib.compress(body.encode(), 1)
            digest = seal(self._digest(sequence), sequence, packed)
            with self._transaction() as connection:
                connection.execute(
                    "INSERT OR REPLACE INTO snapshots VALUES (?, ?, ?)", (sequence, packed, digest)
                )
                connection.execute(
                    "DELETE FROM snapshots WHERE sequence NOT IN "
                    "(SELECT sequence FROM snapshots ORDER BY sequence DESC LIMIT ?)",
                    (KEPT,),
                )

    def snapshot(self) -> Snapshot | None:
        """The newest snapshot that is intact, or None."""
        with self._explained("the snapshots cannot be read"):
            for sequence, packed in self._snapshots():
                return Snapshot(sequence, zlib.decompress(packed).decode())
        return None

    def verify(self) -> int:
        """Checks the file and every event in it, from the first to the last.

        Returns:
            How many events there are.

        Raises:
            JournalError: the first event that is missing or was edited.
        """
        with self._explained("the check stopped"):
            for record in self.read():
                del record
            self._check_count()
            (verdict,) = self._open().execute("PRAGMA integrity_check(1)").fetchone()
            if verdict != b"ok":
                raise JournalError(
                    f"{self._path}: every event is as it was written, but the file is damaged: "
                    f"{verdict.decode(errors='replace')}; copy the events to a new journal"
                )
            return self.last

    def close(self) -> None:
        """Lets go of the file and of the right to write it; closing twice is allowed."""
        try:
            if self._connection is not None:
                self._connection.close()
        finally:
            self._connection = None
            if self._lock is not None:
                self._lock.release()

    def _open(self) -> sqlite3.Connection:
        if self._connection is None:
            raise JournalError(f"{self._path}: the journal is closed")
        return self._connection

    def _check_writable(self) -> None:
        self._open()
        if self._lock is None:
            raise JournalError(f"{self._path}: nothing was written: it is open for reading only")

    @contextmanager
    def _explained(self, what: str = "") -> Iterator[None]:
        """Says what an error of SQLite or of the disk means."""
        try:
            yield
        except sqlite3.Error as error:
            raise explain(self._path, error, what) from error
        except (OSError, zlib.error, UnicodeError) as error:
            raise JournalError(f"{self._path}: {what}: {error}") from error

    @contextmanager
    def _transaction(self) -> Iterator[sqlite3.Connection]:
        """All or nothing, whatever goes wrong inside; afterwards the end is looked up anew."""
        connection = self._open()
        self._head = None
        try:
            connection.execute("BEGIN IMMEDIATE")
            yield connection
            connection.execute("COMMIT")
        except BaseException:
            if connection.in_transaction:
                connection.execute("ROLLBACK")
            raise

    def _set_durable(self, *, durable: bool) -> None:
        """Chooses how the next commits are synced; between transactions it takes effect."""
        if durable != self._durable:
            self._open().execute(f"PRAGMA synchronous = {'FULL' if durable else 'NORMAL'}")
            self._durable = durable

    def _load_head(self) -> tuple[int, bytes]:
        """The number and the digest of the last event; only a writer may remember them."""
        connection = self._open()
        if self._head is not None:
            return self._head
        query = "SELECT sequence, digest FROM events ORDER BY sequence DESC LIMIT 1"
        head: tuple[int, bytes] = connection.execute(query).fetchone() or (0, GENESIS)
        if self._lock is not None:
            self._head = head
        return head

    def _digest(self, sequence: int) -> bytes:
        """The digest of one event."""
        if sequence == 0:
            return GENESIS
        query = "SELECT digest FROM events WHERE sequence = ?"
        row: tuple[bytes] | None = self._open().execute(query, (sequence,)).fetchone()
        if row is None:
            raise damaged(str(self._path), sequence, "is missing")
        return row[0]

    def _snapshots(self) -> Iterator[tuple[int, bytes]]:
        """The intact snapshots, the newest first, still compressed."""
        last = self.last
        query = "SELECT sequence, body, digest FROM snapshots ORDER BY sequence DESC"
        for sequence, packed, found in self._open().execute(query).fetchall():
            if 0 <= sequence <= last and sealed(self._digest(sequence), sequence, packed, found):
                yield sequence, packed

    def _check_count(self) -> None:
        """Refuses a journal that lost events from its end."""
        query = "SELECT seq FROM sqlite_sequence WHERE name = 'events'"
        (counted,) = self._open().execute(query).fetchone() or (0,)
        last = self.last
        if last < counted:
            raise damaged(str(self._path), last + 1, f"is missing; there were {counted}")

    def _check_end(self) -> None:
        """Checks the events after the newest snapshot, at the most `TAIL` of them."""
        self._check_count()
        covered, _ = next(self._snapshots(), (0, b""))
        after = max(covered, self.last - TAIL)
        for record in self.read(after=after):
            del record

    def _mark(self, version: int) -> None:
        """From here on the file may hold events of this version."""
        connection = self._open()
        if connection.execute("PRAGMA user_version").fetchone() != (version,):
            with self._transaction():
                connection.execute(f"PRAGMA user_version = {version:d}")
