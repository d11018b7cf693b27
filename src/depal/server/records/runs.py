"""The runs: each one attempt to empty a pallet, with what came of it."""

import json
from dataclasses import dataclass
from typing import Any

from sqlalchemy import select

from depal.logistics.store import Database
from depal.logistics.store.request_book import RequestState, settle
from depal.logistics.store.served_tables import QueuedRow, RequestOriginRow, RunRow
from depal.server.chance import Chance
from depal.server.problems import Conflict, NotFound
from depal.server.records.queue import CANCELLED, DONE, QUEUED, RUNNING

WORKING, FAILED = "running", "failed"

LEAVES = {"done": DONE, FAILED: QUEUED, "aborted": QUEUED}
"""What becomes of the delivery: its pallet is empty, or is loaded anew."""


@dataclass(frozen=True, slots=True)
class RunView:
    """A run as others see it.

    Attributes:
        number: of the run.
        delivery: whose pallet.
        state: "running", "done", "aborted", or "failed" where it never began.
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
        """A new run of a delivery that waits; from now on it does not.

        Returns:
            The number of the run.

        Raises:
            NotFound: there is no such delivery.
            Conflict: it does not wait, or another run is not over.
        """
        with self._database.session() as session:
            row = session.get(QueuedRow, delivery)
            if row is None:
                raise NotFound(f"there is no delivery {delivery!r}")
            if row.state != QUEUED:
                raise Conflict(f"delivery {delivery!r} does not wait: it is {row.state}")
            working = select(RunRow).where(RunRow.state == WORKING).limit(1)
            other = session.scalar(working)
            if other is not None:
                raise Conflict(f"run {other.number} of {other.delivery!r} is not over")
            run = RunRow(
                delivery=delivery,
                state=WORKING,
                by=by,
                began=self._chance.now(),
                ended=None,
                result="{}",
            )
            session.add(run)
            row.state, row.version = RUNNING, row.version + 1
            session.flush()
            return run.number

    def end(self, number: int, state: str, result: dict[str, Any], at: float = 0.0) -> None:
        """It is over, and so are its delivery and what was wanted of its pallet alone.

        A run that was never begun leaves its delivery waiting. The first word counts.

        Args:
            number: of the run.
            state: how it ended.
            result: what came of it.
            at: on the cell's clock [s].
        """
        with self._database.session() as session:
            row = session.get(RunRow, number)
            if row is None or row.state != WORKING:
                return
            row.state, row.ended = state, self._chance.now()
            row.result = json.dumps(result, default=str)
            delivery = session.get(QueuedRow, row.delivery)
            if delivery is not None:
                delivery.state = LEAVES.get(state, CANCELLED)
                delivery.version += 1
            query = select(RequestOriginRow.key).where(RequestOriginRow.run == number)
            for key in session.scalars(query).all():
                settle(session, key, RequestState.REJECTED, at, "its pallet is worked on no longer")

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
