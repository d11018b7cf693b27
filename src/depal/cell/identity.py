"""Whether a box can be the product that somebody says it is: by its size and by what it weighs."""

import itertools
from collections.abc import Collection

import numpy as np

from depal.domain import Delivery, Product
from depal.geometry import Vector3

MASS_SHARE, MASS_SPARE = 0.10, 0.2
"""A box weighs what its product does within this share and so much more [kg]."""

SIZE_SPARE = 0.03
"""A measured edge is that of the product within this [m]."""

EDGES = 3

HIGHER = 0.05
"""So much higher than the highest product of the note a box of another one may be [m]."""

ALIKE = 0.04
"""A box that no print has named may lie either way where the two differ by less [m]: of a nearly
square one the sides are soon taken for each other."""

NOTICED = 0.004
"""An edge that was seen wrong by less leaves no doubt where the box is [m]."""


def why_not(
    product: Product, size: Vector3, mass: float | None, *, unsized: bool = False
) -> tuple[str, ...]:
    """What speaks against a product.

    Args:
        product: what the box is said to be.
        size: of the box as it was seen [m].
        mass: as felt [kg]; None where it was not weighed.
        unsized: whether one edge is a guess: then the other two count.

    Returns:
        Reasons; none where nothing speaks against it.
    """
    found = []
    if not fits(product, size, unsized=unsized):
        found.append(f"it is {_edges(size)}, product {product.gtin} is {_edges(product.size)}")
    if mass is not None and not weighs_like(product, mass):
        found.append(
            f"it weighs {mass:.1f} kg, product {product.gtin} weighs {product.mass:.1f} kg"
        )
    return tuple(found)


def weighs_like(product: Product, mass: float) -> bool:
    """Whether a felt mass [kg] is that of a product."""
    return abs(mass - product.mass) <= MASS_SHARE * product.mass + MASS_SPARE


def fits(product: Product, size: Vector3, *, unsized: bool = False) -> bool:
    """Whether a box of a seen size [m], however it lies, can be a case of a product."""
    counted = EDGES - 1 if unsized else EDGES
    return any(
        sorted(abs(a - b) for a, b in zip(turned, size, strict=True))[counted - 1] <= SIZE_SPARE
        for turned in itertools.permutations(product.size)
    )


def plausible(delivery: Delivery, size: Vector3, *, unsized: bool = False) -> tuple[Product, ...]:
    """The products of the note that a box of this size can be."""
    products = delivery.products.values()
    return tuple(product for product in products if fits(product, size, unsized=unsized))


def may_be_two(products: Collection[Product], delivery: Delivery, mass: float) -> bool:
    """Whether what hangs on the arm weighs like two boxes, and like none that it can be alone.

    Args:
        products: what the box that was taken can be.
        delivery: its neighbours' products.
        mass: as felt [kg].
    """
    if any(weighs_like(product, mass) for product in products):
        return False
    others = delivery.products.values()
    return any(_weigh_together(one, other, mass) for one in products for other in others)


def looks_like_two(delivery: Delivery, size: Vector3, mass: float) -> bool:
    """Whether two boxes of the note, flush beside or on each other, look like one and weigh so.

    One edge may be off by any amount: a box that is seen takes over the size of a product.

    Args:
        delivery: whose boxes they can be.
        size: of the one box that was seen [m].
        mass: as felt [kg].
    """
    counts = {line.product.gtin: line.count for line in delivery.lines}
    pairs = itertools.combinations_with_replacement(delivery.products.values(), 2)
    return any(
        _weigh_together(one, other, mass) and _joined(one.size, other.size, size)
        for one, other in pairs
        if one is not other or counts[one.gtin] > 1
    )


def _weigh_together(one: Product, other: Product, mass: float) -> bool:
    both = one.mass + other.mass
    return abs(mass - both) <= MASS_SHARE * both + MASS_SPARE


def _joined(one: Vector3, other: Vector3, size: Vector3) -> bool:
    """Whether two upright cases that stand flush can be seen as a box of a size [m]."""
    seen = np.array(size)
    for first, second in itertools.product(_ways(one), _ways(other)):
        for axis in range(EDGES):
            both = np.maximum(first, second)
            both[axis] = first[axis] + second[axis]
            alike = np.abs(np.delete(np.subtract(first, second), axis)).max() <= SIZE_SPARE
            if alike and sorted(np.abs(both - seen))[EDGES - 2] <= SIZE_SPARE:
                return True
    return False


def size_by_weight(delivery: Delivery, size: Vector3, mass: float) -> Vector3 | None:
    """The size of a box of which one edge is wrong, by what it weighs.

    Args:
        delivery: what it can be.
        size: as seen, along the box's own axes [m].
        mass: as felt [kg].

    Returns:
        The one size of all products that fit two of its edges and weigh so, along the same axes;
        None where there is no such product, or they differ.
    """
    found = [
        turned
        for product in plausible(delivery, size, unsized=True)
        if weighs_like(product, mass) and (turned := _turned(product.size, size)) is not None
    ]
    if not found:
        return None
    sizes = np.array(found)
    a, b, c = sizes[0].tolist()
    return (a, b, c) if np.ptp(sizes, axis=0).max() < SIZE_SPARE / 2 else None


def beyond_seen(delivery: Delivery, size: Vector3, mass: float | None = None) -> Vector3:
    """How much longer a box may be than it was seen, at either end of its axes [m].

    Of two products with like tops the wrong one is soon believed, and boxes that stand flush are
    seen as one: an edge counts as wrong where the other two are those of a product. A box that
    weighs like none of these is of a product that nobody knows: its height was guessed.

    Args:
        delivery: what it can be.
        size: as seen, along the box's own axes [m].
        mass: as felt [kg]; None where it was not weighed.
    """
    longest = np.array(size)
    like = [
        product
        for product in plausible(delivery, size, unsized=True)
        if mass is None or weighs_like(product, mass)
    ]
    if mass is not None and not like:
        longest[2] += strange_height(delivery, size[2])
    for product in like:
        for way in _ways(product.size):
            off = sorted(abs(a - b) for a, b in zip(way, size, strict=True))
            if off[1] <= SIZE_SPARE:
                longest = np.maximum(longest, way)
    a, b, c = (longest - size).tolist()
    return (a, b, c)


def strange_height(delivery: Delivery, height: float) -> float:
    """How much higher a box may be than it was taken to be [m]: its product may be unknown.

    Args:
        delivery: the other boxes, of which the highest are not much less high.
        height: as it was guessed or seen [m].
    """
    highest = max((product.size[2] for product in delivery.products.values()), default=height)
    return max(highest - height, 0.0) + HIGHER


def told_size(told: Vector3, seen: Vector3) -> tuple[Vector3, Vector3]:
    """The size of a box by what it turned out to be, and how much farther out it may reach.

    An edge that was seen wrong leaves open which of its two ends was: either may be. How the box
    lies the other edges tell: of a strip of it two are right, however short the third is. Where
    two edges are short the worst one tells better, so where both tell different ways it has room
    for both.

    Args:
        told: the product's size [m].
        seen: as it was seen, along the box's own axes [m].

    Returns:
        The true size along the same axes, and by how much the box may stick out of it at either
        end of each axis [m].
    """
    ways = _ways(told)
    errors = [sorted(abs(a - b) for a, b in zip(way, seen, strict=True)) for way in ways]
    off = [error[EDGES - 2] for error in errors]
    best = min(range(2), key=lambda k: (off[k], errors[k], k))
    widest = np.array(ways[best])
    for way, error in zip(ways, errors, strict=True):
        if error[EDGES - 2] < off[best] + ALIKE or error[-1] < errors[best][-1]:
            wrong = np.array(way) - np.array(seen)
            wrong[np.abs(wrong) < NOTICED] = 0.0
            widest = np.maximum(widest, way + np.abs(wrong))
    a, b, c = ((widest - ways[best]) / 2).tolist()
    return ways[best], (a, b, c)


def _ways(size: Vector3) -> tuple[Vector3, Vector3]:
    """An upright case's size along the axes that it may be turned to."""
    a, b, c = size
    return (a, b, c), (b, a, c)


def _turned(size: Vector3, seen: Vector3) -> Vector3 | None:
    """An upright case's size along the axes of a box of which two edges are seen so."""
    ways = _ways(size)
    off = [sorted(abs(p - q) for p, q in zip(way, seen, strict=True))[1] for way in ways]
    best = min(range(2), key=lambda k: (off[k], k))
    return ways[best] if off[best] <= SIZE_SPARE else None


def _edges(size: Vector3) -> str:
    return " x ".join(f"{1000 * edge:.0f}" for edge in size) + " mm"
