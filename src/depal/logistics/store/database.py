"""The store's database: opened, its version checked, closed."""

from collections.abc import Iterator
from contextlib import contextmanager
from types import TracebackType
from typing import Any, Self

from sqlalchemy import Engine, create_engine, event, inspect
from sqlalchemy.engine import make_url
from sqlalchemy.exc import ArgumentError, SQLAlchemyError
from sqlalchemy.orm import Session
from sqlalchemy.pool import StaticPool

from depal.errors import DeviceError, SettingError
from depal.logistics.store.tables import SchemaRow, Table

VERSION = 1
"""Of the tables that this depal writes."""

IN_MEMORY = "sqlite://"
"""A database that is forgotten with the process."""


class Database:
    """A database with the tables of the store's data. Used by the thread that opened it."""

    def __init__(self, url: str = IN_MEMORY) -> None:
        """Opens it; makes the tables where there are none.

        Args:
            url: as SQLAlchemy takes it, for instance "sqlite:///store.db".

        Raises:
            SettingError: it cannot be opened, holds other tables, or was written by a newer depal.
        """
        self._name, self._engine = _engine(url)
        try:
            self._prepare()
        except SQLAlchemyError as error:
            self.close()
            cause = _cause(error)
            raise SettingError(self._name, f"cannot be opened: {cause}", "a database") from error
        except BaseException:
            self.close()
            raise

    @contextmanager
    def session(self) -> Iterator[Session]:
        """A transaction: kept as a whole, or not at all where anything is raised in it.

        Raises:
            DeviceError: the database refused.
        """
        try:
            with Session(self._engine) as session, session.begin():
                yield session
        except SQLAlchemyError as error:
            raise DeviceError(
                f"the store's database {self._name}: nothing was changed: {_cause(error)}"
            ) from error

    def close(self) -> None:
        """Lets go of it; closing twice is allowed."""
        self._engine.dispose()

    def __enter__(self) -> Self:
        """The database itself."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Closes it."""
        self.close()

    def _prepare(self) -> None:
        found = set(inspect(self._engine).get_table_names())
        if found and SchemaRow.__tablename__ not in found:
            raise SettingError(
                self._name,
                "is a database of something else",
                "an empty one, or one that depal wrote",
                f"its tables: {', '.join(sorted(found)[:8])}",
            )
        with Session(self._engine) as session, session.begin():
            Table.metadata.create_all(session.connection())
            row = session.get(SchemaRow, 1)
            if row is None:
                session.add(SchemaRow(id=1, version=VERSION))
            elif row.version > VERSION:
                raise SettingError(
                    self._name,
                    f"was written by a newer depal, with version {row.version} of its tables",
                    f"version {VERSION}; update depal, or name another database",
                )


def _engine(url: str) -> tuple[str, Engine]:
    """The name of a database for people, without a password, and its engine."""
    try:
        parsed = make_url(url)
        in_memory = parsed.drivername.startswith("sqlite") and not parsed.database
        engine = create_engine(parsed, **({"poolclass": StaticPool} if in_memory else {}))
    except (ArgumentError, ModuleNotFoundError) as error:
        raise SettingError(
            url, f"is no database: {_cause(error)}", "a URL such as sqlite:///store.db"
        ) from error
    if engine.dialect.name == "sqlite":
        event.listen(engine, "connect", _keep_references)
    return parsed.render_as_string(hide_password=True), engine


def _keep_references(connection: Any, _: object) -> None:  # noqa: ANN401 - any driver's connection
    connection.execute("PRAGMA foreign_keys = ON")


def _cause(error: Exception) -> str:
    original = getattr(error, "orig", None)
    return str(original or error).splitlines()[0]
