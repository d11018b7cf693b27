"""Where a store's products belong, when nobody has said so: a plan for simulated stores."""

from collections import defaultdict
from collections.abc import Iterable, Mapping

import numpy as np

from depal.domain import Delivery, DeliveryLine, Gtin, Place, PlaceId, Product

ROOM = 0.035
"""A case needs this much more than its own height, and less than half of it to each side [m]."""


def assign_places(
    deliveries: Iterable[Delivery],
    places: Iterable[Place],
    *,
    unknown_share: float = 0.0,
    seed: int = 0,
) -> dict[Gtin, tuple[PlaceId, ...]]:
    """An ordered list of places for every product, as a store would make it.

    Neighbouring article numbers share a home, so much as its room allows; within it heavy
    products belong low. Next come the home's other levels, the homes beside it, and all others;
    places in which a case can never stand come last.

    Args:
        deliveries: whose products are to be put away.
        places: where they may go; leave out the place for what is set aside.
        unknown_share: the share of products that the store has no place for.
        seed: chooses those.

    Returns:
        Places by product, best first; unknown products are missing.
    """
    homes = _homes(places)
    lines = sorted(_summed(deliveries), key=lambda line: line.product.gtin)
    rng = np.random.default_rng(seed)
    known = [line for line in lines if rng.random() >= unknown_share]
    return {
        line.product.gtin: _ordered(line.product, list(homes.values()), home, share)
        for line, home, share in _with_home(known, list(homes.values()))
    }


def _homes(places: Iterable[Place]) -> dict[str, list[Place]]:
    """The places by their storage, each from the lowest up."""
    homes: dict[str, list[Place]] = defaultdict(list)
    for place in places:
        homes[place.id.split("/", maxsplit=1)[0]].append(place)
    for levels in homes.values():
        levels.sort(key=lambda place: place.cell_from_place.translation[2])
    return homes


def _summed(deliveries: Iterable[Delivery]) -> list[DeliveryLine]:
    counts: dict[Gtin, int] = defaultdict(int)
    products: dict[Gtin, Product] = {}
    for delivery in deliveries:
        for line in delivery.lines:
            products[line.product.gtin] = line.product
            counts[line.product.gtin] += line.count
    return [DeliveryLine(products[gtin], count) for gtin, count in counts.items()]


def _with_home(
    lines: list[DeliveryLine], homes: list[list[Place]]
) -> list[tuple[DeliveryLine, int, float]]:
    """Each line with its home, and the share of the home's products that are heavier."""
    if not homes:
        return []
    rooms = np.cumsum([sum(place.volume for place in home) for home in homes])
    volumes = np.array([float(np.prod(line.product.size)) * line.count for line in lines])
    middles = (np.cumsum(volumes) - volumes / 2) / max(float(volumes.sum()), 1e-12)
    owners = np.searchsorted(rooms / rooms[-1], middles, side="right").tolist()
    groups: dict[int, list[DeliveryLine]] = defaultdict(list)
    for line, owner in zip(lines, owners, strict=True):
        groups[min(owner, len(homes) - 1)].append(line)
    placed = []
    for owner, group in groups.items():
        group.sort(key=lambda line: (-line.product.mass, line.product.gtin))
        placed += [(line, owner, rank / len(group)) for rank, line in enumerate(group)]
    return sorted(placed, key=lambda entry: entry[0].product.gtin)


def _ordered(
    product: Product, homes: list[list[Place]], home: int, share: float
) -> tuple[PlaceId, ...]:
    level = share * len(homes[home])
    ranked = sorted(
        (
            not could_hold(place, product),
            abs(owner - home),
            abs(number + 0.5 - level),
            number,
            owner,
        )
        for owner, levels in enumerate(homes)
        for number, place in enumerate(levels)
    )
    return tuple(homes[owner][number].id for *_, number, owner in ranked)


def could_hold(place: Place, product: Product) -> bool:
    """Whether an upright case fits into an empty compartment, turned one way or the other."""
    (width, height), (length, side, tall) = place.opening, product.size
    fits = any(
        across + ROOM / 2 <= width and along + ROOM / 2 <= place.depth
        for across, along in ((length, side), (side, length))
    )
    return fits and tall + ROOM <= height


def by_storage(places: Mapping[PlaceId, Place], *, without: str) -> list[Place]:
    """The places of all storages but one, in their order."""
    return [place for name, place in places.items() if name.split("/", maxsplit=1)[0] != without]
