"""The same request sent twice is one request: what the first came to is what the second gets."""

import json
from typing import Any

from sqlalchemy import delete
from sqlalchemy.orm import Session

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
            return _result(session, who, key, body)

    def claim(self, who: str, key: str, body: object, result: str) -> str:
        """What it is to come to; of several at once one sets that, and the others get the same.

        Args:
            who: asks; keys of different people have nothing to do with each other.
            key: of the request.
            body: what was asked for.
            result: of a request that is new.

        Raises:
            Unusable: the key was used for something else.
        """
        now = self._chance.now()
        with self._database.session() as session:
            session.execute(delete(RepeatRow).where(RepeatRow.at < now - KEPT))
            known = _result(session, who, key, body)
            if known is not None:
                return known
            row = RepeatRow(who=who, key=key, digest=_digest(body), result=result, at=now)
            session.add(row)
            return result

    def forget(self, who: str, key: str) -> None:
        """It has come to nothing: the key may be used again."""
        with self._database.session() as session:
            row = session.get(RepeatRow, (who, key))
            if row is not None:
                session.delete(row)


def _result(session: Session, who: str, key: str, body: object) -> str | None:
    row = session.get(RepeatRow, (who, key))
    if row is None:
        return None
    if row.digest != _digest(body):
        what = f"{key!r} was used for something else"
        problem = Problem("Idempotency-Key", what, "a key of its own")
        raise Unusable("this key was used for something else", [problem])
    return row.result


def _digest(body: Any) -> str:  # noqa: ANN401 - whatever JSON holds
    return digest_of(json.dumps(body, sort_keys=True, default=str))
