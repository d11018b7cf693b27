"""Nothing is ever read that was not written: after crashes, cuts, flipped bits and edits."""

import random
import shutil
import sqlite3
import subprocess
import sys
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest

from depal.errors import JournalError
from depal.executive.journal import Entry, Record, Snapshot, SqliteJournal
from depal.executive.journal import sqlite as journal_sqlite

WRITER = """
import sys
from pathlib import Path
from depal.executive.journal import Entry, SqliteJournal

with SqliteJournal(Path(sys.argv[1])) as journal:
    n = journal.last // 3
    while True:
        last = journal.append([Entry(n, "k", str(n))] * 3, durable=n % 5 == 0)
        if n % 7 == 0:
            journal.save_snapshot(last, str(n) * 100)
        n += 1
        print(last, flush=True)
"""


def fill(path: Path, events: list[Entry], *snapshots: int) -> list[Record]:
    """A closed journal of these events."""
    with SqliteJournal(path) as journal:
        journal.append(events, durable=False)
        for sequence in snapshots:
            journal.save_snapshot(sequence, f"state {sequence}")
        return list(journal.read())


def edit(path: Path, *statements: str) -> None:
    """Does to the file what no journal does."""
    with closing(sqlite3.connect(path, isolation_level=None)) as connection:
        for statement in statements:
            connection.execute(statement)


def open_error(path: Path) -> str:
    """What opening says."""
    with pytest.raises(JournalError) as caught:
        SqliteJournal(path)
    return str(caught.value)


def read_or_refuse(path: Path) -> list[Record] | None:
    """The events, or None where the journal refuses."""
    try:
        with SqliteJournal(path, readonly=True) as journal:
            records = list(journal.read())
            journal.snapshot()
            return records
    except JournalError:
        return None


def test_a_writer_killed_at_any_moment_leaves_whole_appends(path: Path) -> None:
    """At least all that it reported, and the next writer goes on at once."""
    moments = random.Random(7)  # noqa: S311 - no secret
    total = 0
    for _ in range(5):
        command = [sys.executable, "-c", WRITER, str(path)]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as writer:  # noqa: S603
            assert writer.stdout is not None
            for _ in range(moments.randint(1, 200)):
                reported = int(writer.stdout.readline())
            writer.kill()
        with SqliteJournal(path) as journal:
            total = journal.last
            assert total >= reported
            assert total % 3 == 0
            expected = [Record(n + 1, n // 3, "k", str(n // 3)) for n in range(total)]
            assert list(journal.read()) == expected
            assert journal.verify() == total
            snapshot = journal.snapshot()
            assert snapshot is not None
            assert snapshot.sequence % 21 == 3
    assert total >= 15


def test_a_log_cut_off_anywhere_leaves_whole_appends(
    path: Path, tmp_path: Path, events: list[Entry]
) -> None:
    """The longer the log, the more of them; a cut loses no more than the append it falls into."""
    cut = tmp_path / "cut"

    def survivors(log: bytes) -> list[Record]:
        shutil.copy(path, cut)
        cut.with_name("cut-wal").write_bytes(log)
        with SqliteJournal(cut) as copy:
            return list(copy.read())

    with SqliteJournal(path) as journal:
        parts = [events[start : start + 3] for start in range(0, 30, 3)]
        ends = [journal.append(part, durable=n % 2 == 0) for n, part in enumerate(parts)]
        written = list(journal.read())
        log = path.with_name(f"{path.name}-wal").read_bytes()
        found = [survivors(log[:size]) for size in [*range(0, len(log), 1511), len(log)]]
    lengths = [len(records) for records in found]
    assert set(lengths) == {0, *ends}
    assert lengths == sorted(lengths)
    assert all(records == written[: len(records)] for records in found)


def test_every_flipped_bit_of_a_body_is_noticed(path: Path, events: list[Entry]) -> None:
    """Also by a reader that starts far from the event's beginning."""
    fill(path, events)
    content = path.read_bytes()
    body = events[17].body.encode()
    start = content.index(body)
    assert content.count(body) == 1
    for position in range(start, start + len(body)):
        flipped = bytearray(content)
        flipped[position] ^= 1 << position % 8
        path.write_bytes(flipped)
        assert open_error(path).startswith(
            f"{path}: event 18 is not as it was written (the events up to 17 hold); keep the files"
        )


def test_a_flipped_bit_anywhere_is_noticed_or_harmless(path: Path, events: list[Entry]) -> None:
    """Hundreds of places all over the file; never a record that differs, never a lost one."""
    written = fill(path, events, 10, 20)
    content = path.read_bytes()
    places = random.Random(11)  # noqa: S311 - no secret
    noticed = 0
    for _ in range(500):
        flipped = bytearray(content)
        flipped[places.randrange(len(content))] ^= 1 << places.randrange(8)
        path.write_bytes(flipped)
        records = read_or_refuse(path)
        assert records in (None, written)
        noticed += records is None
    assert noticed > 20


@pytest.mark.parametrize(
    ("statement", "message"),
    [
        ("DELETE FROM events WHERE sequence = 7", "event 7 is missing (the events up to 6 hold)"),
        ("DELETE FROM events WHERE sequence > 25", "event 26 is missing; there were 30"),
        ("DELETE FROM events", "event 1 is missing; there were 30 (no event before it)"),
        ("UPDATE events SET at = 99 WHERE sequence = 1", "event 1 is not as it was written"),
        ("UPDATE events SET kind = 'K' WHERE sequence = 30", "event 30 is not as it was written"),
        ("UPDATE events SET body = 'b' WHERE sequence = 9", "event 9 is not as it was written"),
        ("UPDATE events SET digest = x'00' WHERE sequence = 9", "event 9 is not as it was written"),
        ("UPDATE events SET sequence = 40 WHERE sequence = 30", "event 30 is missing"),
        ("INSERT INTO events VALUES (31, 1, 'k', '', x'00')", "event 31 is not as it was written"),
        (
            "DROP TABLE events",
            "it is not laid out as a journal; name another file (no such table: ev",
        ),
    ],
)
def test_an_edit_is_refused_with_the_number_of_the_event(
    path: Path, events: list[Entry], statement: str, message: str
) -> None:
    """Gaps, losses from the end, changes of any part, additions."""
    fill(path, events)
    edit(path, statement)
    assert message in open_error(path)


def test_an_edit_says_what_to_do(path: Path, events: list[Entry]) -> None:
    """The whole message, once."""
    fill(path, events)
    edit(path, "UPDATE events SET body = 'b' WHERE sequence = 9")
    assert open_error(path) == (
        f"{path}: event 9 is not as it was written (the events up to 8 hold); keep the files for "
        "study, restore the latest backup or begin a new journal, and look at the world again "
        "before anything moves"
    )


@pytest.mark.parametrize(
    "use",
    [lambda journal: list(journal.read()), lambda journal: journal.verify()],
    ids=["read", "verify"],
)
def test_an_edit_long_before_the_end_is_found_where_it_is_read(
    path: Path, events: list[Entry], use: Callable[[SqliteJournal], object]
) -> None:
    """Opening checks what follows the snapshot; what was read before the edit is as written."""
    written = fill(path, events, 20)
    edit(path, "UPDATE events SET body = 'b' WHERE sequence = 9")
    with SqliteJournal(path) as journal:
        with pytest.raises(JournalError, match="event 9 is not as it was written"):
            use(journal)
        records = journal.read()
        assert [next(records) for _ in range(8)] == written[:8]
        assert list(journal.read(after=9)) == written[9:]


def test_opening_checks_no_more_than_the_last_thousand(
    path: Path, events: list[Entry], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without a snapshot a long journal opens as fast as with one."""
    monkeypatch.setattr(journal_sqlite, "TAIL", 10)
    fill(path, events)
    edit(path, "UPDATE events SET body = 'b' WHERE sequence = 19")
    SqliteJournal(path).close()
    edit(path, "UPDATE events SET body = 'b' WHERE sequence = 21")
    assert "event 21 is not as it was written" in open_error(path)


def without_checks(path: Path, statement: str) -> None:
    """Puts into the file what its tables forbid, as a flipped bit can."""
    with closing(sqlite3.connect(path, isolation_level=None)) as connection:
        connection.execute("PRAGMA writable_schema = ON")
        connection.execute("UPDATE sqlite_schema SET sql = replace(sql, ' NOT NULL', '')")
    edit(path, statement)


def test_a_value_that_vanished_is_noticed(path: Path, events: list[Entry]) -> None:
    """In an event, in a snapshot."""
    written = fill(path, events, 10)
    without_checks(path, "UPDATE snapshots SET body = NULL")
    with SqliteJournal(path) as journal:
        assert journal.snapshot() is None
        assert list(journal.read()) == written
    edit(path, "UPDATE events SET body = NULL WHERE sequence = 9")
    assert "event 9 is not an event any more" in open_error(path)


def test_a_damaged_snapshot_gives_way_to_the_one_before(path: Path, events: list[Entry]) -> None:
    """With the last one gone, the events are folded from the start."""
    written = fill(path, events, 10, 20, 25)
    for damage, expected in (
        ("UPDATE snapshots SET body = x'00' WHERE sequence = 25", Snapshot(20, "state 20")),
        ("UPDATE snapshots SET digest = x'00' WHERE sequence = 20", Snapshot(10, "state 10")),
        ("UPDATE snapshots SET sequence = 11 WHERE sequence = 10", None),
        ("UPDATE snapshots SET sequence = 99 WHERE sequence = 11", None),
        ("UPDATE snapshots SET sequence = -1 WHERE sequence = 99", None),
    ):
        edit(path, damage)
        with SqliteJournal(path) as journal:
            assert journal.snapshot() == expected
            assert list(journal.read()) == written


@pytest.mark.parametrize("pages", [1, 2, 3])
def test_a_file_that_was_cut_off_is_refused(path: Path, events: list[Entry], pages: int) -> None:
    """At the end of a page and in the middle of one."""
    fill(path, events * 10)
    content = path.read_bytes()
    for size in (pages * 4096, pages * 4096 + 100):
        path.write_bytes(content[:size])
        assert "the file is damaged or was cut off; keep the files" in open_error(path)


def test_verify_finds_damage_beside_the_events(path: Path, events: list[Entry]) -> None:
    """The events can still be saved to a new journal."""
    written = fill(path, events, 30)
    edit(path, "PRAGMA ignore_check_constraints = ON", "CREATE INDEX beside ON snapshots (body)")
    with closing(sqlite3.connect(path, isolation_level=None)) as connection:
        connection.execute("PRAGMA writable_schema = ON")
        connection.execute("DELETE FROM sqlite_schema WHERE name = 'beside'")
    with SqliteJournal(path) as journal:
        assert list(journal.read()) == written
        with pytest.raises(JournalError, match="every event is as it was written, but the file is"):
            journal.verify()
