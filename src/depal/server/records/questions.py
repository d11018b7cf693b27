"""Questions to the supervising person: who answered what."""

import json
from dataclasses import dataclass

from sqlalchemy import select, tuple_

from depal.logistics.store import Database
from depal.logistics.store.served_tables import QuestionRow
from depal.server.cellstate import QuestionState
from depal.server.problems import NotFound


@dataclass(frozen=True, slots=True)
class QuestionView:
    """A question as others see it; times on the cell's clock [s].

    Attributes:
        id: its name.
        run: whose it is.
        text: what was asked.
        choices: the answers to choose from.
        about: the box, the trolley or the place that it is about.
        asked: when.
        answered: when; None while nobody has.
        answer: which.
        by: who.
    """

    id: str
    run: int
    text: str
    choices: tuple[str, ...]
    about: str
    asked: float
    answered: float | None
    answer: str | None
    by: str | None


class Questions:
    """Over the store's database."""

    def __init__(self, database: Database) -> None:
        """The questions in it."""
        self._database = database

    def asked(self, run: int, question: QuestionState) -> None:
        """One more."""
        with self._database.session() as session:
            session.merge(
                QuestionRow(
                    id=question.id,
                    run=run,
                    text=question.text,
                    choices=json.dumps(question.choices),
                    about=question.about,
                    asked=question.asked,
                    answered=None,
                    answer=None,
                    by=None,
                )
            )

    def answered(self, name: str, choice: str, by: str, at: float) -> None:
        """Somebody has answered."""
        with self._database.session() as session:
            row = session.get(QuestionRow, name)
            if row is not None and row.answered is None:
                row.answered, row.answer, row.by = at, choice, by

    def drop(self, run: int) -> None:
        """Those of a run that nobody will answer any more: the controller asks anew."""
        with self._database.session() as session:
            query = select(QuestionRow).where(
                QuestionRow.run == run, QuestionRow.answered.is_(None)
            )
            for row in session.scalars(query):
                row.answered, row.answer, row.by = row.asked, "asked anew", "the cell"

    def get(self, name: str) -> QuestionView:
        """A question.

        Raises:
            NotFound: there is none of that name.
        """
        with self._database.session() as session:
            row = session.get(QuestionRow, name)
            if row is None:
                raise NotFound(f"there is no question {name!r}")
            return _view(row)

    def list(
        self, *, open_only: bool = False, limit: int = 100, before: str | None = None
    ) -> tuple[QuestionView, ...]:
        """The newest first.

        Args:
            open_only: only those that nobody has answered.
            limit: so many at the most.
            before: the last one of the page before.

        Raises:
            NotFound: there is no question `before`.
        """
        order = (QuestionRow.run, QuestionRow.asked, QuestionRow.id)
        with self._database.session() as session:
            query = select(QuestionRow).order_by(*(column.desc() for column in order))
            if open_only:
                query = query.where(QuestionRow.answered.is_(None))
            if before is not None:
                row = session.get(QuestionRow, before)
                if row is None:
                    raise NotFound(f"there is no question {before!r}")
                query = query.where(tuple_(*order) < tuple_(row.run, row.asked, row.id))
            return tuple(_view(row) for row in session.scalars(query.limit(limit)))


def _view(row: QuestionRow) -> QuestionView:
    return QuestionView(
        row.id,
        row.run,
        row.text,
        tuple(json.loads(row.choices)),
        row.about,
        row.asked,
        row.answered,
        row.answer,
        row.by,
    )
