"""Tables that follow a journal: stock, served requests, what has been sent to the store's system.

A projection stores the number of the last event that it knows in the same transaction as what the
event changed. So each event changes its table exactly once, wherever the process ends.
"""

import sqlite3
from collections.abc import Callable
from itertools import islice

from depal.errors import JournalError
from depal.executive.journal.records import Journal, Record

Apply = Callable[[sqlite3.Connection, Record], None]

BATCH = 1000
"""How many events share a transaction, at the most."""

_STORE = (
    "INSERT INTO projections (name, last) VALUES (?, ?) "
    "ON CONFLICT (name) DO UPDATE SET last = excluded.last"
)


class Projection:
    """One consumer of a journal, with tables of its own in a database of its own."""

    def __init__(self, connection: sqlite3.Connection, name: str, apply: Apply) -> None:
        """Adds the table `projections` to the database where it is missing.

        Args:
            connection: the consumer's database.
            name: the consumer; several may share a database.
            apply: makes the changes of one event; it neither commits nor rolls back.
        """
        self._connection = connection
        self._name = name
        self._apply = apply
        self._require_no_transaction()
        connection.execute(
            "CREATE TABLE IF NOT EXISTS projections (name TEXT PRIMARY KEY, last INTEGER NOT NULL)"
        )

    @property
    def last(self) -> int:
        """The number of the last event that was applied; 0 where none was."""
        query = "SELECT last FROM projections WHERE name = ?"
        row: tuple[int] | None = self._connection.execute(query, (self._name,)).fetchone()
        return row[0] if row else 0

    def catch_up(self, journal: Journal) -> int:
        """Applies the events that it does not know yet, in batches.

        Whatever `apply` or the journal raises is passed on: the batch is rolled back, the batches
        before it stay.

        Args:
            journal: where the events are read.

        Returns:
            The number of the last event that was applied.

        Raises:
            JournalError: the journal ends before what was applied, or a transaction is not where
                it should be.
        """
        self._require_no_transaction()
        known, last = self.last, journal.last
        if known > last:
            raise JournalError(
                f"projection {self._name!r} knows event {known}, and the journal ends at {last}: "
                "it is another journal or it lost events; restore it, or build the projection anew"
            )
        records = journal.read(after=known)
        while batch := list(islice(records, BATCH)):
            known = self._apply_batch(known, batch)
        return known

    def _apply_batch(self, known: int, batch: list[Record]) -> int:
        """Applies some events in one transaction."""
        connection = self._connection
        connection.execute("BEGIN IMMEDIATE")
        try:
            self._require_unmoved(known)
            for record in batch:
                self._apply(connection, record)
                self._require_transaction(record)
            connection.execute(_STORE, (self._name, batch[-1].sequence))
            connection.execute("COMMIT")
        except BaseException:
            if connection.in_transaction:
                connection.execute("ROLLBACK")
            raise
        return batch[-1].sequence

    def _require_no_transaction(self) -> None:
        if self._connection.in_transaction:
            raise JournalError(
                f"projection {self._name!r}: a transaction is open on its database; "
                "commit it or roll it back first"
            )

    def _require_transaction(self, record: Record) -> None:
        if not self._connection.in_transaction:
            raise JournalError(
                f"projection {self._name!r}: apply ended the transaction at event "
                f"{record.sequence}; expected neither commit, rollback nor executescript"
            )

    def _require_unmoved(self, known: int) -> None:
        if self.last != known:
            raise JournalError(
                f"projection {self._name!r} moved from event {known} to {self.last} by another "
                "hand; catch up again"
            )
