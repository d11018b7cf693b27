"""Which trolley stands in which bay: another one than before has come with nothing in it."""

from collections.abc import Iterable

from depal.domain import StorageKind
from depal.domain.layout import Storage
from depal.ports import Bays


class Trolleys:
    """The names of the trolleys, as the sensors of the bays have told them last."""

    def __init__(self, bays: Bays, storages: Iterable[Storage]) -> None:
        """Nobody has looked yet.

        Args:
            bays: the sensors.
            storages: of the cell; shelves are never exchanged.
        """
        self._bays = bays
        self._kept = [each.id for each in storages if each.kind is StorageKind.TROLLEY]
        self._known: dict[str, str] = {}

    def exchanged(self) -> tuple[str, ...]:
        """The bays in which another trolley stands than at the last look; told once."""
        found = []
        for bay in self._kept:
            name = self._bays.trolley(bay)
            if name is None:
                continue
            if self._known.setdefault(bay, name) != name:
                self._known[bay] = name
                found.append(bay)
        return tuple(found)
