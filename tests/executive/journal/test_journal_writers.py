"""One writer at a time, and any number of readers beside it."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from depal.errors import JournalError
from depal.executive.journal import Entry, SqliteJournal

ONE = Entry(1.0, "fact", '{"a":1}')


def test_a_second_writer_is_refused_and_readers_are_not(
    journal: SqliteJournal, path: Path, events: list[Entry]
) -> None:
    """The reader sees what has been appended, also later."""
    with SqliteJournal(path, readonly=True) as reader:
        journal.append(events, durable=False)
        assert list(reader.read()) == list(journal.read())
        with pytest.raises(JournalError) as caught:
            SqliteJournal(path)
        assert str(caught.value) == (
            f"{path}: another process ({os.getpid()}) writes this journal already; "
            "stop it, or open the journal with readonly=True"
        )
        assert journal.append([ONE], durable=False) == reader.last == 31
    journal.close()
    SqliteJournal(path).close()


def test_a_second_writer_in_another_process_is_refused(journal: SqliteJournal, path: Path) -> None:
    """By any name of the file."""
    assert journal.last == 0
    other = path.with_name("link")
    other.symlink_to(path)
    code = (
        "import sys; from pathlib import Path; from depal.executive.journal import SqliteJournal\n"
        "SqliteJournal(Path(sys.argv[1]))"
    )
    command = [sys.executable, "-c", code, str(other)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)  # noqa: S603
    assert done.returncode == 1
    assert (
        f"JournalError: {path}: another process ({os.getpid()}) writes this journal already"
        in done.stderr
    )


def test_a_journal_open_for_reading_refuses_to_write(path: Path) -> None:
    """Also where nobody writes it."""
    SqliteJournal(path).close()
    with SqliteJournal(path, readonly=True) as reader:
        with pytest.raises(JournalError, match="nothing was written: it is open for reading only"):
            reader.append([ONE], durable=False)
        with pytest.raises(JournalError, match="nothing was written: it is open for reading only"):
            reader.save_snapshot(0, "")
        assert (reader.last, reader.verify()) == (0, 0)
