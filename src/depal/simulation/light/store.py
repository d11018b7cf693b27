"""The store's system beside a light world: it outlives every controller."""

from collections.abc import Mapping

from depal.domain import Gtin, PlaceId
from depal.ports import Movement
from depal.simulation.light.life import Life


class LightStore:
    """Lists of places, and the movements that it was told, each once by its id.

    Attributes:
        movements: in the order in which they were first told.
        told: how often somebody has told one, the same one counted again.
    """

    def __init__(self, places: Mapping[Gtin, tuple[PlaceId, ...]]) -> None:
        """Nothing was moved."""
        self._places = places
        self.movements: dict[str, Movement] = {}
        self.told = 0

    def places_for(self, gtin: Gtin) -> tuple[PlaceId, ...]:
        """Where a product belongs."""
        return self._places.get(gtin, ())

    def moved(self, movement: Movement) -> None:
        """Takes note."""
        self.told += 1
        self.movements.setdefault(movement.id, movement)


class StoreLine:
    """The line of one controller to the store's system."""

    def __init__(self, store: LightStore, life: Life) -> None:
        """Dead once the controller is."""
        self._store, self._life = store, life

    async def places_for(self, gtin: Gtin) -> tuple[PlaceId, ...]:
        """Where a product belongs, best first."""
        self._life.check()
        return self._store.places_for(gtin)

    async def moved(self, movement: Movement) -> None:
        """Takes note of a case that was put away."""
        self._life.check()
        self._store.moved(movement)
