"""The runs: each one attempt to empty a pallet, with what came of it."""

import json
from dataclasses import dataclass
from typing import Any

from sqlalchemy import select

from depal.logistics.store import Database
from depal.logistics.store.served_tables import RunRow
from depal.server.chance import Chance
from depal.server.problems import NotFound

WORKING = "running"


@dataclass(frozen=True, slots=True)
class RunView:
    """A run as others see it.

    Attributes:
        number: of the run.
        delivery: whose pallet.
        state: "running", "done", "aborted" or "failed".
        by: who started it.
        began: seconds since 1970.
        ended: seconds since 1970; None while it runs.
        result: what came of it; empty while it runs.
    """

    number: int
    delivery: str
    state: str
    by: str
    began: float
    ended: float | None
    result: dict[str, Any]


class Runs:
    """Over the store's database."""

    def __init__(self, database: Database, chance: Chance) -> None:
        """The runs in it."""
        self._database, self._chance = database, chance

    def begin(self, delivery: str, by: str) -> int:
        """A new run; returns its number."""
        with self._database.session() as session:
            row = RunRow(
                delivery=delivery,
                state=WORKING,
                by=by,
                began=self._chance.now(),
                ended=None,
                result="{}",
            )
            session.add(row)
            session.flush()
            return row.number

    def end(self, number: int, state: str, result: dict[str, Any]) -> None:
        """It is over; the first word on that counts."""
        with self._database.session() as session:
            row = session.get(RunRow, number)
            if row is not None and row.state == WORKING:
                row.state, row.ended = state, self._chance.now()
                row.result = json.dumps(result, default=str)

    def unfinished(self) -> RunView | None:
        """The run that nobody has ended."""
        with self._database.session() as session:
            query = select(RunRow).where(RunRow.state == WORKING).order_by(RunRow.number.desc())
            row = session.scalar(query.limit(1))
            return None if row is None else _view(row)

    def list(self, before: int | None = None, limit: int = 50) -> tuple[RunView, ...]:
        """The newest first, those before a number."""
        with self._database.session() as session:
            query = select(RunRow).order_by(RunRow.number.desc()).limit(limit)
            if before is not None:
                query = query.where(RunRow.number < before)
            return tuple(_view(row) for row in session.scalars(query))

    def get(self, number: int) -> RunView:
        """A run.

        Raises:
            NotFound: there is none of that number.
        """
        with self._database.session() as session:
            row = session.get(RunRow, number)
            if row is None:
                raise NotFound(f"there is no run {number}")
            return _view(row)


def _view(row: RunRow) -> RunView:
    result: dict[str, Any] = json.loads(row.result)
    return RunView(row.number, row.delivery, row.state, row.by, row.began, row.ended, result)
