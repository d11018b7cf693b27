"""The same request sent twice is one request: what the first came to is what the second gets."""

import json
from typing import Any

from sqlalchemy import delete

from depal.errors import Problem
from depal.logistics.store import Database
from depal.logistics.store.served_tables import RepeatRow
from depal.server.chance import Chance
from depal.server.people.digests import digest_of
from depal.server.problems import Unusable

KEPT = 7 * 86400.0
"""So long a key is remembered [s]."""

LONGEST = 200
"""Of a key [characters]."""


class Repeats:
    """Over the store's database."""

    def __init__(self, database: Database, chance: Chance) -> None:
        """The keys in it."""
        self._database, self._chance = database, chance

    def seen(self, who: str, key: str, body: object) -> str | None:
        """What a request of that key has come to; None where it is new.

        Raises:
            Unusable: the key cannot be used, or was used for something else.
        """
        if not (1 <= len(key) <= LONGEST and key.isprintable()):
            problem = Problem("Idempotency-Key", f"{key[:40]!r}", f"1 to {LONGEST} characters")
            raise Unusable("this key cannot be used", [problem])
        with self._database.session() as session:
            row = session.get(RepeatRow, (who, key))
            if row is None:
                return None
            if row.digest != _digest(body):
                what = f"{key!r} was used for something else"
                problem = Problem("Idempotency-Key", what, "a key of its own")
                raise Unusable("this key was used for something else", [problem])
            return row.result

    def keep(self, who: str, key: str, body: object, result: str) -> None:
        """What it has come to."""
        now = self._chance.now()
        with self._database.session() as session:
            session.execute(delete(RepeatRow).where(RepeatRow.at < now - KEPT))
            session.merge(RepeatRow(who=who, key=key, digest=_digest(body), result=result, at=now))


def _digest(body: Any) -> str:  # noqa: ANN401 - whatever JSON holds
    return digest_of(json.dumps(body, sort_keys=True, default=str))
