"""The store's management system as a database beside the cell."""

import asyncio
from collections.abc import Iterable, Mapping, Sequence

from depal.closing import Closing
from depal.domain import BoxId, Delivery, Gtin, Place, PlaceId, Product, Request
from depal.logistics.store.assignment import assign_places
from depal.logistics.store.catalogue import (
    find_products,
    keep_assignments,
    keep_delivery,
    keep_places,
    keep_products,
    read_assignment,
    read_note,
    read_product,
)
from depal.logistics.store.database import IN_MEMORY, Database
from depal.logistics.store.request_book import (
    KeptRequest,
    RequestState,
    keep_request,
    read_requests_in,
    serve,
    settle,
)
from depal.logistics.store.stock import keep_movement, read_movements, read_stock
from depal.ports import Movement


class LocalStore(Closing):
    """A `StoreSystem` over a database; its other methods are for whoever keeps the data."""

    def __init__(self, database: Database | None = None, *, delay: float = 0.0) -> None:
        """A store.

        Args:
            database: its data; None for one in memory. It is closed with the store.
            delay: how long an answer takes [s, on the event loop's clock].
        """
        self.database = Database(IN_MEMORY) if database is None else database
        self._delay = delay

    async def places_for(self, gtin: Gtin) -> tuple[PlaceId, ...]:
        """Where a product belongs, best first; empty where the store does not know it."""
        await self._answer_time()
        return self.assignment(gtin)

    async def moved(self, movement: Movement) -> None:
        """Takes note of a case that was put away; told twice, it counts once."""
        await self._answer_time()
        self.note(movement)

    def assignment(self, gtin: Gtin) -> tuple[PlaceId, ...]:
        """Where a product belongs, best first; empty where nobody said."""
        with self.database.session() as session:
            return read_assignment(session, gtin)

    def assign(self, places: Mapping[Gtin, Sequence[PlaceId]]) -> None:
        """Says where products belong, best first.

        Raises:
            SettingError: a product or a place is not known.
        """
        with self.database.session() as session:
            keep_assignments(session, places)

    def seed_places(
        self,
        deliveries: Iterable[Delivery],
        places: Iterable[Place],
        *,
        unknown_share: float = 0.0,
        seed: int = 0,
    ) -> None:
        """Takes in deliveries and places, and assigns places to every product without any.

        See `assign_places` for the arguments.
        """
        deliveries, places = list(deliveries), list(places)
        planned = assign_places(deliveries, places, unknown_share=unknown_share, seed=seed)
        with self.database.session() as session:
            for delivery in deliveries:
                keep_delivery(session, delivery)
            keep_places(session, places)
            session.flush()
            fresh = {
                gtin: order for gtin, order in planned.items() if not read_assignment(session, gtin)
            }
            keep_assignments(session, fresh)

    def note_of(self, delivery: str) -> Delivery | None:
        """The note of a delivery; None where there is none of that name."""
        with self.database.session() as session:
            return read_note(session, delivery)

    def product(self, gtin: Gtin) -> Product | None:
        """A product; None where the store does not know it."""
        with self.database.session() as session:
            return read_product(session, gtin)

    def products(self, search: str, after: str, limit: int) -> tuple[Product, ...]:
        """Products whose name or number holds a text, by number, those after one."""
        with self.database.session() as session:
            return find_products(session, search, after, limit)

    def keep_product(self, product: Product) -> None:
        """Takes in a product; what was known of it before is replaced."""
        with self.database.session() as session:
            keep_products(session, [product])

    def keep_places(self, places: Iterable[Place]) -> None:
        """Takes in compartments."""
        with self.database.session() as session:
            keep_places(session, places)

    def accept(self, requests: Iterable[Request], source: str) -> tuple[str, ...]:
        """Accepts requests; the same ones from the same source a second time change nothing.

        Args:
            requests: what is wanted.
            source: where they come from: a file's name, a run's seed.

        Returns:
            Their keys: the source and a running number.

        Raises:
            RequestError: other requests came from that source.
        """
        keyed = {f"{source}#{number}": each for number, each in enumerate(requests, start=1)}
        with self.database.session() as session:
            for key, request in keyed.items():
                keep_request(session, key, request)
        return tuple(keyed)

    def requests(self, *states: RequestState) -> tuple[KeptRequest, ...]:
        """The requests in some states, or all of them, in the order of their acceptance."""
        with self.database.session() as session:
            return read_requests_in(session, states or tuple(RequestState))

    def pending(self, now: float) -> tuple[KeptRequest, ...]:
        """The requests that have come and not ended [s]."""
        return tuple(
            kept for kept in self.requests(RequestState.PENDING) if kept.request.arrived <= now
        )

    def serve(self, box: BoxId, gtin: Gtin | None, at: float) -> str | None:
        """Ends the most important pending request that a case serves, and returns its key."""
        with self.database.session() as session:
            return serve(session, box, gtin, at)

    def settle(self, key: str, state: RequestState, at: float, reason: str = "") -> bool:
        """Ends a request; False where it had ended before, and stays as it was.

        Raises:
            SettingError: there is no such request, or `state` is no end.
        """
        with self.database.session() as session:
            return settle(session, key, state, at, reason)

    def note(self, movement: Movement) -> bool:
        """Takes note of a movement; False where it was known."""
        with self.database.session() as session:
            return keep_movement(session, movement)

    def movements(self) -> tuple[Movement, ...]:
        """All movements in the order in which they were told."""
        with self.database.session() as session:
            return read_movements(session)

    def stock(self) -> dict[tuple[PlaceId, Gtin | None], int]:
        """How many cases of which product went into each place."""
        with self.database.session() as session:
            return read_stock(session)

    def close(self) -> None:
        """Lets go of the database; closing twice is allowed."""
        self.database.close()

    async def _answer_time(self) -> None:
        if self._delay > 0.0:
            await asyncio.sleep(self._delay)
