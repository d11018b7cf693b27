"""A store's system that knows what a test says."""

import asyncio
from collections.abc import Mapping
from dataclasses import dataclass, field

from depal.domain import Gtin, PlaceId
from depal.errors import DeviceError
from depal.ports.people import Movement


@dataclass(slots=True)
class FakeStore:
    """A mapping from products to places.

    Attributes:
        places: where products belong, best first.
        delay: of every answer [s].
        silent: the numbers of the questions that get no answer; the first is 0.
        questions: the products that it was asked for, in order.
        movements: what it was told, in order.
    """

    places: Mapping[Gtin, tuple[PlaceId, ...]]
    delay: float = 0.0
    silent: frozenset[int] = frozenset()
    questions: list[Gtin] = field(default_factory=list)
    movements: list[Movement] = field(default_factory=list)

    async def places_for(self, gtin: Gtin) -> tuple[PlaceId, ...]:
        """Where a product belongs; empty where nobody said."""
        number = len(self.questions)
        self.questions.append(gtin)
        await asyncio.sleep(self.delay)
        if number in self.silent:
            raise DeviceError("the store's system did not answer in time")
        return self.places.get(gtin, ())

    async def moved(self, movement: Movement) -> None:
        """Takes note, once."""
        await asyncio.sleep(self.delay)
        if movement not in self.movements:
            self.movements.append(movement)
