"""The journal: what happened, in order, kept; also the outbox that consumers read from.

It knows no task. An event is a number, a time, a kind and a text; the caller says what they mean.

    with SqliteJournal(Path("cell.journal")) as journal:
        journal.append([Entry(12.5, "fact", '{"Box.taken":true}')], durable=False)
        journal.append([Entry(12.6, "intent", '{"move":"kr60"}')], durable=True)
        for record in journal.read(after=0):
            ...
"""

from depal.executive.journal.memory import MemoryJournal
from depal.executive.journal.projection import Projection
from depal.executive.journal.records import Entry, Journal, Record, Snapshot
from depal.executive.journal.sqlite import SqliteJournal

__all__ = [
    "Entry",
    "Journal",
    "MemoryJournal",
    "Projection",
    "Record",
    "Snapshot",
    "SqliteJournal",
]
