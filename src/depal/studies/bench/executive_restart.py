"""Speed of a restart: folding a journal of 100,000 events, with and without a snapshot."""

from pathlib import Path
from tempfile import TemporaryDirectory

from depal.executive.engine import Engine
from depal.executive.events import decoded, encode
from depal.executive.journal import Entry, SqliteJournal
from depal.executive.restart import restored, resumed
from depal.executive.runtime import SNAPSHOT_EVERY
from depal.executive.snapshot import freeze
from depal.studies.bench.executive_work import Shift, store_tasks
from depal.studies.bench.figure import Figure, median_seconds

OPEN = 40
"""Stores that are open when the controller stops."""

_EVENTS = 100_000


def restart_figures(events: int = _EVENTS) -> list[Figure]:
    """From a journal on the disk to an engine that may go on.

    Args:
        events: in the journal; at the most the last 1,000 are younger than the snapshot.
    """
    name = f"restart from {events:,} events"
    with TemporaryDirectory() as folder:
        path = Path(folder) / "cell.journal"
        write_journal(path, events)
        folding = median_seconds(lambda: folded(path), 3)
        recalling = median_seconds(lambda: recalled(path), 15)
    return [
        Figure(name, folding, "s", 2.0, "lower", 3),
        Figure("restart with a snapshot", 1e3 * recalling, "ms", 50.0, "lower", 15),
    ]


def write_journal(path: Path, events: int) -> None:
    """Works until the journal holds so many events, and keeps one snapshot near the end."""
    shift = Shift(OPEN)
    entries: list[Entry] = []
    with SqliteJournal(path) as journal:
        written, kept = 0, False
        for timed in shift.inputs():
            entries += [Entry(e.at, type(e).__name__, encode(e)) for e in timed.step.events]
            snapshot_due = not kept and written + len(entries) >= events - SNAPSHOT_EVERY
            full = written + len(entries) >= events
            if not (snapshot_due or full or len(entries) >= SNAPSHOT_EVERY):
                continue
            written = journal.append(entries[: events - written], durable=False)
            entries.clear()
            if full:
                return
            if snapshot_due:
                journal.save_snapshot(written, freeze(shift.engine.state))
                kept = True


def folded(path: Path) -> Engine:
    """The engine that the whole journal leads to."""
    with SqliteJournal(path) as journal:
        return restored(store_tasks(), decoded(journal.read()))


def recalled(path: Path) -> Engine:
    """The same engine, from the snapshot and the events after it."""
    with SqliteJournal(path) as journal:
        return resumed(store_tasks(), journal)
