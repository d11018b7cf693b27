"""The journal's file: who may open it, and what happens when the disk does not play along."""

import resource
import signal
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

import pytest

from depal.errors import JournalError
from depal.executive.journal import Entry, Record, Snapshot, SqliteJournal, storage
from depal.executive.journal.chain import GENESIS, link
from depal.executive.journal.lock import WriterLock

ONE = Entry(1.0, "fact", '{"a":1}')


def edit(path: Path, *statements: str) -> None:
    """Does to the file what no journal does."""
    with closing(sqlite3.connect(path, isolation_level=None)) as connection:
        for statement in statements:
            connection.execute(statement)


@contextmanager
def files_no_longer_than(size: int) -> Iterator[None]:
    """Writes beyond so many bytes fail, as on a full disk."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
        signal.signal(signal.SIGXFSZ, handler)


def test_events_and_snapshots_are_there_after_reopening(path: Path, events: list[Entry]) -> None:
    """And numbering goes on."""
    with SqliteJournal(path) as journal:
        journal.append(events, durable=False)
        journal.save_snapshot(20, "state")
    with SqliteJournal(path) as journal:
        assert journal.append([ONE], durable=True) == 31
        assert list(journal.read(after=30)) == [Record(31, *ONE)]
        assert journal.snapshot() == Snapshot(20, "state")
        assert journal.verify() == 31


def test_the_digest_of_an_event_is_what_the_chain_says() -> None:
    """Pinned: a change here makes every journal unreadable."""
    first = link(GENESIS, 1, 1.0, b"fact", b"{}")
    assert first.hex() == "838ba39005de7c69468e7b853fe54dae"
    assert link(first, 2, 1.0, b"fact", b"{}").hex() == "4b4657a21c93885c7b8a6c1fa9495f51"


def test_kind_and_body_do_not_run_into_each_other() -> None:
    """The length of the kind is part of the digest."""
    assert link(GENESIS, 1, 1.0, b"fact", b"s{}") != link(GENESIS, 1, 1.0, b"facts", b"{}")


def test_durable_appends_are_fully_synced_and_others_are_not(
    connections: list[sqlite3.Connection], path: Path
) -> None:
    """2 is FULL, 1 is NORMAL; each append has its own way."""
    with SqliteJournal(path) as journal:
        for durable in (False, True, True, False, True):
            journal.append([ONE], durable=durable)
            (level,) = connections[-1].execute("PRAGMA synchronous").fetchone()
            assert level == (2 if durable else 1)
        assert connections[-1].execute("PRAGMA journal_mode").fetchone() == (b"wal",)


def test_an_append_that_sqlite_refuses_in_the_middle_leaves_nothing(
    journal: SqliteJournal, path: Path
) -> None:
    """A trigger fails at the second of three events."""
    journal.append([ONE], durable=False)
    edit(
        path,
        "CREATE TRIGGER trap BEFORE INSERT ON events WHEN new.kind = 'bad' "
        "BEGIN SELECT RAISE(ABORT, 'sprung'); END",
    )
    with pytest.raises(JournalError, match=r"nothing was appended: it failed \(sprung\)"):
        journal.append([ONE, ONE._replace(kind="bad"), ONE], durable=True)
    assert journal.last == 1
    assert journal.append([ONE], durable=False) == 2
    assert journal.verify() == 2


def test_a_full_disk_appends_nothing_and_more_room_lets_it_go_on(
    connections: list[sqlite3.Connection], path: Path
) -> None:
    """The file may not grow for a while."""
    with SqliteJournal(path) as journal:
        journal.append([ONE], durable=False)
        connections[-1].execute("PRAGMA max_page_count = 1")
        with pytest.raises(JournalError, match="nothing was appended: the disk is full; make room"):
            journal.append([ONE._replace(body="x" * 100_000)], durable=True)
        with pytest.raises(JournalError, match="the snapshot was not kept: the disk is full"):
            journal.save_snapshot(1, "".join(map(chr, range(0x4E00, 0x9FFF))))
        assert (list(journal.read()), journal.snapshot()) == ([Record(1, *ONE)], None)
        connections[-1].execute("PRAGMA max_page_count = 1000000")
        assert journal.append([ONE._replace(body="x" * 100_000)], durable=True) == 2
        assert journal.verify() == 2


@pytest.mark.parametrize("durable", [False, True])
def test_a_write_that_fails_half_way_appends_nothing(
    journal: SqliteJournal, path: Path, events: list[Entry], *, durable: bool
) -> None:
    """The log beside the file cannot grow; a part of the append may stand in it already."""
    journal.append(events, durable=True)
    log = path.with_name(f"{path.name}-wal")
    with files_no_longer_than(log.stat().st_size + 6_000):
        for _ in range(2):
            with pytest.raises(JournalError, match="nothing was appended: the disk f"):
                journal.append([ONE._replace(body="x" * 20_000)] * 3, durable=durable)
    assert journal.last == len(events)
    assert journal.append([ONE], durable=durable) == len(events) + 1
    journal.close()
    with SqliteJournal(path) as again:
        assert again.verify() == len(events) + 1


def test_a_file_that_can_only_be_read_refuses_to_be_written(
    connections: list[sqlite3.Connection], path: Path
) -> None:
    """And nothing is appended."""
    with SqliteJournal(path) as journal:
        connections[-1].execute("PRAGMA query_only = ON")
        with pytest.raises(JournalError, match="nothing was appended: it can only be read"):
            journal.append([ONE], durable=False)
        connections[-1].execute("PRAGMA query_only = OFF")
        assert journal.append([ONE], durable=False) == 1


def test_a_program_that_holds_the_file_is_named_as_the_cause(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Someone looks at the file by hand and forgets a transaction."""
    monkeypatch.setattr(storage, "PATIENCE", 0.0)
    with (
        SqliteJournal(path) as journal,
        closing(sqlite3.connect(path, isolation_level=None)) as other,
    ):
        other.execute("BEGIN IMMEDIATE")
        with pytest.raises(JournalError, match="nothing was appended: another program holds it"):
            journal.append([ONE], durable=False)
        other.execute("ROLLBACK")
        assert journal.append([ONE], durable=False) == 1


def test_a_newer_version_is_refused_and_an_older_one_is_marked(path: Path) -> None:
    """From then on the older depal refuses it."""
    SqliteJournal(path, schema_version=1).close()
    SqliteJournal(path, schema_version=3).close()
    for readonly in (False, True):
        with pytest.raises(JournalError) as caught:
            SqliteJournal(path, schema_version=2, readonly=readonly)
        assert str(caught.value) == (
            f"{path}: written by a newer depal (version 3 of the journal, this one knows up to 2); "
            "install that depal, or name another file"
        )
    SqliteJournal(path, schema_version=3).close()


def test_a_reader_of_a_newer_depal_does_not_mark_the_file(path: Path) -> None:
    """It changes nothing at all."""
    SqliteJournal(path, schema_version=1).close()
    SqliteJournal(path, schema_version=2, readonly=True).close()
    SqliteJournal(path, schema_version=1).close()


@pytest.mark.parametrize("readonly", [False, True])
def test_what_is_no_journal_is_refused_and_left_as_it_was(path: Path, *, readonly: bool) -> None:
    """A text, another database, an empty file."""
    path.write_text("no database at all, " * 100)
    with pytest.raises(JournalError, match="it is not a journal; name another file"):
        SqliteJournal(path, readonly=readonly)
    assert path.read_text() == "no database at all, " * 100
    path.write_bytes(b"")
    with pytest.raises(JournalError, match="the file is empty, which no journal ever is"):
        SqliteJournal(path, readonly=readonly)
    path.unlink()
    edit(path, "CREATE TABLE events (sequence)")
    content = path.read_bytes()
    with pytest.raises(JournalError, match=r"not a journal \(application id 0x0, expected 0x6465"):
        SqliteJournal(path, readonly=readonly)
    assert path.read_bytes() == content


def test_a_journal_that_is_not_there_cannot_be_read(path: Path) -> None:
    """And is not made."""
    with pytest.raises(JournalError, match="there is no journal"):
        SqliteJournal(path, readonly=True)
    assert not path.exists()


def test_a_folder_that_is_not_there_is_named(path: Path) -> None:
    """The lock file comes first."""
    with pytest.raises(JournalError, match="cannot be locked for writing: No such file"):
        SqliteJournal(path / "journal")


def test_a_folder_is_no_journal(path: Path) -> None:
    """SQLite cannot open it."""
    path.mkdir()
    with pytest.raises(JournalError, match="it was not opened: it cannot be opened"):
        SqliteJournal(path)


def test_a_log_without_its_file_is_not_thrown_away(path: Path) -> None:
    """SQLite alone would begin anew and remove it."""
    log = path.with_name(f"{path.name}-wal")
    log.write_bytes(b"x" * 100)
    with pytest.raises(JournalError, match="the file is gone and its -wal file is left"):
        SqliteJournal(path)
    assert log.read_bytes() == b"x" * 100


def test_a_start_that_broke_off_leaves_no_half_journal(path: Path) -> None:
    """The draft of a crash is swept away."""
    path.with_name(f"{path.name}.new").write_bytes(b"half")
    path.with_name(f"{path.name}.new-journal").write_bytes(b"half")
    with SqliteJournal(path) as journal:
        assert journal.append([ONE], durable=False) == 1
    assert {file.name for file in path.parent.iterdir()} == {path.name, f"{path.name}.lock"}


def test_a_disk_that_is_full_at_the_start_leaves_no_half_journal(path: Path) -> None:
    """The second attempt succeeds."""
    with (
        files_no_longer_than(1_000),
        pytest.raises(JournalError, match="it was not opened: the disk"),
    ):
        SqliteJournal(path)
    assert not path.exists()
    with SqliteJournal(path) as journal:
        assert journal.append([ONE], durable=True) == 1


def test_only_the_newest_three_snapshots_are_kept(path: Path, events: list[Entry]) -> None:
    """One for use, two in case it is damaged."""
    with SqliteJournal(path) as journal:
        journal.append(events, durable=False)
        for sequence in range(0, 30, 5):
            journal.save_snapshot(sequence, "{}")
    with closing(sqlite3.connect(path)) as connection:
        kept = connection.execute("SELECT sequence FROM snapshots ORDER BY sequence").fetchall()
    assert kept == [(15,), (20,), (25,)]


def test_events_that_vanish_under_an_open_journal_are_missed(
    journal: SqliteJournal, path: Path, events: list[Entry]
) -> None:
    """The writer knows how many it wrote."""
    journal.append(events, durable=False)
    edit(path, "DELETE FROM events WHERE sequence > 25")
    records = journal.read()
    assert [next(records).sequence for _ in range(25)] == list(range(1, 26))
    with pytest.raises(JournalError, match="event 26 is missing"):
        next(records)
    with pytest.raises(JournalError, match="event 26 is missing"):
        next(journal.read(after=26))


def test_a_lock_on_a_full_disk_holds_without_a_name(path: Path) -> None:
    """The number of the process is only missing from the message."""
    with files_no_longer_than(0):
        lock = WriterLock(path)
    with pytest.raises(JournalError, match=r"another process \(\?\) writes this journal"):
        SqliteJournal(path)
    lock.release()
    SqliteJournal(path).close()
