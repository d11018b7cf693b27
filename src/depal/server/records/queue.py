"""The queue of deliveries: uploaded, checked, waiting, running, done."""

import json
from collections.abc import Iterable
from dataclasses import dataclass

from sqlalchemy import Row, func, select
from sqlalchemy.orm import Session

from depal.domain import Delivery
from depal.logistics.store import Database
from depal.logistics.store.served_tables import QueuedRow
from depal.server.chance import Chance
from depal.server.problems import Conflict, NotFound, Stale
from depal.server.records.documents import delivery_from, document_of

QUEUED, RUNNING, DONE, CANCELLED = "queued", "running", "done", "cancelled"


@dataclass(frozen=True, slots=True)
class QueuedView:
    """A delivery as others see it.

    Attributes:
        id: its name.
        state: "queued", "running", "done" or "cancelled".
        position: in the queue, from 1; 0 where it does not wait.
        boxes: how many the note promises.
        products: how many there are.
        by: who uploaded it.
        at: when, seconds since 1970.
        version: rises with every change.
    """

    id: str
    state: str
    position: int
    boxes: int
    products: int
    by: str
    at: float
    version: int


class Queue:
    """Over the store's database."""

    def __init__(self, database: Database, chance: Chance) -> None:
        """The deliveries in it."""
        self._database, self._chance = database, chance

    def add(self, delivery: Delivery, by: str) -> QueuedView:
        """One more, at the end.

        Raises:
            Conflict: there is one of that name.
        """
        return self.add_all([delivery], by)[0]

    def add_all(self, deliveries: Iterable[Delivery], by: str) -> tuple[QueuedView, ...]:
        """All of them, at the end, or none.

        Raises:
            Conflict: there is one of such a name.
        """
        with self._database.session() as session:
            rows = [self._row_of(session, delivery, by) for delivery in deliveries]
            return tuple(_view(session, row) for row in rows)

    def _row_of(self, session: Session, delivery: Delivery, by: str) -> QueuedRow:
        if session.get(QueuedRow, delivery.id) is not None:
            raise Conflict(f"there is a delivery {delivery.id!r} already")
        row = QueuedRow(
            id=delivery.id,
            body=json.dumps(document_of(delivery)),
            by=by,
            at=self._chance.now(),
            state=QUEUED,
            position=_last(session) + 1,
            version=1,
        )
        session.add(row)
        session.flush()
        return row

    def known(self, names: Iterable[str]) -> frozenset[str]:
        """Those of some names that are there, in whatever state."""
        with self._database.session() as session:
            return frozenset(name for name in names if session.get(QueuedRow, name) is not None)

    def list(
        self, *states: str, after: str | None = None, limit: int | None = None
    ) -> tuple[QueuedView, ...]:
        """Those in some states, or all: what waits first, in its order, then the newest.

        Args:
            states: wanted.
            after: the last one of the page before.
            limit: of the page.

        Raises:
            NotFound: there is no delivery `after`.
        """
        with self._database.session() as session:
            columns = (QueuedRow.id, QueuedRow.state, QueuedRow.position, QueuedRow.at)
            query = select(*columns)
            if states:
                query = query.where(QueuedRow.state.in_(states))
            names = [name for name, *_ in sorted(session.execute(query), key=_order)]
            if after is not None and after not in names:
                raise NotFound(f"there is no delivery {after!r}")
            first = 0 if after is None else names.index(after) + 1
            page = names[first:] if limit is None else names[first : first + limit]
            return tuple(_view(session, _row(session, name)) for name in page)

    def get(self, name: str) -> tuple[QueuedView, Delivery]:
        """A delivery, whole.

        Raises:
            NotFound: there is none of that name.
        """
        with self._database.session() as session:
            row = _row(session, name)
            return _view(session, row), delivery_from(json.loads(row.body))

    def next(self) -> str | None:
        """The first that waits."""
        with self._database.session() as session:
            query = select(QueuedRow.id).where(QueuedRow.state == QUEUED)
            return session.scalar(query.order_by(QueuedRow.position).limit(1))

    def mark(self, name: str, state: str) -> None:
        """It is in another state now.

        Raises:
            NotFound: there is none of that name.
        """
        with self._database.session() as session:
            row = _row(session, name)
            row.state, row.version = state, row.version + 1

    def cancel(self, name: str, version: int | None = None) -> QueuedView:
        """It is not wanted any more.

        Raises:
            NotFound: there is none of that name.
            Conflict: it does not wait.
            Stale: somebody has changed it.
        """
        with self._database.session() as session:
            row = _waiting(session, name, version)
            row.state, row.version = CANCELLED, row.version + 1
            return _view(session, row)

    def move(self, name: str, position: int, version: int | None = None) -> QueuedView:
        """To another position among those that wait, from 1.

        Raises:
            NotFound: there is none of that name.
            Conflict: it does not wait.
            Stale: somebody has changed it.
        """
        with self._database.session() as session:
            row = _waiting(session, name, version)
            query = select(QueuedRow).where(QueuedRow.state == QUEUED, QueuedRow.id != name)
            others = list(session.scalars(query.order_by(QueuedRow.position)))
            others.insert(max(0, min(position - 1, len(others))), row)
            for number, each in enumerate(others, start=1):
                each.position = number
            row.version += 1
            session.flush()
            return _view(session, row)


def _order(row: Row[str, str, int, float]) -> tuple[bool, bool, float, str]:
    name, state, position, at = row
    place = float(position) if state == QUEUED else -at
    return state != RUNNING, state != QUEUED, place, name


def _row(session: Session, name: str) -> QueuedRow:
    row = session.get(QueuedRow, name)
    if row is None:
        raise NotFound(f"there is no delivery {name!r}")
    return row


def _waiting(session: Session, name: str, version: int | None) -> QueuedRow:
    row = _row(session, name)
    if version is not None and version != row.version:
        raise Stale(f"delivery {name!r} has version {row.version} now")
    if row.state != QUEUED:
        raise Conflict(f"delivery {name!r} does not wait: it is {row.state}")
    return row


def _last(session: Session) -> int:
    return session.scalar(select(func.max(QueuedRow.position))) or 0


def _view(session: Session, row: QueuedRow) -> QueuedView:
    before = (
        select(func.count())
        .select_from(QueuedRow)
        .where(QueuedRow.state == QUEUED, QueuedRow.position <= row.position)
    )
    lines = json.loads(row.body)["lines"]
    return QueuedView(
        row.id,
        row.state,
        (session.scalar(before) or 0) if row.state == QUEUED else 0,
        sum(line["count"] for line in lines),
        len(lines),
        row.by,
        row.at,
        row.version,
    )
