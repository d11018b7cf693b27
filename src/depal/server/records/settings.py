"""The settings of the cell, kept over restarts."""

import json
from dataclasses import asdict, dataclass

from depal.logistics.store import Database
from depal.logistics.store.served_tables import SettingRow
from depal.server.cell import Settings
from depal.server.problems import Stale

CELL = "cell"


@dataclass(frozen=True, slots=True)
class Kept:
    """Settings with their version."""

    settings: Settings
    version: int


class KeptSettings:
    """Over the store's database."""

    def __init__(self, database: Database) -> None:
        """The settings in it."""
        self._database = database

    def get(self) -> Kept:
        """As they are."""
        with self._database.session() as session:
            row = session.get(SettingRow, CELL)
            if row is None:
                return Kept(Settings(), 1)
            return Kept(Settings(**json.loads(row.value)), row.version)

    def put(self, settings: Settings, version: int | None) -> Kept:
        """As they are from now on.

        Raises:
            Stale: somebody else has changed them.
        """
        with self._database.session() as session:
            row = session.get(SettingRow, CELL)
            known = 1 if row is None else row.version
            if version is not None and version != known:
                raise Stale(f"the settings have version {known} now")
            value = json.dumps(asdict(settings))
            session.merge(SettingRow(name=CELL, value=value, version=known + 1))
            return Kept(settings, known + 1)
