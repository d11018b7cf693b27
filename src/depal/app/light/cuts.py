"""Where a controller ends, and what it leaves behind: its journal and its ledger."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from types import TracebackType
from typing import Self

import msgspec

from depal.cell.ledger import Page
from depal.executive.journal import Entry, MemoryJournal, Record, Snapshot
from depal.simulation.light import EndedError, Life


class Kind(Enum):
    """What is counted up to a cut."""

    JOURNAL = "journal"
    LEDGER = "ledger"
    TIME = "time"


class Moment(Enum):
    """Before: the write is not on the disk. After: it is, and nothing else has happened since."""

    BEFORE = "before"
    AFTER = "after"


@dataclass(frozen=True, slots=True)
class Cut:
    """Where the life of a controller ends.

    Attributes:
        kind: what is counted.
        at: the number of the write in this life, from 1, or the time from its start [s].
        moment: before or after that write.
        power: whether the power fails too: what the journal has not synced is gone.
    """

    kind: Kind
    at: float
    moment: Moment = Moment.AFTER
    power: bool = False

    def __str__(self) -> str:
        """In words."""
        lost = ", power lost" if self.power else ""
        if self.kind is Kind.TIME:
            return f"after {self.at:.3f} s{lost}"
        return f"{self.moment.value} {self.kind.value} write {self.at:.0f}{lost}"


class Disk:
    """What outlives a controller: the events, those of them that are synced, and the last page.

    Attributes:
        journal: every event that was written.
        synced: the number of the last one that a power cut leaves.
        page: the ledger's last page, encoded; None where none was written.
    """

    def __init__(self) -> None:
        """Empty."""
        self.journal = MemoryJournal()
        self.synced = 0
        self.page: bytes | None = None

    def lose_power(self) -> None:
        """The events that were not synced are gone; a page is always synced."""
        self.journal = self.journal.cut(self.synced)

    def last_page(self) -> Page:
        """The ledger's last page."""
        return Page() if self.page is None else msgspec.json.decode(self.page, type=Page)


class Writes:
    """The disk as one controller has it, with the cut that ends it.

    Attributes:
        count: the writes of each kind so far.
    """

    def __init__(self, disk: Disk, life: Life, cut: Cut | None) -> None:
        """A controller begins to write.

        Args:
            disk: outlives it.
            life: of the controller.
            cut: where it ends; None for nowhere.
        """
        self._disk, self._life, self._cut = disk, life, cut
        self._encoder = msgspec.json.Encoder()
        self.count = {Kind.JOURNAL: 0, Kind.LEDGER: 0}

    def _passes(self, kind: Kind, moment: Moment) -> None:
        """The controller ends here, where the cut says so."""
        cut = self._cut
        here = cut is not None and cut.kind is kind and cut.moment is moment
        if here and cut is not None and self.count[kind] == cut.at:
            self._life.end()
            raise EndedError

    def write_page(self, page: Page) -> None:
        """A write of the ledger."""
        self._life.check()
        self.count[Kind.LEDGER] += 1
        self._passes(Kind.LEDGER, Moment.BEFORE)
        self._disk.page = self._encoder.encode(page)
        self._passes(Kind.LEDGER, Moment.AFTER)

    # The journal, behind its port

    @property
    def last(self) -> int:
        """The number of the last event."""
        return self._disk.journal.last

    def append(self, entries: Sequence[Entry], *, durable: bool) -> int:
        """A write of the journal."""
        self._life.check()
        self.count[Kind.JOURNAL] += 1
        self._passes(Kind.JOURNAL, Moment.BEFORE)
        last = self._disk.journal.append(entries, durable=durable)
        if durable:
            self._disk.synced = last
        self._passes(Kind.JOURNAL, Moment.AFTER)
        return last

    def read(self, after: int = 0) -> Iterator[Record]:
        """The events after a number."""
        return self._disk.journal.read(after)

    def save_snapshot(self, sequence: int, body: str) -> None:
        """Keeps what all events up to a number amount to."""
        self._disk.journal.save_snapshot(sequence, body)

    def snapshot(self) -> Snapshot | None:
        """The newest snapshot."""
        return self._disk.journal.snapshot()

    def close(self) -> None:
        """The disk stays."""

    def __enter__(self) -> Self:
        """The writes themselves."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """The disk stays."""
