"""What is planned and not yet done: kept picks, promised spots, and where the arm will be."""

import asyncio
from collections.abc import Collection, Iterator
from collections.abc import Set as AbstractSet
from contextlib import contextmanager

from depal.cell.pile import Pile
from depal.cell.planning.plans import CarryPlan, PickPlan
from depal.cell.planning.surroundings import ShapeOf, Surroundings, as_it_looks
from depal.domain import BoxId, CellLayout, Joints, PlaceId
from depal.geometry import OrientedBox
from depal.logistics.placing import Books, Standing
from depal.motion.collision import Scene


class Promises:
    """Keeps plans until they are followed, and books and surroundings in step with them.

    Attributes:
        books: what stands where, promised spots included.
        next_start: where the arm will be next [rad]; None where it stands.
    """

    def __init__(self, layout: CellLayout) -> None:
        """Nothing is promised, and every place is empty."""
        self._around = Surroundings(layout)
        self._picks: dict[BoxId, PickPlan] = {}
        self._carries: dict[BoxId, CarryPlan] = {}
        self._searching: dict[BoxId, asyncio.Event] = {}
        self._reached: set[BoxId] = set()
        self.books = Books.empty(layout.places.values())
        self.next_start: Joints | None = None

    def scene(
        self,
        pile: Pile,
        without: BoxId | None = None,
        zones: AbstractSet[str] = frozenset(),
        shape_of: ShapeOf = as_it_looks,
    ) -> Scene:
        """Everything that stands around or will, with what is avoided.

        Args:
            pile: on the pallet.
            without: a box that is left out.
            zones: that are avoided.
            shape_of: the room that is kept clear for each box of the pile.
        """
        return self._around.scene(pile, without, zones, shape_of)

    def standing(self, box: BoxId, place: PlaceId) -> OrientedBox | None:
        """A box that stands in a place, in the cell frame; None where it does not."""
        solid = self._around.where(box)
        return solid if self.books.where(box) == place else None

    @property
    def promised(self) -> frozenset[BoxId]:
        """The boxes of the books that do not stand in their places yet."""
        return frozenset(self._carries)

    @property
    def promised_places(self) -> frozenset[PlaceId]:
        """The places that boxes are on their way into, or will be."""
        return frozenset(plan.place for plan in self._carries.values())

    # Picks

    def pick_of(self, box: BoxId) -> PickPlan | None:
        """How a box will be taken, where that is known."""
        return self._picks.get(box)

    def pick_in_hand(self, box: BoxId) -> PickPlan:
        """The pick that brought the arm to the box."""
        return self._picks[box]

    def keep_pick(self, plan: PickPlan) -> None:
        """This is how the box will be taken."""
        self._picks[plan.box.id] = plan

    def forget_pick(self, box: BoxId) -> None:
        """The box is to be planned for anew."""
        self._picks.pop(box, None)
        self._reached.discard(box)
        self.release(box)

    def reach(self, box: BoxId) -> None:
        """The arm sets out for the box: the way to hold it does not change for a place any more."""
        self._reached.add(box)

    def may_change(self, box: BoxId) -> bool:
        """Whether the box may still be held another way."""
        return box in self._picks and box not in self._reached

    @contextmanager
    def searching(self, box: BoxId) -> Iterator[None]:
        """While a place is searched for a box; broken off or not, nobody waits afterwards."""
        over = self._searching.setdefault(box, asyncio.Event())
        try:
            yield
        finally:
            over.set()
            self._searching.pop(box, None)

    async def searched(self, box: BoxId) -> None:
        """Waits while a place is being searched for a box."""
        if box in self._searching:
            await self._searching[box].wait()

    # Places

    def carry_of(self, box: BoxId) -> CarryPlan | None:
        """How a box gets into its place, where that is known."""
        return self._carries.get(box)

    def carry_in_hand(self, box: BoxId) -> CarryPlan:
        """The plan that brought the held box into its place."""
        return self._carries[box]

    def keep_carry(self, plan: CarryPlan) -> None:
        """The place is promised: nobody else gets it."""
        box = plan.load.box
        self.release(box)
        self.books = self.books.put(plan.place, plan.spot.standing(box, plan.load.mass))
        self._carries[box] = plan
        self._around.put(box, plan.place, OrientedBox(plan.target, plan.load.size))

    def release(self, box: BoxId) -> None:
        """The box does not go where it was promised to; somebody else may have the spot."""
        if self._carries.pop(box, None) is not None:
            self.books = self.books.take(box)
            self._around.take(box)

    def give_way(self, box: BoxId, places: Collection[PlaceId]) -> None:
        """A box that hangs in the hand gets its place first: what comes later is planned anew.

        Else it could be put onto the spot of a box that is not there yet.

        Args:
            box: in the hand, without a place.
            places: that it may go to.
        """
        later = [each for each, plan in self._carries.items() if plan.place in places]
        for each in later:
            if each != box:
                self.release(each)

    def forget_carry(self, box: BoxId) -> None:
        """The box did not get to its place."""
        self.release(box)
        self.next_start = None

    def confirm(self, plan: CarryPlan) -> None:
        """The box stands where it was planned."""
        self._carries.pop(plan.load.box, None)
        self._picks.pop(plan.load.box, None)

    def stored(self) -> Iterator[tuple[Standing, PlaceId, OrientedBox]]:
        """What stands in places or is promised to: in the place's frame and in the cell's."""
        for place_map in self.books.maps:
            for box in place_map.boxes:
                solid = self._around.where(box.id)
                if solid is not None:
                    yield box, place_map.place.id, solid

    def stands(self, place: PlaceId, box: Standing, solid: OrientedBox) -> None:
        """A box stands in a place, as was written before a restart."""
        self.books = self.books.put(place, box)
        self._around.put(box.id, place, solid)

    def gone(self, box: BoxId) -> None:
        """Somebody has taken a box out of its place."""
        if self.books.where(box) is not None:
            self.books = self.books.take(box)
            self._around.take(box)

    def replaced(self, trolley: str) -> None:
        """Another trolley stands in the bay, and nobody was asked for it: the spots are gone."""
        for box, plan in list(self._carries.items()):
            if plan.place.startswith(f"{trolley}/"):
                self.release(box)
        self.exchanged(trolley)

    def exchanged(self, trolley: str) -> None:
        """An empty trolley stands in the bay."""
        self.books, gone = self.books.exchanged(trolley)
        self._around.empty(place_map.place.id for place_map in gone)
