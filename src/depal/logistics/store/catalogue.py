"""Products, places and deliveries, and where products belong."""

from collections.abc import Iterable, Mapping, Sequence

from sqlalchemy import delete, select
from sqlalchemy.orm import Session

from depal.domain import Delivery, DeliveryLine, Gtin, Place, PlaceId, Product
from depal.errors import DeliveryError, Problem, SettingError, did_you_mean
from depal.logistics.store.tables import (
    DeliveryLineRow,
    DeliveryRow,
    PlaceRow,
    ProductPlaceRow,
    ProductRow,
)


def keep_products(session: Session, products: Iterable[Product]) -> None:
    """Writes products; what was known of one before is replaced."""
    for product in products:
        length, width, height = product.size
        session.merge(
            ProductRow(
                gtin=product.gtin,
                name=product.name,
                length=length,
                width=width,
                height=height,
                mass=product.mass,
            )
        )


def keep_places(session: Session, places: Iterable[Place]) -> None:
    """Writes compartments; what was known of one before is replaced."""
    for place in places:
        width, height = place.opening
        owner = place.id.split("/", maxsplit=1)[0]
        row = PlaceRow(id=place.id, storage=owner, width=width, height=height, depth=place.depth)
        session.merge(row)


def keep_delivery(session: Session, delivery: Delivery) -> None:
    """Writes a delivery's note with its products; where the cases stand is not kept.

    Raises:
        DeliveryError: another delivery of that name is there already.
    """
    known = read_note(session, delivery.id)
    if known is not None:
        if (known.pallet_size, known.lines) != (delivery.pallet_size, delivery.lines):
            what = f"another delivery {delivery.id!r} is in the store's data already"
            raise DeliveryError("", [Problem("id", what, "a name of its own")])
        return
    keep_products(session, (line.product for line in delivery.lines))
    length, width, deck = delivery.pallet_size
    session.add(DeliveryRow(id=delivery.id, length=length, width=width, deck=deck))
    session.flush()
    session.add_all(
        DeliveryLineRow(
            delivery=delivery.id, number=number, gtin=line.product.gtin, count=line.count
        )
        for number, line in enumerate(delivery.lines)
    )


def read_note(session: Session, name: str) -> Delivery | None:
    """A delivery's note; None where there is no delivery of that name."""
    row = session.get(DeliveryRow, name)
    if row is None:
        return None
    query = (
        select(DeliveryLineRow, ProductRow)
        .join(ProductRow, ProductRow.gtin == DeliveryLineRow.gtin)
        .where(DeliveryLineRow.delivery == name)
        .order_by(DeliveryLineRow.number)
    )
    lines = tuple(
        DeliveryLine(_product(product), line.count) for line, product in session.execute(query)
    )
    return Delivery(name, (row.length, row.width, row.deck), lines)


def read_product(session: Session, gtin: Gtin) -> Product | None:
    """A product; None where the store does not know it."""
    row = session.get(ProductRow, gtin)
    return None if row is None else _product(row)


def find_products(session: Session, search: str, after: str, limit: int) -> tuple[Product, ...]:
    """Products whose name or number holds a text, by number, those after one."""
    query = select(ProductRow).where(ProductRow.gtin > after).order_by(ProductRow.gtin)
    if search:
        name = ProductRow.name.icontains(search, autoescape=True)
        query = query.where(name | ProductRow.gtin.contains(search, autoescape=True))
    return tuple(_product(row) for row in session.scalars(query.limit(limit)))


def keep_assignments(session: Session, places: Mapping[Gtin, Sequence[PlaceId]]) -> None:
    """Writes where products belong, best first; the former places of each are forgotten.

    Raises:
        SettingError: a product or a place is not known.
    """
    products = set(session.scalars(select(ProductRow.gtin)))
    known = set(session.scalars(select(PlaceRow.id)))
    for gtin, ordered in places.items():
        if gtin not in products:
            exists = did_you_mean(gtin, products)
            raise SettingError(f"product {gtin}", "is not in the store's data", exists=exists)
        for place in ordered:
            if place not in known:
                exists = did_you_mean(place, known)
                raise SettingError(f"place {place}", "is not in the store's data", exists=exists)
        session.execute(delete(ProductPlaceRow).where(ProductPlaceRow.gtin == gtin))
        session.add_all(
            ProductPlaceRow(gtin=gtin, rank=rank, place=place) for rank, place in enumerate(ordered)
        )


def read_assignment(session: Session, gtin: Gtin) -> tuple[PlaceId, ...]:
    """Where a product belongs, best first; empty where nobody said."""
    query = (
        select(ProductPlaceRow.place)
        .where(ProductPlaceRow.gtin == gtin)
        .order_by(ProductPlaceRow.rank)
    )
    return tuple(PlaceId(place) for place in session.scalars(query))


def _product(row: ProductRow) -> Product:
    return Product(Gtin(row.gtin), row.name, (row.length, row.width, row.height), row.mass)
