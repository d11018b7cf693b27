"""Tables that follow a journal: each event counts once, wherever the process ends."""

import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.errors import JournalError
from depal.executive.journal import Entry, MemoryJournal, Projection, Record, SqliteJournal
from depal.executive.journal import projection as journal_projection


class Crash(Exception):  # noqa: N818 - an end, not an error
    """The process ends here."""


class Stock:
    """Counts what each event delivers; refuses one number on demand."""

    def __init__(self, connection: sqlite3.Connection) -> None:
        """Makes the table."""
        self.connection = connection
        self.refused = 0
        connection.execute("CREATE TABLE IF NOT EXISTS stock (item TEXT PRIMARY KEY, count INT)")

    def apply(self, connection: sqlite3.Connection, record: Record) -> None:
        """One more of the record's kind; trouble comes after the change."""
        connection.execute(
            "INSERT INTO stock VALUES (?, 1) ON CONFLICT (item) DO UPDATE SET count = count + 1",
            (record.kind,),
        )
        if record.sequence == self.refused:
            raise Crash

    @property
    def counts(self) -> dict[str, int]:
        """What is in stock."""
        return dict(self.connection.execute("SELECT item, count FROM stock").fetchall())


def delivery(count: int) -> MemoryJournal:
    """Tea at odd numbers, rice at even ones."""
    journal = MemoryJournal()
    journal.append(
        [Entry(0.0, "rice" if n % 2 else "tea", "{}") for n in range(count)], durable=False
    )
    return journal


@pytest.fixture
def connection() -> Iterator[sqlite3.Connection]:
    """A database in memory, opened as Python does by default."""
    with closing(sqlite3.connect(":memory:")) as connection:
        yield connection


def test_catching_up_twice_changes_nothing(connection: sqlite3.Connection) -> None:
    """And what comes later is added."""
    stock = Stock(connection)
    projection = Projection(connection, "stock", stock.apply)
    journal = delivery(5)
    assert (projection.last, projection.catch_up(MemoryJournal())) == (0, 0)
    assert [projection.catch_up(journal) for _ in range(2)] == [5, 5]
    assert stock.counts == {"tea": 3, "rice": 2}
    journal.append([Entry(0.0, "tea", "{}")], durable=False)
    assert projection.catch_up(journal) == projection.last == 6
    assert stock.counts == {"tea": 4, "rice": 2}


@given(count=st.integers(1, 12), batch=st.integers(1, 5), ends=st.lists(st.integers(1, 12)))
def test_a_projection_resumes_exactly_where_it_ended(
    count: int, batch: int, ends: list[int]
) -> None:
    """However often it ends, and wherever: the batch in hand is undone, those before it stay."""
    with (
        closing(sqlite3.connect(":memory:")) as connection,
        pytest.MonkeyPatch.context() as patch,
    ):
        patch.setattr(journal_projection, "BATCH", batch)
        journal, stock = delivery(count), Stock(connection)
        for stock.refused in ends:
            projection = Projection(connection, "stock", stock.apply)
            known = projection.last
            if known < stock.refused <= count:
                with pytest.raises(Crash):
                    projection.catch_up(journal)
                whole = (stock.refused - known - 1) // batch * batch
                assert projection.last == known + whole
            else:
                projection.catch_up(journal)
            assert sum(stock.counts.values()) == projection.last
        stock.refused = 0
        assert Projection(connection, "stock", stock.apply).catch_up(journal) == count
        assert stock.counts.get("tea", 0) == (count + 1) // 2
        assert stock.counts.get("rice", 0) == count // 2


def test_a_projection_resumes_in_another_process(tmp_path: Path) -> None:
    """Both files are closed in between."""
    for expected in (2, 4):
        with (
            SqliteJournal(tmp_path / "journal") as journal,
            closing(sqlite3.connect(tmp_path / "stock")) as connection,
        ):
            journal.append([Entry(0.0, "tea", "{}")] * 2, durable=False)
            stock = Stock(connection)
            assert Projection(connection, "stock", stock.apply).catch_up(journal) == expected
            assert stock.counts == {"tea": expected}


def test_projections_in_one_database_go_their_own_way(connection: sqlite3.Connection) -> None:
    """Each has its own number."""
    stock = Stock(connection)
    first = Projection(connection, "first", stock.apply)
    second = Projection(connection, "second", lambda _connection, _record: None)
    assert first.catch_up(delivery(3)) == 3
    assert second.last == 0
    assert second.catch_up(delivery(4)) == 4
    assert first.last == 3


def test_a_journal_that_ends_earlier_is_refused(connection: sqlite3.Connection) -> None:
    """It lost events, or it is another one."""
    stock = Stock(connection)
    projection = Projection(connection, "stock", stock.apply)
    projection.catch_up(delivery(5))
    with pytest.raises(JournalError) as caught:
        projection.catch_up(delivery(4))
    assert str(caught.value) == (
        "projection 'stock' knows event 5, and the journal ends at 4: it is another journal or it "
        "lost events; restore it, or build the projection anew"
    )
    assert sum(stock.counts.values()) == 5


@pytest.mark.parametrize("end", ["COMMIT", "ROLLBACK"])
def test_an_apply_that_ends_the_transaction_is_refused(
    connection: sqlite3.Connection, end: str
) -> None:
    """The number would not be stored with the change."""
    projection = Projection(connection, "stock", lambda connection, _: connection.execute(end))
    with pytest.raises(JournalError, match="apply ended the transaction at event 1; expected nei"):
        projection.catch_up(delivery(2))
    assert projection.last == 0


def test_an_open_transaction_of_the_consumer_is_left_alone(connection: sqlite3.Connection) -> None:
    """It would be committed with the batch, or lost with it."""
    stock = Stock(connection)
    projection = Projection(connection, "stock", stock.apply)
    connection.execute("INSERT INTO stock VALUES ('rice', 7)")
    for use in (
        lambda: projection.catch_up(delivery(2)),
        lambda: Projection(connection, "other", stock.apply),
    ):
        with pytest.raises(JournalError, match="a transaction is open on its database; commit it"):
            use()
    connection.commit()
    assert projection.catch_up(delivery(2)) == 2
    assert stock.counts == {"tea": 1, "rice": 8}


def test_two_hands_on_one_projection_do_not_apply_twice(tmp_path: Path) -> None:
    """The second finds out before it changes anything."""
    with (
        closing(sqlite3.connect(tmp_path / "stock")) as mine,
        closing(sqlite3.connect(tmp_path / "stock")) as other,
    ):
        stock = Stock(mine)
        projection = Projection(mine, "stock", stock.apply)
        journal = delivery(3)

        class Overtaken(MemoryJournal):
            def read(self, after: int = 0) -> Iterator[Record]:
                Projection(other, "stock", stock.apply).catch_up(journal)
                return journal.read(after)

        overtaken = Overtaken()
        overtaken.append([Entry(0.0, "tea", "{}")] * 3, durable=False)
        with pytest.raises(JournalError, match="moved from event 0 to 3 by another hand"):
            projection.catch_up(overtaken)
        assert stock.counts == {"tea": 2, "rice": 1}
