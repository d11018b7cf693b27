"""Deliveries, products, their pictures, places and stock."""

from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from depal.domain import Delivery, Gtin, PlaceId, Product
from depal.errors import DeliveryError, Problem
from depal.logistics import deliveries_in
from depal.logistics.gtin import gtin_fault
from depal.logistics.store import by_storage
from depal.server.problems import TooLarge, Unusable
from depal.server.records import PictureView, QueuedView
from depal.server.records.products import version_of
from depal.server.roles import ALL, PEOPLE, SET_UP, WORKERS, Principal
from depal.server.site import Site
from depal.server.usecases.registry import use_case

LARGEST = 5 * 2**20
"""Of an uploaded delivery [byte]."""

EDGES, HEAVIEST = (0.02, 2.0), 100.0
"""Of a case: its edges [m] and its mass [kg]."""

LONGEST = 100
"""Of the name of a delivery, which is part of an address [characters]."""

MOST = 500

NAME = 200
"""The longest name of a product [characters]."""


@dataclass(frozen=True, slots=True)
class StockLine:
    """How many cases of a product went into a place.

    Attributes:
        place: the compartment.
        gtin: the product; None where nobody could tell.
        count: of cases.
    """

    place: str
    gtin: str | None
    count: int


@dataclass(frozen=True, slots=True)
class PlaceView:
    """A compartment.

    Attributes:
        id: its name.
        storage: the trolley or shelf that it is part of.
        width: of the opening [m].
        height: of the opening [m].
        depth: [m].
    """

    id: str
    storage: str
    width: float
    height: float
    depth: float


@dataclass(frozen=True, slots=True)
class ProductView:
    """A product.

    Attributes:
        gtin: of its case.
        name: what people call it.
        size: length, width, height of a case standing upright [m].
        mass: of a full case [kg].
        places: where it belongs, best first.
        pictures: of its faces.
        version: of all but the pictures.
    """

    gtin: str
    name: str
    size: tuple[float, float, float]
    mass: float
    places: tuple[str, ...]
    pictures: tuple[PictureView, ...] = ()
    version: int = 0


@use_case(PEOPLE)
def list_deliveries(
    site: Site, who: Principal | None, after: str | None = None, limit: int = MOST
) -> tuple[QueuedView, ...]:
    """The queue of deliveries, then those that are done, the newest first."""
    del who
    return site.queue.list(after=after, limit=max(1, min(limit, MOST)))


@use_case(PEOPLE)
def get_delivery(site: Site, who: Principal | None, name: str) -> QueuedView:
    """A delivery."""
    del who
    return site.queue.get(name)[0]


@use_case(WORKERS, command=True)
def add_deliveries(
    site: Site, who: Principal | None, text: str, file: str = "upload.json"
) -> tuple[QueuedView, ...]:
    """Check an uploaded file of deliveries and add them to the end of the queue."""
    found = _read(site, text, file)
    by = "nobody" if who is None else who.name
    places = by_storage(site.cell.layout.places, without=site.cell.layout.aside)
    site.store.seed_places(found, places)
    return site.queue.add_all(found, by)


@use_case(WORKERS)
def check_deliveries(
    site: Site, who: Principal | None, text: str, file: str = "upload.json"
) -> tuple[str, ...]:
    """Check a file of deliveries without adding it; the names of its deliveries."""
    del who
    return tuple(delivery.id for delivery in _read(site, text, file))


def _read(site: Site, text: str, file: str) -> tuple[Delivery, ...]:
    if len(text.encode("utf-8", "surrogatepass")) > LARGEST:
        raise TooLarge(f"the file is larger than {LARGEST} bytes")
    name = Path(PurePosixPath(file.replace("\\", "/")).name[:100] or "upload.json")
    found = deliveries_in(text, name)
    known = site.queue.known(delivery.id for delivery in found)
    problems = [
        Problem(delivery.id, f"there is a delivery {delivery.id!r} already", "another name")
        for delivery in found
        if delivery.id in known
    ]
    problems += [
        Problem(
            "id", f"{delivery.id[:LONGEST]!r}", f"at most {LONGEST} characters, and no dots alone"
        )
        for delivery in found
        if len(delivery.id) > LONGEST or set(delivery.id) == {"."}
    ]
    if problems:
        raise DeliveryError(str(name), problems)
    return found


@use_case(WORKERS, command=True)
def cancel_delivery(
    site: Site, who: Principal | None, name: str, version: int | None = None
) -> QueuedView:
    """Take a delivery out of the queue."""
    del who
    return site.queue.cancel(name, version)


@use_case(WORKERS, command=True)
def move_delivery(
    site: Site, who: Principal | None, name: str, position: int, version: int | None = None
) -> QueuedView:
    """Move a delivery to another position in the queue."""
    del who
    return site.queue.move(name, position, version)


@use_case(ALL)
def list_products(
    site: Site, who: Principal | None, search: str = "", after: str = "", limit: int = 100
) -> tuple[ProductView, ...]:
    """The products that the store knows, by name or number."""
    del who
    found = site.store.products(search, after, max(1, min(limit, 500)))
    return tuple(_in_list(site, product) for product in found)


@use_case(ALL)
def get_product(site: Site, who: Principal | None, gtin: str) -> ProductView:
    """A product with its places and pictures."""
    del who
    product, places, version = site.products.get(Gtin(gtin))
    pictures = site.pictures.list(gtin)
    return ProductView(gtin, product.name, product.size, product.mass, places, pictures, version)


@use_case(SET_UP, command=True)
def put_product(
    site: Site,
    who: Principal | None,
    gtin: str,
    name: str,
    size: tuple[float, float, float],
    mass: float,
    version: int | None = None,
) -> ProductView:
    """Add a product, or change what is known of it."""
    problems = []
    fault = gtin_fault(gtin)
    if fault is not None:
        problems.append(Problem("gtin", *fault))
    if not (1 <= len(name) <= NAME):
        problems.append(Problem("name", f"has {len(name)} characters", f"1 to {NAME}"))
    if not all(EDGES[0] <= edge <= EDGES[1] for edge in size):
        expected = f"edges between {EDGES[0]} and {EDGES[1]} m"
        problems.append(Problem("size", f"{size!r}", expected))
    if not 0.0 < mass <= HEAVIEST:
        expected = f"more than 0 and at most {HEAVIEST} kg"
        problems.append(Problem("mass", f"{mass!r}", expected))
    if problems:
        raise Unusable("this product cannot be kept", problems)
    site.products.put(Product(Gtin(gtin), name, size, mass), version)
    return get_product(site, who, gtin)


@use_case(SET_UP, command=True)
def assign_product(
    site: Site,
    who: Principal | None,
    gtin: str,
    places: tuple[str, ...],
    version: int | None = None,
) -> ProductView:
    """Say where a product belongs, best first."""
    site.store.keep_places(site.cell.layout.places.values())
    site.products.assign(Gtin(gtin), [PlaceId(place) for place in places], version)
    return get_product(site, who, gtin)


@use_case(SET_UP, command=True)
def put_picture(
    site: Site, who: Principal | None, gtin: str, face: str, body: bytes
) -> PictureView:
    """Upload a picture of a product's face, PNG or JPEG."""
    return site.pictures.put(gtin, face, body, "nobody" if who is None else who.name)


@use_case(PEOPLE)
def get_picture(
    site: Site, who: Principal | None, gtin: str, face: str
) -> tuple[PictureView, bytes]:
    """A picture of a product's face."""
    del who
    return site.pictures.get(gtin, face)


@use_case(ALL)
def list_places(site: Site, who: Principal | None) -> tuple[PlaceView, ...]:
    """The compartments of the cell."""
    del who
    return tuple(
        PlaceView(place.id, storage.id, *place.opening, place.depth)
        for storage in site.cell.layout.storages
        for place in storage.places
    )


@use_case(ALL)
def see_stock(site: Site, who: Principal | None) -> tuple[StockLine, ...]:
    """How many cases of which product went into each place."""
    del who
    stock = site.store.stock()
    return tuple(StockLine(place, gtin, count) for (place, gtin), count in stock.items())


def _in_list(site: Site, product: Product) -> ProductView:
    places = site.store.assignment(product.gtin)
    version = version_of(product, places)
    return ProductView(
        product.gtin, product.name, product.size, product.mass, places, version=version
    )
