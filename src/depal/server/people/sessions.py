"""Who is signed in: a secret in the browser, its digest here."""

from sqlalchemy import delete

from depal.logistics.store import Database
from depal.logistics.store.served_tables import AccountRow, SessionRow
from depal.server.chance import Chance
from depal.server.people.digests import digest_of
from depal.server.roles import Principal, Role

IDLE, LONGEST = 12 * 3600.0, 7 * 86400.0
"""A session ends after so long without use, and after so long in any case [s]."""

FRESH = 60.0
"""Its last use is written so often at the most [s]."""


class Sessions:
    """The sessions of a cell."""

    def __init__(self, database: Database, chance: Chance) -> None:
        """Over the store's database."""
        self._database, self._chance = database, chance

    def open(self, account: str) -> str:
        """Somebody has signed in; returns the secret for their browser."""
        secret, now = self._chance.secret(), self._chance.now()
        with self._database.session() as session:
            old = SessionRow.created < now - LONGEST
            session.execute(delete(SessionRow).where(old))
            session.add(
                SessionRow(digest=digest_of(secret), account=account, created=now, seen=now)
            )
        return secret

    def who(self, secret: str) -> Principal | None:
        """Who it is; None where the session has ended or never was."""
        now = self._chance.now()
        with self._database.session() as session:
            row = session.get(SessionRow, digest_of(secret))
            if row is None:
                return None
            # A clock that was set back must not make a session last longer.
            if now - row.seen > IDLE or now - row.created > LONGEST or now < row.created - FRESH:
                session.delete(row)
                return None
            if now - row.seen > FRESH:
                row.seen = now
            account = session.get(AccountRow, row.account)
            return None if account is None else Principal(account.name, Role(account.role))

    def close(self, secret: str) -> None:
        """They have signed out."""
        with self._database.session() as session:
            row = session.get(SessionRow, digest_of(secret))
            if row is not None:
                session.delete(row)
