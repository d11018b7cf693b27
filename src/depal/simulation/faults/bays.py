"""Bays whose trolleys are not where they should be."""

from collections.abc import Callable, Sequence

from depal.domain import Gtin, PlaceId, StorageKind
from depal.executive.clock import Clock
from depal.ports import Bays
from depal.simulation.faults.catalogue import Phase
from depal.simulation.faults.chances import Chances
from depal.simulation.faults.plan import Struck
from depal.simulation.model import STRAY
from depal.simulation.referee import Referee
from depal.simulation.world import World


class FaultyBays:
    """Places that are not as the cell believes.

    T1: the empty trolley that a box is meant for is pulled out, and put back later. T2: somebody
    leaves a carton in the empty place that a box is meant for. T3: a trolley is exchanged.
    """

    def __init__(
        self,
        bays: Bays,
        world: World,
        clock: Clock,
        chances: Chances,
        take: Callable[[int], None],
    ) -> None:
        """Bays of this world; `take` takes a box out of the cell."""
        self._bays, self._world, self._clock, self._chances = bays, world, clock, chances
        self._referee = Referee(world)
        self._take = take
        self._places: dict[Gtin, tuple[PlaceId, ...]] = {}
        self._out: dict[str, tuple[str, Struck]] = {}
        self._left: Struck | None = None

    def trolley(self, bay: str) -> str | None:
        """The name of the trolley that stands locked in the bay."""
        self.put_back()
        return self._bays.trolley(bay)

    async def profile(self, place: PlaceId) -> tuple[float, ...]:
        """How far in a compartment is free."""
        self.put_back()
        return await self._bays.profile(place)

    def put_back(self) -> None:
        """What was away for long enough stands in its bay again, what was left is gone."""
        if self._left is not None and self._clock.now() >= self._left.until:
            self._left = None
            self._world.leave_stray(None)
        for bay, (name, struck) in list(self._out.items()):
            if self._clock.now() >= struck.until:
                del self._out[bay]
                if self._world.bays[bay] is None:
                    self._world.show_storage(bay, trolley=name)

    def _exchange(self, box: int, places: Sequence[PlaceId] | None) -> None:
        """Somebody takes a trolley with its boxes away and brings an empty one (T3)."""
        bays = dict.fromkeys(place.split("/")[0] for place in places or ())
        layout = self._world.layout
        trolleys = {s.id for s in layout.storages if s.kind is StorageKind.TROLLEY}
        bay = next((bay for bay in bays if bay in trolleys), None)
        if bay is None or self._chances.strikes("T3", Phase.GRASP, box) is None:
            return
        for truth in self._referee.boxes():
            if truth.where.startswith(f"{bay}/"):
                self._take(truth.index)
        self._world.show_storage(bay, trolley=f"{bay}#unasked")

    def _leave(self, box: int, places: Sequence[PlaceId] | None) -> None:
        """Somebody leaves a carton where the box is to go, where nothing stands (T2)."""
        if not places or any(truth.where == places[0] for truth in self._referee.boxes()):
            return
        struck = self._chances.strikes("T2", Phase.GRASP, box)
        if struck is not None:
            self._left = struck
            self._world.leave_stray(places[0], self._front(places[0]))

    def _front(self, place: PlaceId) -> float:
        """How far in the carton is left [m]."""
        most = max(self._world.layout.places[place].depth - STRAY[0], 0.0)
        return float(self._chances.dice(3).uniform(0.0, most))

    def asked_for(self, gtin: Gtin, places: Sequence[PlaceId]) -> None:
        """The store has named the places of a product."""
        self._places[gtin] = tuple(places)

    def grasped(self, box: int) -> None:
        """A box comes into the hand: the trolley that it is meant for may be gone."""
        places = self._places.get(self._world.cases[box].gtin)
        self._exchange(box, places)
        self._leave(box, places)
        storage = self._world.layout.storage(places[0]) if places else None
        if storage is None or storage.kind is not StorageKind.TROLLEY:
            return
        name = self._world.bays[storage.id]
        used = any(truth.where.startswith(f"{storage.id}/") for truth in self._referee.boxes())
        if name is None or used:
            return  # a trolley that boxes stand in is another fault
        struck = self._chances.strikes("T1", Phase.GRASP, box)
        if struck is not None:
            self._out[storage.id] = (name, struck)
            self._world.show_storage(storage.id, trolley=None)
