"""A run's record: one folder with the task files as they were and the journal of what happened.

RECORD/tasks.task   the canonical text of the tasks
RECORD/journal.db   every event
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from depal.errors import JournalError
from depal.executive import events as ev
from depal.executive.engine import Engine
from depal.executive.events import Event, decoded, encode
from depal.executive.journal import SqliteJournal
from depal.executive.language import format_repository, read_tasks
from depal.executive.schema import Repository
from depal.executive.state import State

TASKS, JOURNAL = "tasks.task", "journal.db"

DECISIONS = (ev.Started, ev.CancelAsked, ev.Archived)
"""The events that the engine itself decides; all others come from outside."""


def open_record(folder: Path, repository: Repository) -> SqliteJournal:
    """A new record, or one to go on with.

    Args:
        folder: made where it does not exist.
        repository: the tasks of the run.

    Returns:
        Its journal, open for writing.

    Raises:
        JournalError: the record was made with other tasks, or its journal is damaged.
    """
    folder.mkdir(parents=True, exist_ok=True)
    tasks = folder / TASKS
    if tasks.exists():
        kept = read_tasks(tasks)
        if kept.digest != repository.digest:
            message = (
                f"{folder}: the record was made with other tasks ({kept.digest}, now "
                f"{repository.digest}); expected the same, or another folder"
            )
            raise JournalError(message)
    else:
        tasks.write_text(format_repository(repository), encoding="utf-8")
    return SqliteJournal(folder / JOURNAL)


@dataclass(frozen=True, slots=True)
class Recording:
    """A record, read.

    Attributes:
        repository: the tasks that it was made with.
        events: what happened; event i has the sequence number i + 1.
    """

    repository: Repository
    events: tuple[Event, ...]

    @classmethod
    def read(cls, folder: Path) -> "Recording":
        """Reads a record.

        Raises:
            JournalError: there is none, or it is damaged.
            TaskError: its task file cannot be read.
        """
        for name in (TASKS, JOURNAL):
            if not (folder / name).is_file():
                there = (
                    ", ".join(sorted(path.name for path in folder.iterdir()))
                    if (folder.is_dir())
                    else "no such folder"
                )
                message = f"{folder}: no record here; expected {name} in it; there is: {there}"
                raise JournalError(message)
        repository = read_tasks(folder / TASKS)
        with SqliteJournal(folder / JOURNAL, readonly=True) as journal:
            events = tuple(decoded(journal.read()))
        return cls(repository, events)

    def state_at(self, sequence: int) -> State:
        """The state after an event.

        Args:
            sequence: its number; 0 for the beginning.

        Raises:
            JournalError: there is no such event.
        """
        if not 0 <= sequence <= len(self.events):
            message = f"there is no event {sequence}; the record has 1 .. {len(self.events)}"
            raise JournalError(message)
        engine = Engine(self.repository)
        for event in self.events[:sequence]:
            engine.state.apply(event)
        return engine.state

    def deviations(self) -> Iterator[int]:
        """Decides everything anew: the numbers of the events that would be decided otherwise.

        Inputs are taken from the record; wherever it holds decisions, the engine's own of that
        moment are compared with them.
        """
        engine = Engine(self.repository)
        position = 0
        while position < len(self.events):
            event = self.events[position]
            if not isinstance(event, DECISIONS):
                engine.state.apply(event)
                position += 1
                continue
            decided, _ = engine.consequences(event.at)
            recorded = _run_of_decisions(self.events, position)
            for offset, (one, other) in enumerate(zip(recorded, decided, strict=False)):
                if type(one) is not type(other) or encode(one) != encode(other):
                    yield position + offset + 1
                    return
            if len(recorded) != len(decided):
                yield position + min(len(recorded), len(decided)) + 1
                return
            position += len(recorded)


def _run_of_decisions(events: Sequence[Event], first: int) -> Sequence[Event]:
    last = first
    while last < len(events) and isinstance(events[last], DECISIONS):
        last += 1
    return events[first:last]
