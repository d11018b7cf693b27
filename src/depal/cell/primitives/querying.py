"""The primitive of `query`: where the box goes, by the store's list and the room there is."""

import asyncio
from contextlib import suppress

from depal.cell.outbox import DEADLINE
from depal.cell.planning.desk import Desk
from depal.cell.workplace import Workplace
from depal.domain import BoxId, Gtin, PlaceId, StorageKind
from depal.errors import DeviceError
from depal.executive.engine import Call, Report
from depal.executive.events import Outcome
from depal.executive.runtime import Context

PAUSES = (1.0, 2.0, 4.0, 8.0, 8.0)
"""After a silence of the store's system it is asked again so much later [s]."""


class Querying:
    """Finds a place for a box."""

    def __init__(self, work: Workplace, desk: Desk) -> None:
        """Asks the store's system, then the desk for room."""
        self._work = work
        self._desk = desk

    async def ask_target(self, context: Context) -> Report:
        """The first place of the store's list that has room; a trolley is exchanged for room."""
        box, work = BoxId(context.args["Box"]), self._work
        await work.plans.passed()
        product = work.product_of(box)
        if product is None:
            return Report(outcome=Outcome.FAILED, reason="its product is not on the note")
        places = await self._asked(product.gtin)
        if places is None:
            return self._homeless(box, "the store's system does not answer")
        if not places:
            return self._homeless(box, f"the store knows no place for product {product.gtin}")
        work.homeless.discard(box)
        reason = "no place was tried"
        for _ in range(1 + len(work.layout.storages)):
            found = await self._desk.carrying.find_place(box, places)
            if work.product_of(box) != product:  # somebody has found out that it is another
                self._desk.promises.release(box)
                return Report(outcome=Outcome.FAILED, reason="it is another product after all")
            if not isinstance(found, str):
                return Report(((f"{box}.target", found.place),))
            reason = found
            trolley = self._to_exchange(places)
            if trolley is None:
                break
            await self._exchange(trolley)
        return Report(outcome=Outcome.FAILED, reason=f"no place has room: {reason}")

    async def _asked(self, gtin: Gtin) -> tuple[PlaceId, ...] | None:
        """The store's list; None where it stays silent."""
        for pause in PAUSES:
            with suppress(DeviceError, TimeoutError):
                places_for = self._work.ports.store.places_for
                return await asyncio.wait_for(places_for(gtin), DEADLINE)
            await asyncio.sleep(pause)
        return None

    def _homeless(self, box: BoxId, reason: str) -> Report:
        """Asked again, then set aside, whether it is in the hand by then or not."""
        self._work.homeless.add(box)
        return Report(outcome=Outcome.FAILED, reason=reason)

    def _to_exchange(self, places: tuple[PlaceId, ...]) -> str | None:
        """The first trolley of the list that holds something, whoever has put it there."""
        on_their_way = self._desk.promises.promised_places
        for place in places:
            storage = self._work.layout.storage(place)
            if any(promised.startswith(f"{storage.id}/") for promised in on_their_way):
                continue  # a box is on its way into it
            filled = any(
                place_map.boxes or place_map.place.id in self._desk.carrying.blocked
                for place_map in self._desk.promises.books.of(storage.id)
            )
            if storage.kind is StorageKind.TROLLEY and filled:
                return storage.id
        return None

    async def _exchange(self, trolley: str) -> None:
        work = self._work
        exchange = work.exchange_of(trolley)
        if exchange.begin():
            work.tell([(f"{trolley}.full", True), (f"{trolley}.seen", False)], "cell")
            work.allocate(Call("exchange", (trolley,)))
        await exchange.wait()
