"""The store's database: opened, brought to this depal's tables, closed."""

import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

from alembic import command
from alembic.config import Config
from alembic.script import ScriptDirectory
from alembic.util import CommandError
from sqlalchemy import Connection, Engine, create_engine, event, inspect, text
from sqlalchemy.engine import make_url
from sqlalchemy.exc import ArgumentError, SQLAlchemyError
from sqlalchemy.orm import Session
from sqlalchemy.pool import StaticPool

from depal.closing import Closing
from depal.errors import DeviceError, SettingError
from depal.logistics.store.served_tables import QueuedRow

IN_MEMORY = "sqlite://"
"""A database that is forgotten with the process."""

MIGRATIONS = Path(__file__).parent / "migrations"

STAMP, OLD_STAMP, FIRST = "alembic_version", "schema", "0001"
"""Where the version of the tables is written, and was before there were migrations."""

BUSY = 10_000
"""A transaction waits so long for another one to end [ms]."""


class Database(Closing):
    """A database with the tables of the store's data.

    A file may be used by several threads and processes at once: each transaction has a connection
    of its own and the right to write from its beginning, so none fails half-way because of
    another. A database in memory is used by the thread that opened it.
    """

    def __init__(self, url: str = IN_MEMORY) -> None:
        """Opens it; makes the tables where there are none, and brings older ones to this depal.

        Before older tables are changed, a copy of an SQLite file is laid beside it.

        Args:
            url: as SQLAlchemy takes it, for instance "sqlite:///store.db".

        Raises:
            SettingError: it cannot be opened, holds other tables, or was written by a newer depal.
        """
        self._name, self._engine = _engine(url)
        try:
            self._prepare()
        except (SQLAlchemyError, CommandError) as error:
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

    def copy_to(self, path: Path) -> None:
        """A consistent copy of an SQLite database, while others work with it.

        Raises:
            SettingError: the file is there already, or the database is of another kind.
        """
        if path.exists():
            raise SettingError(str(path), "is there already", "a new file")
        if self._engine.dialect.name != "sqlite":
            raise SettingError(self._name, "is no SQLite database", "its own tools for copies")
        with self._engine.connect() as connection:
            raw = connection.connection.driver_connection
            if raw is not None:
                raw.commit()
                raw.execute("VACUUM INTO ?", (str(path),))

    def close(self) -> None:
        """Lets go of it; closing twice is allowed."""
        self._engine.dispose()

    def _prepare(self) -> None:
        found = set(inspect(self._engine).get_table_names())
        if found and not found & {STAMP, OLD_STAMP}:
            raise SettingError(
                self._name,
                "is a database of something else",
                "an empty one, or one that depal wrote",
                f"its tables: {', '.join(sorted(found)[:8])}",
            )
        if self._engine.url.database is None or not found:
            self._make()
        else:
            self._migrate(found)
        if self._engine.dialect.name == "sqlite" and self._engine.url.database:
            with self._engine.connect() as connection:
                raw = connection.connection.driver_connection
                if raw is not None:
                    raw.rollback()
                    raw.execute("PRAGMA journal_mode = WAL")

    def _make(self) -> None:
        """All tables at once."""
        with self._engine.begin() as connection:
            QueuedRow.metadata.create_all(connection)
            command.stamp(_config(connection), "head")

    def _migrate(self, found: set[str]) -> None:
        """From the tables that are there to those of this depal."""
        head = newest()
        with self._engine.begin() as connection:
            stamped = STAMP in found
            query = text("SELECT version_num FROM alembic_version")
            version = (connection.scalar(query) if stamped else None) or FIRST
        if version == head:
            return
        if version > head:
            raise SettingError(
                self._name,
                f"was written by a newer depal, with version {version} of its tables",
                f"version {head} or an older one; update depal, or name another database",
            )
        self._keep_copy(version)
        with self._engine.begin() as connection:
            config = _config(connection)
            if OLD_STAMP in found:
                command.stamp(config, FIRST)
                connection.execute(text(f"DROP TABLE {OLD_STAMP}"))
            command.upgrade(config, "head")

    def _keep_copy(self, version: str) -> None:
        name = self._engine.url.database
        if self._engine.dialect.name == "sqlite" and name and Path(name).is_file():
            copy, part = Path(f"{name}.before-{version}"), Path(f"{name}.part")
            if copy.exists():
                return
            # Page by page through SQLite: what is still in a write-ahead log is copied as well.
            with closing(sqlite3.connect(name)) as old, closing(sqlite3.connect(part)) as new:
                old.backup(new)
            part.replace(copy)


def newest() -> str:
    """The version of the tables that this depal writes."""
    return ScriptDirectory(str(MIGRATIONS)).get_current_head() or ""


def _config(connection: Connection) -> Config:
    config = Config(attributes={"connection": connection})
    config.set_main_option("script_location", str(MIGRATIONS))
    return config


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
        event.listen(engine, "connect", _shared if not in_memory else _keep_references)
        event.listen(engine, "begin", _begin)
    return parsed.render_as_string(hide_password=True), engine


def _keep_references(connection: Any, _: object) -> None:  # noqa: ANN401 - any driver's connection
    connection.isolation_level = None  # transactions are begun below, and by nobody else
    connection.execute("PRAGMA foreign_keys = ON")


def _shared(connection: Any, record: object) -> None:  # noqa: ANN401 - any driver's connection
    _keep_references(connection, record)
    connection.execute(f"PRAGMA busy_timeout = {BUSY:d}")
    connection.execute("PRAGMA synchronous = FULL")


def _begin(connection: Connection) -> None:
    connection.exec_driver_sql("BEGIN IMMEDIATE")


def _cause(error: Exception) -> str:
    original = getattr(error, "orig", None)
    return str(original or error).splitlines()[0]
