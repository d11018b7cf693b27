"""The file of a journal: how it is made, recognised and opened, and what its errors mean."""

import os
import sqlite3
from pathlib import Path

from depal.errors import JournalError
from depal.executive.journal.chain import REMEDY

APPLICATION = int.from_bytes(b"depJ")
"""What marks a SQLite file as a journal."""

PATIENCE = 1.0
"""How long a foreign hand on the file is waited for [s]."""

# AUTOINCREMENT keeps the highest number beside the table: events lost from the end show.
_EVENTS = (
    "CREATE TABLE events (sequence INTEGER PRIMARY KEY AUTOINCREMENT, at REAL NOT NULL, "
    "kind TEXT NOT NULL, body TEXT NOT NULL, digest BLOB NOT NULL) STRICT"
)
_SNAPSHOTS = (
    "CREATE TABLE snapshots (sequence INTEGER PRIMARY KEY, body BLOB NOT NULL, "
    "digest BLOB NOT NULL) STRICT"
)

_MEANING = {
    "SQLITE_FULL": "the disk is full; make room and try again",
    "SQLITE_READONLY": "it can only be read; expected a file and a folder that can be written",
    "SQLITE_IOERR": "the disk failed to read or write; check the disk, then try again",
    "SQLITE_BUSY": "another program holds it; close that program and try again",
    "SQLITE_LOCKED": "another program holds it; close that program and try again",
    "SQLITE_CANTOPEN": "it cannot be opened; expected a file that exists and can be read",
    "SQLITE_CORRUPT": f"the file is damaged or was cut off; {REMEDY}",
    "SQLITE_ERROR": "it is not laid out as a journal; name another file",
    "SQLITE_NOTADB": "it is not a journal; name another file",
}


def explain(path: Path, error: sqlite3.Error, what: str = "") -> JournalError:
    """What an error of SQLite means for a journal.

    Args:
        path: the journal's file.
        error: what SQLite said.
        what: what became of the work, as in "nothing was appended".
    """
    code = getattr(error, "sqlite_errorname", None) or ""
    meaning = next((text for name, text in _MEANING.items() if code.startswith(name)), "")
    outcome = f"{what}: " if what else ""
    return JournalError(f"{path}: {outcome}{meaning or 'it failed'} ({error})")


def create(path: Path, version: int) -> None:
    """Makes an empty journal, in one step: a crash leaves all of it, or nothing.

    Args:
        path: the file, which does not exist yet.
        version: what to mark it with.
    """
    draft = path.with_name(f"{path.name}.new")
    for leftover in (draft, draft.with_name(f"{draft.name}-journal")):
        leftover.unlink(missing_ok=True)
    connection = sqlite3.connect(draft, isolation_level=None)
    try:
        connection.execute("BEGIN IMMEDIATE")
        connection.execute(_EVENTS)
        connection.execute(_SNAPSHOTS)
        connection.execute(f"PRAGMA application_id = {APPLICATION}")
        connection.execute(f"PRAGMA user_version = {version:d}")
        connection.execute("COMMIT")
        connection.execute("PRAGMA journal_mode = WAL")
    finally:
        connection.close()
    draft.rename(path)
    folder = os.open(path.parent, os.O_RDONLY)
    try:
        os.fsync(folder)
    finally:
        os.close(folder)


def connect(path: Path, version: int, *, readonly: bool) -> sqlite3.Connection:
    """Opens a journal that is one, of a version that is known.

    Texts come back as bytes: what is damaged may be no text.

    Args:
        path: the file; a writer makes it where there is none.
        version: the newest version that the caller understands.
        readonly: whether it is opened for reading only.

    Raises:
        JournalError: it is no journal, is damaged or was written by a newer version.
        sqlite3.Error: SQLite cannot work with it.
        OSError: it cannot be made.
    """
    if not path.exists():
        if readonly:
            raise JournalError(f"{path}: there is no journal")
        if _log(path):
            raise JournalError(f"{path}: the file is gone and its -wal file is left; {REMEDY}")
        create(path, version)
    if path.stat().st_size == 0:  # SQLite would take it for new and throw the -wal file away
        raise JournalError(f"{path}: the file is empty, which no journal ever is; {REMEDY}")
    address = f"{path.as_uri()}?mode={'ro' if readonly else 'rw'}"
    connection = sqlite3.connect(address, uri=True, timeout=PATIENCE, isolation_level=None)
    try:
        connection.text_factory = bytes
        _recognise(connection, path, version)
        if not readonly:
            connection.execute("PRAGMA synchronous = NORMAL")
    except BaseException:
        connection.close()
        raise
    return connection


def _log(path: Path) -> bool:
    """Whether there are events beside the file that did not reach it yet."""
    log = path.with_name(f"{path.name}-wal")
    return log.exists() and log.stat().st_size > 0


def _recognise(connection: sqlite3.Connection, path: Path, version: int) -> None:
    """Refuses what is no journal, and what a newer depal wrote."""
    (application,) = connection.execute("PRAGMA application_id").fetchone()
    (found,) = connection.execute("PRAGMA user_version").fetchone()
    if application != APPLICATION:
        raise JournalError(
            f"{path}: it is not a journal (application id {application:#x}, "
            f"expected {APPLICATION:#x}); name another file"
        )
    if found > version:
        raise JournalError(
            f"{path}: written by a newer depal (version {found} of the journal, this one knows "
            f"up to {version}); install that depal, or name another file"
        )
