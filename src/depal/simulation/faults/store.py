"""A store's system that is silent, slow, told twice, or knows no place."""

import asyncio
from collections.abc import Callable

from depal.domain import Gtin, PlaceId
from depal.errors import DeviceError
from depal.executive.clock import Clock
from depal.ports import Movement, StoreSystem
from depal.simulation.faults.catalogue import Phase
from depal.simulation.faults.chances import Chances

SILENCE = 1.0
"""After so long nobody waits for an answer any more [s]."""


class FaultyStore:
    """W1 to W3 and W6."""

    def __init__(
        self,
        store: StoreSystem,
        clock: Clock,
        chances: Chances,
        told: Callable[[Gtin, tuple[PlaceId, ...]], None],
    ) -> None:
        """A store whose answers may fail; `told` hears of every answer that names places."""
        self._store, self._clock, self._chances, self._told = store, clock, chances, told

    async def places_for(self, gtin: Gtin) -> tuple[PlaceId, ...]:
        """Where a product belongs.

        Raises:
            DeviceError: no answer came in time.
        """
        await self._answers(Phase.QUERY)
        if self._chances.strikes("W3", Phase.QUERY) is not None:
            await self._store.places_for(gtin)
        if self._chances.lasts("W6", Phase.QUERY) is not None:
            return ()
        places = await self._store.places_for(gtin)
        self._told(gtin, places)
        return places

    async def moved(self, movement: Movement) -> None:
        """Takes note of a case that was put away.

        Raises:
            DeviceError: no answer came in time.
        """
        await self._answers(Phase.TELL)
        await self._store.moved(movement)
        if self._chances.strikes("W3", Phase.TELL) is not None:
            await self._store.moved(movement)

    async def _answers(self, phase: Phase) -> None:
        if self._chances.lasts("W1", phase) is not None:
            await asyncio.sleep(SILENCE)
            raise DeviceError("the store's system does not answer")
        slow = self._chances.lasts("W2", phase)
        if slow is not None:
            await asyncio.sleep(max(slow.until - self._clock.now(), 0.0))
