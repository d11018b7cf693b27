"""The tables of a served cell: its queue, its runs, its questions, and the people around it.

Times are seconds since 1970; a request's own times are on the cell's clock.
"""

from sqlalchemy import ForeignKey, Index
from sqlalchemy.orm import Mapped, mapped_column

from depal.logistics.store.tables import Table


class QueuedRow(Table):
    """An uploaded delivery, whole: its note, and its stack where the world is simulated."""

    __tablename__ = "queue"

    id: Mapped[str] = mapped_column(primary_key=True)
    body: Mapped[str]
    by: Mapped[str]
    at: Mapped[float]
    state: Mapped[str]
    position: Mapped[int]
    version: Mapped[int]


class RunRow(Table):
    """One attempt to empty a delivery's pallet."""

    __tablename__ = "runs"

    number: Mapped[int] = mapped_column(primary_key=True)
    delivery: Mapped[str] = mapped_column(ForeignKey("queue.id"))
    state: Mapped[str]
    by: Mapped[str]
    began: Mapped[float]
    ended: Mapped[float | None]
    result: Mapped[str]


class QuestionRow(Table):
    """A question to the supervising person."""

    __tablename__ = "questions"

    id: Mapped[str] = mapped_column(primary_key=True)
    run: Mapped[int]
    text: Mapped[str]
    choices: Mapped[str]
    about: Mapped[str]
    asked: Mapped[float]
    answered: Mapped[float | None]
    answer: Mapped[str | None]
    by: Mapped[str | None]


class RequestOriginRow(Table):
    """Who made a request, when, for which run, and how often it was changed."""

    __tablename__ = "request_origins"

    key: Mapped[str] = mapped_column(ForeignKey("requests.key"), primary_key=True)
    run: Mapped[int | None]
    by: Mapped[str]
    created: Mapped[float]
    due: Mapped[float | None]
    version: Mapped[int]


class PictureRow(Table):
    """A picture of a product's face."""

    __tablename__ = "pictures"

    gtin: Mapped[str] = mapped_column(ForeignKey("products.gtin"), primary_key=True)
    face: Mapped[str] = mapped_column(primary_key=True)
    type: Mapped[str]
    body: Mapped[bytes]
    by: Mapped[str]
    at: Mapped[float]


class RepeatRow(Table):
    """What a request with an idempotency key has come to."""

    __tablename__ = "repeats"

    who: Mapped[str] = mapped_column(primary_key=True)
    key: Mapped[str] = mapped_column(primary_key=True)
    digest: Mapped[str]
    result: Mapped[str]
    at: Mapped[float]


class AccountRow(Table):
    """A person; the password as argon2id has hashed it."""

    __tablename__ = "accounts"

    name: Mapped[str] = mapped_column(primary_key=True)
    role: Mapped[str]
    password: Mapped[str]
    created: Mapped[float]
    version: Mapped[int]


class SessionRow(Table):
    """Somebody who is signed in; the secret is in the browser alone, here is its digest."""

    __tablename__ = "sessions"

    digest: Mapped[str] = mapped_column(primary_key=True)
    account: Mapped[str] = mapped_column(ForeignKey("accounts.name"))
    created: Mapped[float]
    seen: Mapped[float]


class TokenRow(Table):
    """A service's token; shown once, here is its digest."""

    __tablename__ = "tokens"

    id: Mapped[str] = mapped_column(primary_key=True)
    digest: Mapped[str] = mapped_column(unique=True)
    name: Mapped[str]
    created: Mapped[float]
    expires: Mapped[float]
    revoked: Mapped[float | None]


class CodeRow(Table):
    """A one-time code that makes the first account."""

    __tablename__ = "codes"

    digest: Mapped[str] = mapped_column(primary_key=True)
    expires: Mapped[float]
    used: Mapped[float | None]


class AuditRow(Table):
    """A command that somebody gave; each row seals the one before."""

    __tablename__ = "audit"

    number: Mapped[int] = mapped_column(primary_key=True)
    at: Mapped[float]
    who: Mapped[str]
    role: Mapped[str]
    via: Mapped[str]
    what: Mapped[str]
    detail: Mapped[str]
    outcome: Mapped[str]
    seal: Mapped[str]

    __table_args__ = (Index("audit_by_person", "who", "at"),)


class SettingRow(Table):
    """A setting of the cell."""

    __tablename__ = "settings"

    name: Mapped[str] = mapped_column(primary_key=True)
    value: Mapped[str]
    version: Mapped[int]
