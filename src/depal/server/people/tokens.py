"""Tokens of services: random, shown once, kept as digests, expiring."""

from dataclasses import dataclass

from sqlalchemy import select

from depal.errors import Problem
from depal.logistics.store import Database
from depal.logistics.store.served_tables import TokenRow
from depal.server.chance import Chance
from depal.server.people.digests import digest_of
from depal.server.problems import NotFound, Unusable
from depal.server.roles import Principal, Role

PREFIX = "depal_"
"""How every token begins, so that one that has leaked is recognised."""

DAYS = 365
"""A token lasts so long at the most."""

NAME = 60
"""The longest name [characters]."""


@dataclass(frozen=True, slots=True)
class TokenView:
    """A token without its secret.

    Attributes:
        id: its name in the API.
        name: what it is for.
        created: seconds since 1970.
        expires: seconds since 1970.
        revoked: seconds since 1970; None while it is good.
    """

    id: str
    name: str
    created: float
    expires: float
    revoked: float | None


class Tokens:
    """The tokens of a cell."""

    def __init__(self, database: Database, chance: Chance) -> None:
        """Over the store's database."""
        self._database, self._chance = database, chance

    def add(self, name: str, days: float) -> tuple[TokenView, str]:
        """A new token; its secret is told this once.

        Raises:
            Unusable: a name or a time that cannot be used.
        """
        problems = []
        if not (1 <= len(name) <= NAME and name.isprintable()):
            problems.append(Problem("name", f"{name[:NAME]!r}", f"1 to {NAME} characters"))
        if not 0.0 < days <= DAYS:
            problems.append(Problem("days", f"{days!r}", f"more than 0 and at most {DAYS}"))
        if problems:
            raise Unusable("this token cannot be made", problems)
        secret, now = PREFIX + self._chance.secret(), self._chance.now()
        row = TokenRow(
            id=self._chance.secret(9),
            digest=digest_of(secret),
            name=name,
            created=now,
            expires=now + days * 86400.0,
            revoked=None,
        )
        with self._database.session() as session:
            session.add(row)
            session.flush()
            return _view(row), secret

    def list(self) -> tuple[TokenView, ...]:
        """All of them, the newest first."""
        with self._database.session() as session:
            rows = session.scalars(select(TokenRow).order_by(TokenRow.created.desc(), TokenRow.id))
            return tuple(_view(row) for row in rows)

    def revoke(self, name: str) -> TokenView:
        """It is good no longer.

        Raises:
            NotFound: there is no such token.
        """
        with self._database.session() as session:
            row = session.get(TokenRow, name)
            if row is None:
                raise NotFound(f"there is no token {name!r}")
            row.revoked = row.revoked or self._chance.now()
            return _view(row)

    def who(self, secret: str) -> Principal | None:
        """The service that a token is for; None where it is not good."""
        now = self._chance.now()
        with self._database.session() as session:
            row = session.scalar(select(TokenRow).where(TokenRow.digest == digest_of(secret)))
            if row is None or row.revoked is not None or not row.created <= now < row.expires:
                return None
            return Principal(f"service {row.name}", Role.SERVICE, via="token")


def _view(row: TokenRow) -> TokenView:
    return TokenView(row.id, row.name, row.created, row.expires, row.revoked)
