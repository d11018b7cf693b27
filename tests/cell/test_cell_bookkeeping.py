"""A disk that takes nothing: nothing moves, a person is asked, nothing is lost or doubled."""

from collections.abc import Callable, Sequence

import pytest
from cells_at_work import STORED, Cell
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.cell.bookkeeping import GO_ON, HOPELESS, OFTEN
from depal.errors import JournalError, UnwrittenError
from depal.executive.journal import Entry, Journal, MemoryJournal
from depal.ports import Question
from depal.ports.fakes import FakePerson


class Disk:
    """A disk for a journal and a ledger that is full from a write on, until somebody makes room.

    Attributes:
        fails: the write that is the first to fail.
        writes: how many were tried.
        full: whether it takes nothing.
        begun: counts the motions and grips that have begun.
        moved: how many began while it was full.
    """

    def __init__(self, fails: int, *, pages_only: bool = False) -> None:
        """Full from that write on."""
        self.fails, self.pages_only = fails, pages_only
        self.writes = 0
        self.full = False
        self.begun: Callable[[], int] = lambda: 0
        self.moved = self._before = 0

    def journal(self, journal: Journal) -> Journal:
        """A journal on it."""
        disk, append = self, journal.append
        assert isinstance(journal, MemoryJournal)

        class OnDisk(MemoryJournal):
            def append(self, entries: Sequence[Entry], *, durable: bool) -> int:
                if not disk.pages_only:
                    disk.write()
                return append(entries, durable=durable)

        return OnDisk()

    def asked(self, *, makes_room: bool) -> None:
        """A person has come."""
        self.moved += self.begun() - self._before
        self._before = self.begun()
        if makes_room:
            self.full = False

    def write(self) -> None:
        """Something is written, or not."""
        self.writes += 1
        if self.writes == self.fails:
            self.full, self._before = True, self.begun()
        if self.full:
            message = "nothing was written: the disk is full"
            raise JournalError(message)


def cell_on(disk: Disk, answer: str = GO_ON, *, makes_room: bool = True) -> Cell:
    """Two boxes, and a person who is asked."""

    def answered(question: Question) -> str:
        if question.about != "records":
            return question.choices[0]
        disk.asked(makes_room=makes_room)
        return answer

    cell = Cell(boxes=2, person=FakePerson(answered), disk=disk.journal, page=disk.write)
    disk.begun = lambda: len(cell.arm.followed) + len(cell.gripper.grips)
    return cell


@pytest.mark.slow
@given(fails=st.integers(1, 90), pages_only=st.booleans())
@settings(max_examples=12, deadline=None)
def test_whichever_write_fails_the_run_goes_on_where_it_was(fails: int, pages_only: bool) -> None:  # noqa: FBT001
    """Journal or ledger: all is stored once, and while the disk was full nothing began to move."""
    disk = Disk(fails, pages_only=pages_only)
    cell = cell_on(disk).works()
    cell.assert_whole()
    assert set(cell.fates.values()) == {STORED}
    assert disk.moved == 0
    asked = [each for each in cell.work.questions.all if each.question.about == "records"]
    assert len(asked) == (disk.writes >= fails)


@pytest.mark.parametrize(
    ("answer", "questions"), [(GO_ON, OFTEN), (HOPELESS, 1)], ids=["still full", "hopeless"]
)
def test_a_disk_that_stays_full_ends_the_run_with_one_error(answer: str, questions: int) -> None:
    """After so many questions; what has been stored stays stored, nothing moves any more."""
    disk = Disk(25)
    cell = cell_on(disk, answer, makes_room=False)
    with pytest.raises(UnwrittenError, match="stopped where it was: nothing was written: the disk"):
        cell.works()
    assert len(cell.work.questions.all) == questions
    assert disk.moved == 0
    assert cell.blunders == []
