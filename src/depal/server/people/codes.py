"""The one-time code of the first start: whoever has it makes the first account."""

from sqlalchemy import delete

from depal.logistics.store import Database
from depal.logistics.store.served_tables import CodeRow
from depal.server.chance import Chance
from depal.server.people.digests import digest_of

LASTS = 86400.0
"""A code is good for so long [s]."""


class Codes:
    """One-time codes."""

    def __init__(self, database: Database, chance: Chance) -> None:
        """Over the store's database."""
        self._database, self._chance = database, chance

    def make(self) -> str:
        """A new code; the ones before are good no longer."""
        code = self._chance.secret(18)
        with self._database.session() as session:
            session.execute(delete(CodeRow))
            expires = self._chance.now() + LASTS
            session.add(CodeRow(digest=digest_of(code), expires=expires, used=None))
        return code

    def use(self, code: str) -> bool:
        """Whether it is good; from now on it is not."""
        now = self._chance.now()
        with self._database.session() as session:
            row = session.get(CodeRow, digest_of(code))
            if row is None or row.used is not None or now >= row.expires:
                return False
            row.used = now
            return True

    def good(self, code: str) -> bool:
        """Whether it is good, without using it."""
        with self._database.session() as session:
            row = session.get(CodeRow, digest_of(code))
            return row is not None and row.used is None and self._chance.now() < row.expires
