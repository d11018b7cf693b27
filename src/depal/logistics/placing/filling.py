"""How full places become before they are declared full: a study without arm and physics."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from depal.domain import BoxId, Delivery, Place
from depal.errors import DeliveryError, Problem
from depal.logistics.placing.books import Books
from depal.logistics.placing.candidates import Weights
from depal.logistics.placing.finding import WEIGHTS, find_spots
from depal.logistics.placing.values import MARGINS, Held, Margins, Standing


@dataclass(frozen=True, slots=True)
class Arrival:
    """A box that comes from the pallet.

    Attributes:
        box: its name.
        ways: how it can be turned for pushing it in.
    """

    box: BoxId
    ways: tuple[Held, ...]


@dataclass(frozen=True, slots=True)
class Filling:
    """What came of some deliveries.

    Attributes:
        fills: the share of its volume that boxes took, of every place that was declared full: of
            every place on a trolley that was exchanged because none of all places took a box.
        stored: how many boxes found a place.
        refused: how many found none even in an empty trolley.
    """

    fills: tuple[float, ...]
    stored: int
    refused: int

    @property
    def mean(self) -> float:
        """The mean fill of places declared full; 0 where none was."""
        return sum(self.fills) / len(self.fills) if self.fills else 0.0


def arrivals(delivery: Delivery, order: Sequence[int]) -> tuple[Arrival, ...]:
    """The boxes of a delivery as the arm brings them, each held in two ways.

    A box held by the side that faced the robot lies with its extent along the pallet's y in the
    way in; a quarter of a turn exchanges depth and width.

    Args:
        delivery: with its stack.
        order: the indices of the cases in the order in which they leave the pallet.

    Raises:
        DeliveryError: only the note is known.
    """
    if delivery.stack is None:
        what = f"delivery {delivery.id!r} is a note without a stack"
        raise DeliveryError("", [Problem("stack", what, "where every case stands")])
    found = []
    for index in order:
        case = delivery.stack[index]
        along, inward, height = case.size
        mass = delivery.products[case.gtin].mass
        ways = Held((inward, along, height), mass), Held((along, inward, height), mass)
        found.append(Arrival(BoxId(f"b{index}"), ways))
    return tuple(found)


def measure_fill(
    deliveries: Iterable[Sequence[Arrival]],
    places: Sequence[Place],
    *,
    margins: Margins = MARGINS,
    weights: Weights = WEIGHTS,
) -> Filling:
    """Stores deliveries, each into empty places; the fullest trolley goes when nothing fits.

    Args:
        deliveries: boxes in the order in which they come.
        places: of trolleys, in the order in which they are tried.
        margins: how much room a box is given.
        weights: what makes a spot good.
    """
    fills: list[float] = []
    stored = refused = 0
    for delivery in deliveries:
        books = Books.empty(places)
        for arrival in delivery:
            after = _stored(books, arrival, margins, weights)
            while after is None and any(place_map.boxes for place_map in books.maps):
                books, full = _exchanged(books)
                fills += full
                after = _stored(books, arrival, margins, weights)
            stored += after is not None
            refused += after is None
            books = after or books
    return Filling(tuple(fills), stored, refused)


def _stored(books: Books, arrival: Arrival, margins: Margins, weights: Weights) -> Books | None:
    """The books with the box in the first place that takes it; None where none does."""
    for place_map in books.maps:
        best: tuple[float, Standing] | None = None
        for held in arrival.ways:
            for spot in find_spots(place_map, held, margins=margins, limit=1, weights=weights):
                if best is None or spot.cost < best[0]:
                    best = spot.cost, spot.standing(arrival.box, held.mass)
        if best is not None:
            return books.put(place_map.place.id, best[1])
    return None


def _exchanged(books: Books) -> tuple[Books, list[float]]:
    """The books without the fullest trolley, and how full its places were."""
    trolleys = dict.fromkeys(
        str(place_map.place.id).split("/", maxsplit=1)[0] for place_map in books.maps
    )
    volumes = {
        trolley: sum(box.volume for each in books.of(trolley) for box in each.boxes)
        for trolley in trolleys
    }
    rest, gone = books.exchanged(max(volumes, key=lambda trolley: volumes[trolley]))
    return rest, [place_map.fill for place_map in gone]
