"""Requests with where they come from; each ends served, rejected or cancelled, once (I8)."""

from dataclasses import dataclass, replace

from sqlalchemy import select
from sqlalchemy.orm import Session

from depal.domain import BoxId, Gtin, Request
from depal.logistics.store import Database
from depal.logistics.store.request_book import (
    RequestState,
    keep_request,
    read_requests_in,
    settle,
)
from depal.logistics.store.served_tables import RequestOriginRow
from depal.logistics.store.tables import RequestRow
from depal.server.chance import Chance
from depal.server.problems import Conflict, NotFound, Stale


@dataclass(frozen=True, slots=True)
class RequestView:
    """A request as others see it.

    Attributes:
        key: its name.
        gtin: the wanted product, or None.
        box: the wanted box, or None.
        priority: p in [0, 1].
        due: seconds since 1970, if at all.
        state: "pending", "served", "rejected" or "cancelled".
        reason: why it ended so.
        by: who made it.
        created: seconds since 1970.
        run: whose box it wants; None for a product.
        version: rises with every change.
        number: in the order of their acceptance.
    """

    key: str
    gtin: str | None
    box: str | None
    priority: float
    due: float | None
    state: str
    reason: str
    by: str
    created: float
    run: int | None
    version: int
    number: int


class Requests:
    """Over the store's database."""

    def __init__(self, database: Database, chance: Chance) -> None:
        """The requests in it."""
        self._database, self._chance = database, chance

    def add(
        self, key: str, request: Request, *, by: str, run: int | None, due: float | None
    ) -> RequestView:
        """One more; one of that name that is there already stays as it is.

        Args:
            key: its name.
            request: with times on the cell's clock.
            by: who makes it.
            run: whose box it wants.
            due: seconds since 1970.
        """
        with self._database.session() as session:
            if session.get(RequestOriginRow, key) is not None:
                return _view(session, key)
            keep_request(session, key, request)
            origin = RequestOriginRow(
                key=key, run=run, by=by, created=self._chance.now(), due=due, version=1
            )
            session.add(origin)
            session.flush()
            return _view(session, key)

    def get(self, key: str) -> RequestView:
        """A request.

        Raises:
            NotFound: there is none of that name.
        """
        with self._database.session() as session:
            return _view(session, key)

    def list(
        self, *states: RequestState, after: int = 0, limit: int = 100
    ) -> tuple[RequestView, ...]:
        """Those in some states, or all, in the order of their acceptance."""
        with self._database.session() as session:
            wanted = [state.value for state in (states or tuple(RequestState))]
            query = (
                select(RequestRow.key)
                .where(RequestRow.state.in_(wanted), RequestRow.number > after)
                .order_by(RequestRow.number)
                .limit(limit)
            )
            return tuple(_view(session, key) for key in session.scalars(query).all())

    def waiting(self, run: int | None, now: float) -> tuple[tuple[str, Request], ...]:
        """What is wanted of a run: products, and boxes of that very run.

        Args:
            run: which.
            now: on the cell's clock [s]. It may be another clock than the one on which they came:
                they have all come by now, and what was due in a minute still is.

        Returns:
            Requests by key, in the order of their acceptance.
        """
        with self._database.session() as session:
            kept = read_requests_in(session, [RequestState.PENDING])
            origins = {row.key: row for row in session.scalars(select(RequestOriginRow))}
            return tuple(
                (each.key, self._on_clock(each.request, origins[each.key].due, now))
                for each in kept
                if each.key in origins
                and (each.request.box is None or origins[each.key].run == run)
            )

    def _on_clock(self, request: Request, due: float | None, now: float) -> Request:
        arrived = min(request.arrived, now)
        ahead = None if due is None else max(now + due - self._chance.now(), arrived)
        return replace(request, arrived=arrived, due=ahead)

    def change(
        self, key: str, version: int, priority: float, due: tuple[float | None, float | None]
    ) -> Request:
        """Another priority or due time.

        Args:
            key: which.
            version: that is changed.
            priority: p in [0, 1].
            due: on the cell's clock, and in seconds since 1970.

        Returns:
            The request as it is now.

        Raises:
            NotFound: there is none of that name.
            Conflict: it has ended.
            Stale: somebody else has changed it.
        """
        with self._database.session() as session:
            row, origin = _pending(session, key, version)
            row.priority, row.due = priority, due[0]
            origin.due, origin.version = due[1], origin.version + 1
            session.flush()
            return _request(row)

    def cancel(self, key: str, version: int | None, at: float, by: str) -> RequestView:
        """It is not wanted any more.

        Raises:
            NotFound: there is none of that name.
            Conflict: it has ended.
            Stale: somebody else has changed it.
        """
        with self._database.session() as session:
            _pending(session, key, version)
            settle(session, key, RequestState.CANCELLED, at, f"by {by}")
            return _view(session, key)

    def end(self, key: str, *, served: bool, at: float, reason: str) -> bool:
        """It has ended; False where it had ended before."""
        state = RequestState.SERVED if served else RequestState.REJECTED
        with self._database.session() as session:
            return settle(session, key, state, at, reason)


def _request(row: RequestRow) -> Request:
    return Request(
        row.priority,
        gtin=None if row.gtin is None else Gtin(row.gtin),
        box=None if row.box is None else BoxId(row.box),
        arrived=row.arrived,
        due=row.due,
    )


def _rows(session: Session, key: str) -> tuple[RequestRow, RequestOriginRow]:
    row = session.scalar(select(RequestRow).where(RequestRow.key == key))
    origin = session.get(RequestOriginRow, key)
    if row is None or origin is None:
        raise NotFound(f"there is no request {key!r}")
    return row, origin


def _pending(
    session: Session, key: str, version: int | None
) -> tuple[RequestRow, RequestOriginRow]:
    row, origin = _rows(session, key)
    if version is not None and version != origin.version:
        raise Stale(f"request {key!r} has version {origin.version} now")
    if row.state != RequestState.PENDING.value:
        raise Conflict(f"request {key!r} has ended: it was {row.state} {row.reason}".strip())
    return row, origin


def _view(session: Session, key: str) -> RequestView:
    row, origin = _rows(session, key)
    return RequestView(
        row.key,
        row.gtin,
        row.box,
        row.priority,
        origin.due,
        row.state,
        row.reason,
        origin.by,
        origin.created,
        origin.run,
        origin.version,
        row.number,
    )
