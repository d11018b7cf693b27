"""The audit log: every command, append-only, each line sealed with the one before."""

import hashlib
import json
from dataclasses import dataclass

from sqlalchemy import select

from depal.logistics.store import Database
from depal.logistics.store.served_tables import AuditRow
from depal.server.chance import Chance
from depal.server.roles import Principal

GENESIS = "0" * 64


@dataclass(frozen=True, slots=True)
class AuditLine:
    """A command that somebody gave.

    Attributes:
        number: of the line.
        at: seconds since 1970.
        who: the account, or "nobody".
        role: of the account.
        via: how they signed in.
        what: the use case.
        detail: its arguments without secrets, as JSON.
        outcome: "done", or why not.
    """

    number: int
    at: float
    who: str
    role: str
    via: str
    what: str
    detail: str
    outcome: str


class AuditLog:
    """Over the store's database."""

    def __init__(self, database: Database, chance: Chance) -> None:
        """Goes on where the log ends."""
        self._database, self._chance = database, chance

    def write(
        self, who: Principal | None, what: str, detail: dict[str, object], outcome: str
    ) -> None:
        """One more line."""
        told = json.dumps(detail, sort_keys=True, default=str, ensure_ascii=False)
        with self._database.session() as session:
            last = session.scalar(select(AuditRow).order_by(AuditRow.number.desc()).limit(1))
            line = AuditLine(
                1 if last is None else last.number + 1,
                self._chance.now(),
                "nobody" if who is None else who.name,
                "" if who is None else who.role.value,
                "" if who is None else who.via,
                what,
                told,
                outcome,
            )
            seal = sealed(line, GENESIS if last is None else last.seal)
            session.add(AuditRow(**_fields(line), seal=seal))

    def list(self, after: int = 0, limit: int = 100) -> tuple[AuditLine, ...]:
        """The lines after a number, in order."""
        with self._database.session() as session:
            query = select(AuditRow).where(AuditRow.number > after).order_by(AuditRow.number)
            return tuple(_line(row) for row in session.scalars(query.limit(limit)))

    def verify(self) -> int | None:
        """The number of the first line that is missing or was edited; None where all are whole."""
        seal, expected = GENESIS, 1
        with self._database.session() as session:
            for row in session.scalars(select(AuditRow).order_by(AuditRow.number)):
                seal = sealed(_line(row), seal)
                if row.number != expected or row.seal != seal:
                    return expected
                expected += 1
        return None


def sealed(line: AuditLine, before: str) -> str:
    """The seal of a line: SHA-256 over the seal before it and all that it says."""
    told = json.dumps([before, *_fields(line).values()], ensure_ascii=False)
    return hashlib.sha256(told.encode()).hexdigest()


def _fields(line: AuditLine) -> dict[str, int | float | str]:
    return {
        "number": line.number,
        "at": line.at,
        "who": line.who,
        "role": line.role,
        "via": line.via,
        "what": line.what,
        "detail": line.detail,
        "outcome": line.outcome,
    }


def _line(row: AuditRow) -> AuditLine:
    return AuditLine(
        row.number, row.at, row.who, row.role, row.via, row.what, row.detail, row.outcome
    )
