"""What a store sells: the products of its deliveries, and siblings of theirs.

Siblings are of one range: their artwork differs in a word, an amount or a colour alone. Of the 218
products of the 58 real deliveries 105 (48 %) have a sibling of the same size among them, of the 66
that ship 15 (23 %).
"""

from collections import Counter
from collections.abc import Iterable

import numpy as np

from depal.domain import Product
from depal.geometry import Vector3
from depal.simulation.imaging.prints.design import family_of
from depal.simulation.scenes.foreign import foreign_number

SHARE = 0.3
"""At least so many products have a sibling of their size."""

LIKE = 0.05
"""Siblings differ in mass by no more than this share."""


def sibling_share(products: Iterable[Product]) -> float:
    """The share of the products that have a sibling of equal size among them."""
    looks = [_look(product) for product in products]
    counts = Counter(looks)
    return sum(counts[look] > 1 for look in looks) / max(len(looks), 1)


def assortment(
    products: Iterable[Product], seed: int = 0, share: float = SHARE
) -> tuple[Product, ...]:
    """Products and as many siblings of theirs as it takes.

    Args:
        products: of some deliveries; each number once is enough.
        seed: of everything random in it.
        share: so many of all have a sibling of their size in the end.

    Returns:
        The products by their numbers, then the siblings.
    """
    random = np.random.default_rng([seed, 19])
    sold = {product.gtin: product for product in products}
    known = [sold[gtin] for gtin in sorted(sold)]
    counts = Counter(_look(product) for product in known)
    alone = [product for product in known if counts[_look(product)] == 1]
    for chosen in random.permutation(len(alone)).tolist():
        if sibling_share(known) >= share:
            break
        like = alone[chosen]
        number = foreign_number(random, frozenset(p.gtin for p in known), like.gtin)
        mass = round(like.mass * float(random.uniform(1 - LIKE, 1 + LIKE)), 3)
        known.append(Product(number, f"article {number[-7:-1]}", like.size, mass))
    return tuple(known)


def _look(product: Product) -> tuple[str, Vector3]:
    return family_of(product.gtin), product.size
