"""The journals of all runs as one row of events, read while they are written."""

import threading
from pathlib import Path
from typing import Any

import msgspec

from depal.errors import JournalError
from depal.executive.journal import SqliteJournal
from depal.executive.record import JOURNAL
from depal.server.events import PER_RUN, Event, Events


class Feed(Events):
    """Over the folder of the runs; any thread may read."""

    def __init__(self, folder: Path) -> None:
        """Nothing is open yet.

        Args:
            folder: with a folder for each run.
        """
        self._folder = folder
        self._lock = threading.Lock()
        self._last = 0
        self._look()

    def wrote(self, run: int, sequence: int) -> None:
        """The cell has written an event."""
        self._last = max(self._last, run * PER_RUN + sequence)

    @property
    def last(self) -> int:
        """The number of the newest event."""
        return self._last

    def after(self, sequence: int, limit: int) -> tuple[Event, ...]:
        """The events after a number, in order."""
        found: list[Event] = []
        with self._lock:
            for run in self._runs():
                if (run + 1) * PER_RUN <= sequence:
                    continue
                known = max(sequence - run * PER_RUN, 0)
                found += self._read(run, known, limit - len(found))
                if len(found) >= limit:
                    break
        return tuple(found)

    def _look(self) -> None:
        for run in self._runs():
            with _opened(self._folder / str(run)) as journal:
                self._last = max(self._last, run * PER_RUN + journal.last)

    def _runs(self) -> list[int]:
        if not self._folder.is_dir():
            return []
        names = (path.name for path in self._folder.iterdir() if (path / JOURNAL).is_file())
        return sorted(int(name) for name in names if name.isdigit())

    def _read(self, run: int, known: int, limit: int) -> list[Event]:
        events: list[Event] = []
        try:
            with _opened(self._folder / str(run)) as journal:
                for record in journal.read(after=known):
                    body: dict[str, Any] = msgspec.json.decode(record.body)
                    number = run * PER_RUN + record.sequence
                    events.append(Event(number, run, record.at, record.kind, body))
                    if len(events) >= limit:
                        break
        except JournalError:
            return events  # it is being made, or was taken away: what is whole is told
        return events


def _opened(folder: Path) -> SqliteJournal:
    return SqliteJournal(folder / JOURNAL, readonly=True)
