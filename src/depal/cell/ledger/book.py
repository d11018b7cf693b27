"""The ledger on disk: its last page, replaced as a whole and synced before anything moves."""

import sqlite3
from pathlib import Path

import msgspec

from depal.cell.ledger.page import Page
from depal.closing import Closing
from depal.errors import JournalError

LAYOUT = 1
"""Of the pages that this depal writes."""


class Ledger(Closing):
    """The last page of a run, in a file of its own."""

    def __init__(self, path: Path) -> None:
        """Opens it; an absent file is an empty ledger.

        Raises:
            JournalError: the file cannot be used.
        """
        self._path = path
        self._encoder = msgspec.json.Encoder()
        try:
            self._connection = sqlite3.connect(path, isolation_level=None)
            self._connection.execute("PRAGMA journal_mode = WAL")
            self._connection.execute("PRAGMA synchronous = FULL")
            self._connection.execute(
                "CREATE TABLE IF NOT EXISTS page "
                "(id INTEGER PRIMARY KEY CHECK (id = 1), layout INTEGER, body BLOB)"
            )
        except sqlite3.Error as error:
            raise JournalError(f"{path}: the ledger cannot be opened: {error}") from error

    def write(self, page: Page) -> None:
        """Replaces the page; it is on the disk when this returns.

        Raises:
            JournalError: it could not be written; nothing may move.
        """
        body = self._encoder.encode(page)
        try:
            self._connection.execute("INSERT OR REPLACE INTO page VALUES (1, ?, ?)", (LAYOUT, body))
        except sqlite3.Error as error:
            raise JournalError(f"{self._path}: the ledger was not written: {error}") from error

    def read(self) -> Page:
        """The last page; an empty one where none was written.

        Raises:
            JournalError: it was written by another version, or is damaged.
        """
        try:
            row = self._connection.execute("SELECT layout, body FROM page").fetchone()
            if row is None:
                return Page()
            if row[0] != LAYOUT:
                raise JournalError(
                    f"{self._path}: the ledger has layout {row[0]}; expected {LAYOUT}"
                )
            return msgspec.json.decode(row[1], type=Page)
        except (sqlite3.Error, msgspec.MsgspecError) as error:
            raise JournalError(f"{self._path}: the ledger cannot be read: {error}") from error

    def close(self) -> None:
        """Lets go of the file."""
        self._connection.close()
