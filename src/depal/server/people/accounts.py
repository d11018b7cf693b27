"""People with a name, a role and a password."""

import threading
from dataclasses import dataclass

from argon2 import PasswordHasher
from argon2.exceptions import InvalidHashError, VerifyMismatchError
from sqlalchemy import delete, func, select
from sqlalchemy.orm import Session

from depal.errors import Problem
from depal.logistics.store import Database
from depal.logistics.store.served_tables import AccountRow, SessionRow
from depal.server.chance import Chance
from depal.server.problems import Conflict, NotFound, Stale, TooMany, Unusable
from depal.server.roles import PEOPLE, Role

SHORTEST, LONGEST = 10, 200
"""Of a password [characters]."""

NAME = 40
"""The longest name [characters]."""


AT_ONCE, PATIENCE = 2, 1.0
"""So many passwords are checked at once, each with much memory; others wait so long [s]."""


@dataclass(frozen=True, slots=True)
class PersonView:
    """A person as others see them.

    Attributes:
        name: of the account.
        role: of the person.
        created: seconds since 1970.
        version: rises with every change.
    """

    name: str
    role: Role
    created: float
    version: int


class Accounts:
    """The accounts of a cell; at least one integrator is always left."""

    def __init__(self, database: Database, chance: Chance, hasher: PasswordHasher) -> None:
        """Over the store's database.

        Args:
            database: where accounts are.
            chance: time.
            hasher: argon2id with its cost.
        """
        self._database, self._chance, self._hasher = database, chance, hasher
        self._nobody = hasher.hash("nobody has this password")
        self._turns = threading.BoundedSemaphore(AT_ONCE)

    @property
    def any(self) -> bool:
        """Whether there is anybody."""
        with self._database.session() as session:
            return bool(session.scalar(select(func.count()).select_from(AccountRow)))

    def list(self) -> tuple[PersonView, ...]:
        """Everybody, by name."""
        with self._database.session() as session:
            rows = session.scalars(select(AccountRow).order_by(AccountRow.name))
            return tuple(_view(row) for row in rows)

    def add(self, name: str, role: Role, password: str) -> PersonView:
        """One more person.

        Raises:
            Unusable: the name, the role or the password cannot be used.
            Conflict: the name is taken.
        """
        self.check(name, role, password)
        hashed = self._hasher.hash(password)
        with self._database.session() as session:
            if session.get(AccountRow, name) is not None:
                raise Conflict(f"there is a person called {name!r} already")
            row = AccountRow(
                name=name, role=role.value, password=hashed, created=self._chance.now(), version=1
            )
            session.add(row)
            return _view(row)

    def check(self, name: str, role: Role, password: str) -> None:
        """Whether such an account could be made.

        Raises:
            Unusable: the name, the role or the password cannot be used.
        """
        problems = [*_name_problems(name), *_role_problems(role), *_password_problems(password)]
        if problems:
            raise Unusable("this account cannot be made", problems)

    def change(self, name: str, role: Role, version: int | None = None) -> PersonView:
        """Another role; of the version that is given, or of any.

        Raises:
            NotFound: there is nobody of that name.
            Stale: somebody has changed it.
            Conflict: the last integrator would be gone.
        """
        problems = _role_problems(role)
        if problems:
            raise Unusable("this role cannot be given", problems)
        with self._database.session() as session:
            row = _row(session, name, version)
            if role is not Role.INTEGRATOR:
                _keep_one(session, row)
            row.role, row.version = role.value, row.version + 1
            session.execute(delete(SessionRow).where(SessionRow.account == name))
            return _view(row)

    def set_password(self, name: str, password: str) -> None:
        """Another password; who is signed in by the old one no longer is.

        Raises:
            NotFound: there is nobody of that name.
            Unusable: the password cannot be used.
        """
        problems = _password_problems(password)
        if problems:
            raise Unusable("this password cannot be used", problems)
        hashed = self._hasher.hash(password)
        with self._database.session() as session:
            row = _row(session, name)
            row.password, row.version = hashed, row.version + 1
            session.execute(delete(SessionRow).where(SessionRow.account == name))

    def remove(self, name: str, version: int | None = None) -> None:
        """Somebody leaves.

        Raises:
            NotFound: there is nobody of that name.
            Stale: somebody has changed it.
            Conflict: the last integrator would be gone.
        """
        with self._database.session() as session:
            row = _row(session, name, version)
            _keep_one(session, row)
            session.execute(delete(SessionRow).where(SessionRow.account == name))
            session.delete(row)

    def matches(self, name: str, password: str) -> PersonView | None:
        """The person of that name with that password; as slow where there is none.

        Raises:
            TooMany: many others are signing in at this moment.
        """
        with self._database.session() as session:
            row = session.get(AccountRow, name)
            kept = self._nobody if row is None else row.password
            view = None if row is None else _view(row)
        if not self._turns.acquire(timeout=PATIENCE):
            raise TooMany("many people sign in at this moment; try again", after=PATIENCE)
        try:
            self._hasher.verify(kept, password[:LONGEST])
        except (VerifyMismatchError, InvalidHashError):
            return None
        finally:
            self._turns.release()
        return view


def _view(row: AccountRow) -> PersonView:
    return PersonView(row.name, Role(row.role), row.created, row.version)


def _row(session: Session, name: str, version: int | None = None) -> AccountRow:
    row = session.get(AccountRow, name)
    if row is None:
        raise NotFound(f"there is no person called {name!r}")
    if version is not None and version != row.version:
        raise Stale(f"{name!r} has version {row.version} now")
    return row


def _keep_one(session: Session, row: AccountRow) -> None:
    if row.role != Role.INTEGRATOR.value:
        return
    others = (
        select(func.count())
        .select_from(AccountRow)
        .where(AccountRow.role == Role.INTEGRATOR.value, AccountRow.name != row.name)
    )
    if not session.scalar(others):
        raise Conflict(f"{row.name!r} is the last integrator; make another one first")


def _name_problems(name: str) -> list[Problem]:
    plain = name.isprintable() and name == name.strip() and "/" not in name
    if 1 <= len(name) <= NAME and plain and set(name) != {"."}:
        return []
    return [Problem("name", f"{name[:NAME]!r}", f"1 to {NAME} printable characters, no slash")]


def _role_problems(role: Role) -> list[Problem]:
    if role in PEOPLE:
        return []
    names = ", ".join(sorted(each.value for each in PEOPLE))
    return [Problem("role", f"{role.value!r} is no role of a person", names)]


def _password_problems(password: str) -> list[Problem]:
    if SHORTEST <= len(password) <= LONGEST:
        return []
    return [
        Problem("password", f"has {len(password)} characters", f"{SHORTEST} to {LONGEST} of them")
    ]
