"""The tables of the store's data."""

from sqlalchemy import ForeignKey, Index
from sqlalchemy.orm import DeclarativeBase, Mapped, mapped_column


class Table(DeclarativeBase):
    """What all tables share."""


class ProductRow(Table):
    """A product in its case: edges [m], mass [kg]."""

    __tablename__ = "products"

    gtin: Mapped[str] = mapped_column(primary_key=True)
    name: Mapped[str]
    length: Mapped[float]
    width: Mapped[float]
    height: Mapped[float]
    mass: Mapped[float]


class PlaceRow(Table):
    """A compartment: opening and depth [m]."""

    __tablename__ = "places"

    id: Mapped[str] = mapped_column(primary_key=True)
    storage: Mapped[str]
    width: Mapped[float]
    height: Mapped[float]
    depth: Mapped[float]


class ProductPlaceRow(Table):
    """Where a product belongs; rank 0 is best."""

    __tablename__ = "product_places"

    gtin: Mapped[str] = mapped_column(ForeignKey("products.gtin"), primary_key=True)
    rank: Mapped[int] = mapped_column(primary_key=True)
    place: Mapped[str] = mapped_column(ForeignKey("places.id"))


class DeliveryRow(Table):
    """A delivery; the size of its pallet [m]."""

    __tablename__ = "deliveries"

    id: Mapped[str] = mapped_column(primary_key=True)
    length: Mapped[float]
    width: Mapped[float]
    deck: Mapped[float]


class DeliveryLineRow(Table):
    """How many cases of a product a delivery's note promises."""

    __tablename__ = "delivery_lines"

    delivery: Mapped[str] = mapped_column(ForeignKey("deliveries.id"), primary_key=True)
    number: Mapped[int] = mapped_column(primary_key=True)
    gtin: Mapped[str] = mapped_column(ForeignKey("products.gtin"))
    count: Mapped[int]


class RequestRow(Table):
    """A request and what became of it: times [s]."""

    __tablename__ = "requests"

    number: Mapped[int] = mapped_column(primary_key=True)
    key: Mapped[str] = mapped_column(unique=True)
    priority: Mapped[float]
    gtin: Mapped[str | None]
    box: Mapped[str | None]
    arrived: Mapped[float]
    due: Mapped[float | None]
    state: Mapped[str]
    settled: Mapped[float | None]
    reason: Mapped[str]

    __table_args__ = (Index("requests_by_state", "state", "arrived"),)


class MovementRow(Table):
    """A case that went into a place, at [s]; each movement once."""

    __tablename__ = "movements"

    number: Mapped[int] = mapped_column(primary_key=True)
    id: Mapped[str] = mapped_column(unique=True)
    box: Mapped[str]
    gtin: Mapped[str | None]
    place: Mapped[str]
    at: Mapped[float]


class ProjectionRow(Table):
    """The number of the last event of a journal that was applied."""

    __tablename__ = "projections"

    name: Mapped[str] = mapped_column(primary_key=True)
    last: Mapped[int]
