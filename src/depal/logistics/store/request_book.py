"""Requests and what becomes of them: each ends served, rejected or cancelled, exactly once (I8).

pending ──┬── served
          ├── rejected
          └── cancelled
"""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum

from sqlalchemy import or_, select, update
from sqlalchemy.orm import Session

from depal.domain import BoxId, Gtin, Request
from depal.errors import Problem, RequestError, SettingError, did_you_mean
from depal.logistics.store.tables import RequestRow


class RequestState(Enum):
    """Where a request is; all but `PENDING` are final."""

    PENDING = "pending"
    SERVED = "served"
    REJECTED = "rejected"
    CANCELLED = "cancelled"


@dataclass(frozen=True, slots=True)
class KeptRequest:
    """A request in the store's data.

    Attributes:
        key: its name; given twice, it is the same request.
        request: what is wanted.
        state: where it is.
        settled: when it ended [s]; None while it is pending.
        reason: why it ended so.
    """

    key: str
    request: Request
    state: RequestState = RequestState.PENDING
    settled: float | None = None
    reason: str = ""


def keep_request(session: Session, key: str, request: Request) -> None:
    """Accepts a request; the same one a second time changes nothing.

    Raises:
        RequestError: another request has that key.
    """
    row = session.scalar(select(RequestRow).where(RequestRow.key == key))
    if row is not None:
        if _kept(row).request != request:
            what = f"{key!r} is the key of another request"
            raise RequestError("", [Problem("key", what, "a key of its own")])
        return
    session.add(
        RequestRow(
            key=key,
            priority=request.priority,
            gtin=request.gtin,
            box=request.box,
            arrived=request.arrived,
            due=request.due,
            state=RequestState.PENDING.value,
            settled=None,
            reason="",
        )
    )
    session.flush()


def settle(session: Session, key: str, state: RequestState, at: float, reason: str = "") -> bool:
    """Ends a pending request; one that has ended stays as it is.

    Args:
        session: a transaction.
        key: the request.
        state: how it ends.
        at: when [s].
        reason: why, for people.

    Returns:
        Whether it was this call that ended it.

    Raises:
        SettingError: there is no such request, or `state` is no end.
    """
    if state is RequestState.PENDING:
        raise SettingError("state", "a request does not end pending", "another state")
    change = (
        update(RequestRow)
        .where(RequestRow.key == key, RequestRow.state == RequestState.PENDING.value)
        .values(state=state.value, settled=at, reason=reason)
        .returning(RequestRow.number)
    )
    if session.scalar(change) is not None:
        return True
    keys = session.scalars(select(RequestRow.key)).all()
    if key not in keys:
        raise SettingError(f"request {key}", "does not exist", exists=did_you_mean(key, keys))
    return False


def serve(session: Session, box: BoxId, gtin: Gtin | None, at: float) -> str | None:
    """Ends the most important pending request that a case serves; a case serves one at the most.

    Args:
        session: a transaction.
        box: the case that left the pallet.
        gtin: its product; None where nobody could tell.
        at: when [s]; requests that come later are not served.

    Returns:
        The key of the request, or None.
    """
    wanted = [RequestRow.box == box] + ([] if gtin is None else [RequestRow.gtin == gtin])
    query = (
        select(RequestRow.key)
        .where(RequestRow.state == RequestState.PENDING.value)
        .where(RequestRow.arrived <= at, or_(*wanted))
        .order_by(RequestRow.priority.desc(), RequestRow.arrived, RequestRow.number)
        .limit(1)
    )
    key = session.scalar(query)
    if key is not None:
        settle(session, key, RequestState.SERVED, at, f"by {box}")
    return key


def read_requests_in(session: Session, states: Iterable[RequestState]) -> tuple[KeptRequest, ...]:
    """The requests in some states, in the order in which they were accepted."""
    names = [state.value for state in states]
    query = select(RequestRow).where(RequestRow.state.in_(names)).order_by(RequestRow.number)
    return tuple(_kept(row) for row in session.scalars(query))


def _kept(row: RequestRow) -> KeptRequest:
    request = Request(
        priority=row.priority,
        gtin=None if row.gtin is None else Gtin(row.gtin),
        box=None if row.box is None else BoxId(row.box),
        arrived=row.arrived,
        due=row.due,
    )
    return KeptRequest(row.key, request, RequestState(row.state), row.settled, row.reason)
