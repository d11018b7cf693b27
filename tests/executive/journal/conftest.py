"""A place for a journal, a few events, and a look at the connections that are opened."""

import sqlite3
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from depal.executive.journal import Entry, SqliteJournal


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Where a journal may be made; its name needs quoting in an address."""
    return tmp_path / "cell #1 100%.journal"


@pytest.fixture
def journal(path: Path) -> Iterator[SqliteJournal]:
    """An empty journal, open for writing."""
    with SqliteJournal(path) as journal:
        yield journal


@pytest.fixture
def events() -> list[Entry]:
    """Thirty events that differ in every part."""
    return [Entry(n / 8, f"kind-{n % 3}", f'{{"box":"box_{n}","ü":{n}}}') for n in range(30)]


@pytest.fixture
def connections(monkeypatch: pytest.MonkeyPatch) -> list[sqlite3.Connection]:
    """The connections that are opened from here on, the newest last."""
    opened: list[sqlite3.Connection] = []
    connect = sqlite3.connect

    def remembered(*args: Any, **named: Any) -> sqlite3.Connection:  # noqa: ANN401 - passed on
        opened.append(connect(*args, **named))
        return opened[-1]

    monkeypatch.setattr(sqlite3, "connect", remembered)
    return opened
