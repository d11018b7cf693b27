"""The cell's own map of what stands where."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Self

from depal.domain import BoxId, Place, PlaceId
from depal.errors import SettingError, did_you_mean
from depal.logistics.placing.place_map import PlaceMap
from depal.logistics.placing.values import Standing


@dataclass(frozen=True, slots=True)
class Books:
    """Every compartment of the cell with its boxes. A box stands in one place at the most (I2).

    Attributes:
        maps: each place once, in the layout's order.
    """

    maps: tuple[PlaceMap, ...]

    @classmethod
    def empty(cls, places: Iterable[Place]) -> Self:
        """Books of compartments in which nothing stands."""
        return cls(tuple(PlaceMap(place) for place in places))

    def __post_init__(self) -> None:
        """Refuses books in which a place or a box occurs twice.

        Raises:
            SettingError: with the first that does.
        """
        seen: set[str] = set()
        names = [str(place_map.place.id) for place_map in self.maps]
        boxes = [str(box.id) for place_map in self.maps for box in place_map.boxes]
        for kind, name in [("place", name) for name in names] + [("box", name) for name in boxes]:
            if f"{kind} {name}" in seen:
                raise SettingError(f"{kind} {name}", "is in the books twice", "once")
            seen.add(f"{kind} {name}")

    @property
    def by_place(self) -> dict[PlaceId, PlaceMap]:
        """The maps by the names of their places."""
        return {place_map.place.id: place_map for place_map in self.maps}

    def at(self, place: PlaceId) -> PlaceMap:
        """What stands in a place.

        Raises:
            SettingError: there is no such place.
        """
        if place not in self.by_place:
            exists = did_you_mean(place, self.by_place)
            raise SettingError(f"place {place}", "is not in the books", exists=exists)
        return self.by_place[place]

    def where(self, box: BoxId) -> PlaceId | None:
        """In which place a box stands; None where in none."""
        for place_map in self.maps:
            if box in place_map.by_id:
                return place_map.place.id
        return None

    def put(self, place: PlaceId, box: Standing) -> "Books":
        """The books after a box came into a place.

        Raises:
            SettingError: it stands somewhere already, or there is no such place.
        """
        stood = self.where(box.id)
        if stood is not None:
            raise SettingError(
                f"box {box.id}", f"stands in {stood} already", "a box that stands nowhere"
            )
        return self._with(self.at(place).with_box(box))

    def take(self, box: BoxId) -> "Books":
        """The books after a box left its place.

        Raises:
            SettingError: it stands in none.
        """
        place = self.where(box)
        if place is None:
            stands = [other.id for place_map in self.maps for other in place_map.boxes]
            raise SettingError(f"box {box}", "stands in no place", exists=did_you_mean(box, stands))
        return self._with(self.at(place).without_box(box))

    def of(self, storage: str) -> tuple[PlaceMap, ...]:
        """The places of a trolley or a shelf."""
        return tuple(
            place_map
            for place_map in self.maps
            if place_map.place.id.split("/", maxsplit=1)[0] == storage
        )

    def exchanged(self, trolley: str) -> tuple["Books", tuple[PlaceMap, ...]]:
        """The books after an empty trolley came for a full one.

        Args:
            trolley: the name of its bay.

        Returns:
            The new books, and the places of the trolley that went with what stood in them.

        Raises:
            SettingError: there is no such trolley.
        """
        gone = self.of(trolley)
        if not gone:
            owners = {str(place.id).split("/", maxsplit=1)[0] for place in self._places()}
            raise SettingError(
                f"trolley {trolley}", "has no places", exists=did_you_mean(trolley, owners)
            )
        maps = tuple(
            PlaceMap(place_map.place) if place_map in gone else place_map for place_map in self.maps
        )
        return Books(maps), gone

    def _places(self) -> list[Place]:
        return [place_map.place for place_map in self.maps]

    def _with(self, changed: PlaceMap) -> "Books":
        maps = (changed if old.place.id == changed.place.id else old for old in self.maps)
        return replace(self, maps=tuple(maps))
