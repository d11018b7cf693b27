"""What was put where: movements, each once, whether they are told or read from a journal."""

from collections.abc import Callable, Iterable
from itertools import islice

from sqlalchemy import func, select
from sqlalchemy.orm import Session

from depal.domain import BoxId, Gtin, PlaceId
from depal.errors import JournalError
from depal.executive.journal import Journal, Record
from depal.logistics.store.database import Database
from depal.logistics.store.tables import MovementRow, ProjectionRow
from depal.ports import Movement

BATCH = 1000
"""How many events of a journal share a transaction, at the most."""

MovementsOf = Callable[[Record], Iterable[Movement]]
"""Which movements an event of a journal tells of; mostly none."""


def keep_movement(session: Session, movement: Movement) -> bool:
    """Takes note of a movement.

    Returns:
        Whether it was new; the first word on a movement counts.
    """
    if session.scalar(select(MovementRow.number).where(MovementRow.id == movement.id)) is not None:
        return False
    session.add(
        MovementRow(
            id=movement.id,
            box=movement.box,
            gtin=movement.gtin,
            place=movement.place,
            at=movement.at,
        )
    )
    session.flush()
    return True


def read_movements(session: Session) -> tuple[Movement, ...]:
    """All movements in the order in which they were told."""
    return tuple(
        Movement(
            id=row.id,
            box=BoxId(row.box),
            gtin=None if row.gtin is None else Gtin(row.gtin),
            place=PlaceId(row.place),
            at=row.at,
        )
        for row in session.scalars(select(MovementRow).order_by(MovementRow.number))
    )


def read_stock(session: Session) -> dict[tuple[PlaceId, Gtin | None], int]:
    """How many cases of which product went into each place."""
    query = (
        select(MovementRow.place, MovementRow.gtin, func.count())
        .group_by(MovementRow.place, MovementRow.gtin)
        .order_by(MovementRow.place, MovementRow.gtin)
    )
    return {
        (PlaceId(place), None if gtin is None else Gtin(gtin)): count
        for place, gtin, count in session.execute(query)
    }


class StockProjection:
    """The movements as they follow a journal: each event changes the stock exactly once.

    The number of the last event is written in the transaction that writes what the event changed,
    as `depal.executive.journal.Projection` does for plain SQLite; this one works with any
    database that the store uses.
    """

    def __init__(self, database: Database, movements_of: MovementsOf, name: str = "stock") -> None:
        """A consumer of a journal.

        Args:
            database: the store's.
            movements_of: reads the movements out of an event.
            name: of the consumer.
        """
        self._database = database
        self._movements_of = movements_of
        self._name = name

    @property
    def last(self) -> int:
        """The number of the last event that was applied; 0 where none was."""
        with self._database.session() as session:
            return self._last_in(session)

    def catch_up(self, journal: Journal) -> int:
        """Applies the events that it does not know yet.

        Args:
            journal: where the events are read.

        Returns:
            The number of the last event that was applied.

        Raises:
            JournalError: the journal ends before what was applied, or somebody else applied
                events meanwhile.
            DeviceError: the database refused; the batch was not applied.
        """
        known = self.last
        if known > journal.last:
            raise JournalError(
                f"projection {self._name!r} knows event {known}, and the journal ends at "
                f"{journal.last}: it is another journal or it lost events; restore it, or build "
                "the projection anew"
            )
        records = journal.read(after=known)
        while batch := list(islice(records, BATCH)):
            with self._database.session() as session:
                self._apply(session, batch, known)
            known = batch[-1].sequence
        return known

    def _apply(self, session: Session, batch: list[Record], known: int) -> None:
        found = self._last_in(session)
        if found != known:
            raise JournalError(
                f"projection {self._name!r} moved from event {known} to {found} by another hand; "
                "catch up again"
            )
        for record in batch:
            for movement in self._movements_of(record):
                keep_movement(session, movement)
        session.merge(ProjectionRow(name=self._name, last=batch[-1].sequence))

    def _last_in(self, session: Session) -> int:
        row = session.get(ProjectionRow, self._name)
        return 0 if row is None else row.last
