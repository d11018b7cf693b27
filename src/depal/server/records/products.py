"""Products and where they belong, changed by whoever has seen what they change."""

import hashlib
import json
from collections.abc import Sequence

from sqlalchemy.orm import Session

from depal.domain import Gtin, PlaceId, Product
from depal.logistics.store import Database
from depal.logistics.store.catalogue import (
    keep_assignments,
    keep_products,
    read_assignment,
    read_product,
)
from depal.server.problems import NotFound, Stale, VersionNeeded

NEW = 0
"""The version of a product that is not there yet."""


class Products:
    """Over the store's database."""

    def __init__(self, database: Database) -> None:
        """The products in it."""
        self._database = database

    def get(self, gtin: Gtin) -> tuple[Product, tuple[PlaceId, ...], int]:
        """A product, where it belongs, best first, and its version.

        Raises:
            NotFound: there is no such product.
        """
        with self._database.session() as session:
            return _found(session, gtin)

    def put(self, product: Product, version: int | None = None) -> None:
        """A new product, or other knowledge of one.

        Args:
            product: as it is from now on.
            version: that is changed; `NEW` for none, None for any.

        Raises:
            Stale: it has another version.
            VersionNeeded: it is not new.
        """
        with self._database.session() as session:
            known = read_product(session, product.gtin)
            if known is not None and version == NEW:
                raise VersionNeeded(f"there is a product {product.gtin}; say what you change of it")
            if known is not None:
                _check(session, product.gtin, version)
            elif version not in {None, NEW}:
                raise Stale(f"there is no product {product.gtin}")
            keep_products(session, [product])

    def assign(self, gtin: Gtin, places: Sequence[PlaceId], version: int | None = None) -> None:
        """Where it belongs, best first.

        Raises:
            NotFound: there is no such product.
            Stale: it has another version.
            SettingError: there is no such place.
        """
        with self._database.session() as session:
            _found(session, gtin)
            _check(session, gtin, version)
            keep_assignments(session, {gtin: places})


def _found(session: Session, gtin: Gtin) -> tuple[Product, tuple[PlaceId, ...], int]:
    product = read_product(session, gtin)
    if product is None:
        raise NotFound(f"there is no product {gtin!r}")
    places = read_assignment(session, gtin)
    return product, places, version_of(product, places)


def _check(session: Session, gtin: Gtin, version: int | None) -> None:
    now = _found(session, gtin)[2]
    if version not in {None, now}:
        raise Stale(f"product {gtin} has version {now} now")


def version_of(product: Product, places: Sequence[PlaceId]) -> int:
    """A number that is another one after every change."""
    told = json.dumps([product.gtin, product.name, product.size, product.mass, places])
    return int.from_bytes(hashlib.sha256(told.encode()).digest()[:7]) or 1
