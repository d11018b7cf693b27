"""A run's record: the executive's, and beside it the choices, the result and pictures.

RECORD/tasks.task, RECORD/journal.db   what `depal replay` reads
RECORD/choices.jsonl                   every selection: h, l, s, fate and reason of each box
RECORD/run.json                        the result, as `--json` writes it
RECORD/picture.png, RECORD/run.gif     the cell at the end, and the run as it went
"""

import hashlib
import json
from collections.abc import Sequence
from dataclasses import asdict
from enum import Enum
from pathlib import Path
from typing import Self

from depal.cell.reporting import ChoiceNote, Journalist
from depal.closing import Closing
from depal.errors import JournalError, UnwrittenError
from depal.executive import events as ev
from depal.executive.events import encode
from depal.executive.journal import Journal, MemoryJournal, SqliteJournal
from depal.executive.record import JOURNAL, open_record
from depal.executive.schema import Repository

CHOICES, RESULT = "choices.jsonl", "run.json"


def said(value: object) -> object:
    """What JSON has no word for: an enum by its value."""
    return value.value if isinstance(value, Enum) else str(value)


class Keeper(Closing):
    """Keeps what happens in a run, in a folder or in memory."""

    def __init__(self, folder: Path | None, journal: SqliteJournal | MemoryJournal) -> None:
        """Writes into an open journal, and into a folder where there is one."""
        self.folder = folder
        self._journal = journal
        self._hash = hashlib.sha256()
        self.choices: list[ChoiceNote] = []

    @classmethod
    def open(cls, folder: Path | None, tasks: Repository) -> Self:
        """A new record.

        Raises:
            JournalError: the folder holds a record already.
        """
        if folder is None:
            return cls(None, MemoryJournal())
        if (folder / JOURNAL).exists():
            raise JournalError(f"{folder}: holds a record already; expected a new folder")
        if folder.exists() and not folder.is_dir():
            raise JournalError(f"{folder}: is a file; expected a new folder")
        return cls(folder, open_record(folder, tasks))

    @property
    def journal(self) -> Journal:
        """Where the executive writes."""
        return self._journal

    @property
    def events_sha256(self) -> str:
        """Of all events so far, in order."""
        return self._hash.hexdigest()

    def listen_to(self, notes: Journalist) -> None:
        """Learns of what happens."""
        notes.listen(heard=self._heard, chosen=self._chosen)

    def write_choices(self) -> None:
        """Writes the choices beside the journal.

        Raises:
            UnwrittenError: the disk does not take them.
        """
        if self.folder is None:
            return
        lines = [json.dumps(asdict(n), separators=(",", ":"), default=said) for n in self.choices]
        path = self.folder / CHOICES
        try:
            path.write_text("".join(f"{line}\n" for line in lines), "utf-8")
        except OSError as error:
            raise UnwrittenError(f"{path}: the choices were not written: {error}") from error

    def _heard(self, _: int, events: Sequence[ev.Event]) -> None:
        for event in events:
            self._hash.update(f"{event.at!r} {type(event).__name__} {encode(event)}\n".encode())

    def _chosen(self, note: ChoiceNote) -> None:
        self.choices.append(note)

    def close(self) -> None:
        """Closes the journal."""
        self._journal.close()
