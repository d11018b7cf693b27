"""What holds for every journal, in a file or in memory."""

import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import overload

import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.errors import JournalError
from depal.executive.journal import (
    Entry,
    Journal,
    MemoryJournal,
    Record,
    Snapshot,
    SqliteJournal,
    sqlite,
)

Opener = Callable[[], Iterator[Journal]]


@contextmanager
def in_a_file() -> Iterator[Journal]:
    """A journal in a folder of its own."""
    with (
        tempfile.TemporaryDirectory() as folder,
        SqliteJournal(Path(folder) / "journal") as journal,
    ):
        yield journal


OPENERS = [pytest.param(in_a_file, id="sqlite"), pytest.param(MemoryJournal, id="memory")]
both = pytest.mark.parametrize("opened", OPENERS)

texts = st.text(max_size=20)
entries = st.builds(Entry, st.floats(allow_nan=False, allow_infinity=False), texts, texts)
appends = st.lists(st.tuples(st.lists(entries, max_size=5), st.booleans()), max_size=6)

ONE, TWO = Entry(1.0, "fact", '{"a":1}'), Entry(2.0, "fact", '{"a":2}')


class Torn(Sequence[Entry]):
    """Entries of which the second cannot be had."""

    def __len__(self) -> int:
        """Three, or so it says."""
        return 3

    @overload
    def __getitem__(self, index: int) -> Entry: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Entry]: ...
    def __getitem__(self, index: int | slice) -> Entry | Sequence[Entry]:
        """The first one, and then trouble."""
        if index == 0:
            return ONE
        raise RuntimeError("torn")


@both
@given(appends=appends)
def test_what_was_appended_is_read_back_in_order(
    opened: Opener, appends: list[tuple[list[Entry], bool]]
) -> None:
    """Numbered from 1 without a gap; each append says the last number."""
    with opened() as journal:
        written: list[Entry] = []
        for batch, durable in appends:
            written += batch
            assert journal.append(batch, durable=durable) == len(written) == journal.last
        assert list(journal.read()) == [Record(n, *entry) for n, entry in enumerate(written, 1)]


@both
@given(count=st.integers(0, 12), after=st.integers(-2, 14))
def test_reading_after_a_number_skips_the_events_before(
    opened: Opener, count: int, after: int
) -> None:
    """A number beyond the end reads nothing, one below zero reads everything."""
    with opened() as journal:
        journal.append([ONE] * count, durable=False)
        numbers = [record.sequence for record in journal.read(after=after)]
        assert numbers == list(range(max(after, 0) + 1, count + 1))


@both
def test_reading_goes_on_over_what_is_appended_meanwhile(
    opened: Opener, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The end is where the journal ends when the reader gets there."""
    monkeypatch.setattr(sqlite, "PAGE", 2)
    with opened() as journal:
        journal.append([ONE] * 4, durable=False)
        records = journal.read()
        assert next(records).sequence == 1
        journal.append([TWO] * 3, durable=False)
        assert [record.sequence for record in records] == [2, 3, 4, 5, 6, 7]


@both
def test_integers_and_minus_zero_are_read_as_plain_floats(opened: Opener) -> None:
    """So that the time means the same in every journal."""
    with opened() as journal:
        journal.append([Entry(-0.0, "k", ""), Entry(3, "k", "")], durable=False)
        assert [repr(record.at) for record in journal.read()] == ["0.0", "3.0"]


@both
@pytest.mark.parametrize(
    ("entry", "message"),
    [
        (Entry(float("nan"), "fact", ""), "of kind 'fact' happened at nan; expected a finite"),
        (Entry(float("inf"), "fact", ""), "of kind 'fact' happened at inf; expected a finite"),
        (Entry(1.5, "fact", "\ud800"), "of kind 'fact' at 1.5 s is no text: 'utf-8' codec"),
        (Entry(1.5, "\ud800", ""), "at 1.5 s is no text: 'utf-8' codec"),
    ],
)
def test_an_entry_that_cannot_be_read_back_is_refused_with_its_whole_append(
    opened: Opener, entry: Entry, message: str
) -> None:
    """And the journal goes on."""
    with opened() as journal:
        with pytest.raises(JournalError, match="nothing was appended") as caught:
            journal.append([ONE, entry, ONE], durable=False)
        assert message in str(caught.value)
        assert journal.append([TWO], durable=False) == 1
        assert list(journal.read()) == [Record(1, *TWO)]


@both
def test_an_append_that_breaks_off_in_the_middle_leaves_nothing(opened: Opener) -> None:
    """Whatever was raised is passed on."""
    with opened() as journal:
        journal.append([ONE], durable=False)
        with pytest.raises(RuntimeError, match="torn"):
            journal.append(Torn(), durable=True)
        assert journal.append([TWO], durable=False) == 2
        assert list(journal.read()) == [Record(1, *ONE), Record(2, *TWO)]


@both
def test_the_newest_snapshot_is_the_one_of_the_highest_number(opened: Opener) -> None:
    """Saving one again replaces it; none yet is None."""
    with opened() as journal:
        assert journal.snapshot() is None
        journal.save_snapshot(0, "empty")
        assert journal.snapshot() == Snapshot(0, "empty")
        journal.append([ONE] * 5, durable=False)
        for sequence, body in ((2, "two"), (4, "four"), (3, "three"), (4, "vier ü")):
            journal.save_snapshot(sequence, body)
        assert journal.snapshot() == Snapshot(4, "vier ü")


@both
@pytest.mark.parametrize("sequence", [-1, 3])
def test_a_snapshot_of_events_that_do_not_exist_is_refused(opened: Opener, sequence: int) -> None:
    """The message says which numbers do."""
    with opened() as journal:
        journal.append([ONE, TWO], durable=False)
        with pytest.raises(JournalError) as caught:
            journal.save_snapshot(sequence, "{}")
        assert str(caught.value) == (
            f"a snapshot of the events up to {sequence} cannot be kept; "
            "expected 0 to 2, the last event"
        )
        assert journal.snapshot() is None


@both
@pytest.mark.parametrize(
    "use",
    [
        lambda journal: journal.last,
        lambda journal: journal.append([ONE], durable=False),
        lambda journal: journal.append([], durable=False),
        lambda journal: next(journal.read()),
        lambda journal: journal.save_snapshot(0, ""),
        lambda journal: journal.snapshot(),
    ],
    ids=["last", "append", "append nothing", "read", "save_snapshot", "snapshot"],
)
def test_a_closed_journal_says_so(opened: Opener, use: Callable[[Journal], object]) -> None:
    """Closing twice is allowed."""
    with opened() as journal:
        journal.close()
        journal.close()
        with pytest.raises(JournalError, match="the journal is closed"):
            use(journal)


@given(sizes=st.lists(st.integers(1, 4), max_size=6), data=st.data())
def test_a_journal_in_memory_can_be_cut_after_any_event(
    sizes: list[int], data: st.DataObject
) -> None:
    """The copy is as the journal was then, and goes its own way."""
    journal = MemoryJournal()
    for size in sizes:
        journal.save_snapshot(journal.append([ONE] * size, durable=False), "{}")
    before = journal.records
    sequence = data.draw(st.integers(0, journal.last))
    copy = journal.cut(sequence)
    assert copy.records == before[:sequence]
    assert copy.commits == tuple(n for n in journal.commits if n <= sequence)
    assert copy.snapshot() == (Snapshot(copy.commits[-1], "{}") if copy.commits else None)
    copy.append([TWO], durable=True)
    assert journal.records == before


@pytest.mark.parametrize("sequence", [-1, 2])
def test_a_cut_after_an_event_that_does_not_exist_is_refused(sequence: int) -> None:
    """The message says which exist."""
    journal = MemoryJournal()
    journal.append([ONE], durable=False)
    with pytest.raises(JournalError) as caught:
        journal.cut(sequence)
    assert str(caught.value) == (
        f"the journal cannot be cut after event {sequence}; expected 0 to 1"
    )
