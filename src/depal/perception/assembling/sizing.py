"""How large a box is of which one or two faces were seen."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from depal.domain import Gtin, Product
from depal.geometry import Vector3

FITS = 0.022
"""A face fits a product whose edges differ by less, both together [m]."""

EQUAL = 0.008
"""Sizes that differ by less are one [m]."""

CLEARLY = 0.012
"""A product is meant where it fits better than any other of another size by so much [m]."""


@dataclass(frozen=True, slots=True)
class Sized:
    """What a box measures.

    Attributes:
        depth: along x [m].
        width: along y [m].
        height: along z [m].
        certain: whether all three are known.
        tall: whether the height is.
        gtins: the products that have this size.
    """

    depth: float
    width: float
    height: float
    certain: bool
    tall: bool
    gtins: frozenset[Gtin] = frozenset()


@dataclass(frozen=True, slots=True)
class Seen:
    """Edges of a box that were measured; None where they were not.

    Attributes:
        depth: along x [m].
        width: along y [m].
        height: along z [m].
    """

    depth: float | None
    width: float
    height: float | None


def sized(
    seen: Seen,
    products: Sequence[Product],
    gtin: Gtin | None,
    standing: Sequence[float] = (),
    supposed: Gtin | None = None,
) -> Sized:
    """The size that fits what was seen.

    Args:
        seen: the edges that were measured.
        products: what may be there, the likeliest first.
        gtin: the product, where the print says it.
        standing: heights that the box may have, for something that it can stand on is there [m].
        supposed: the product that the print seems to say: its size is taken where it fits, and is
            certain only where no other product's fits as well.
    """
    ways = [
        (_misfit(seen, way), way, product.gtin)
        for product in products
        for way in _ways(product.size)
        if gtin is None or product.gtin == gtin
    ]
    fitting = sorted(
        (each for each in ways if each[0] < (FITS if gtin is None else 3 * FITS)),
        key=lambda each: each[0],
    )
    if not fitting:
        return _as_seen(seen, standing)
    if seen.height is None and standing:
        fitting.sort(key=lambda each: each[0] + min(abs(each[1][2] - high) for high in standing))
    likely = [each for each in fitting if each[2] == supposed] or fitting
    best = likely[0][1]
    near = [each for each in fitting if each[0] < likely[0][0] + CLEARLY]
    same = [each for each in near if np.allclose(each[1], best, atol=EQUAL)]
    certain = len(same) == len(near) or (seen.depth is not None and seen.height is not None)
    tall = certain or seen.height is not None
    tall = tall or all(abs(each[1][2] - best[2]) < EQUAL for each in near)
    return Sized(*best, certain, tall, frozenset(each[2] for each in same))


def _ways(size: Vector3) -> list[Vector3]:
    """Depth, width and height of a case that stands upright, its end or its side to the front."""
    length, width, height = size
    return [(width, length, height), (length, width, height)]


def _misfit(seen: Seen, way: Vector3) -> float:
    pairs = zip((seen.depth, seen.width, seen.height), way, strict=True)
    return float(np.hypot.reduce([0.0] + [a - b for a, b in pairs if a is not None]))


def _as_seen(seen: Seen, standing: Sequence[float]) -> Sized:
    """Nothing known fits: as measured, and what was not measured is guessed."""
    usual = seen.width
    depth = seen.depth if seen.depth is not None else usual
    height = seen.height
    if height is None:
        height = min(standing, default=usual, key=lambda high: abs(high - usual))
    tall = seen.height is not None
    return Sized(depth, seen.width, height, seen.depth is not None and tall, tall)
