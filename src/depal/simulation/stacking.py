"""A stack for a delivery of which only the note is known."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.domain import Delivery, Gtin, Product, StackedCase
from depal.errors import DeliveryError, Problem
from depal.geometry import Vector3

Floats = npt.NDArray[np.float64]

HEIGHT = 1.6
"""Stacks grow no higher above the deck [m]."""

SUPPORTS = (0.75, 0.55)
"""So much of a case's bottom stands on something: at best, and where nothing else is left."""

LEVEL = 1e-3
"""Tops within this of each other carry one case together [m]."""


ORDERS: tuple[Callable[[Product], tuple[float, float, str]], ...] = (
    lambda product: (-product.size[0] * product.size[1], -product.size[2], product.gtin),
    lambda product: (-product.size[2], -product.size[0] * product.size[1], product.gtin),
    lambda product: (-math.prod(product.size), -product.size[2], product.gtin),
)
"""In which order cases are stacked: each is tried, the first that takes all of them is used."""


@dataclass(frozen=True, slots=True)
class _Spot:
    height: float
    y: float
    x: float
    length: float
    width: float

    @property
    def order(self) -> tuple[float, float, float]:
        return (round(self.height, 6), round(self.y, 6), round(self.x, 6))


def stacked(delivery: Delivery) -> tuple[StackedCase, ...]:
    """Stacks the note: the largest cases first, each as low as it stands firmly.

    Args:
        delivery: a note; its own stack, if there is one, is not looked at.

    Returns:
        The cases in the order in which they were stacked, the stack centred on the pallet.

    Raises:
        DeliveryError: the cases do not fit on the pallet.
    """
    cases = [line.product for line in delivery.lines for _ in range(line.count)]
    best: tuple[StackedCase, ...] = ()
    for order in ORDERS:
        stack = _grown(sorted(cases, key=order), delivery.pallet_size)
        best = max(best, stack, key=len)
        if len(best) == len(cases):
            break
    if len(best) < len(cases):
        problem = Problem(
            "lines",
            f"room for {len(best)} of {len(cases)} cases only",
            f"cases that stack up to {HEIGHT} m above the deck",
        )
        raise DeliveryError(delivery.id, [problem])
    return best


def _grown(cases: list[Product], pallet: Vector3) -> tuple[StackedCase, ...]:
    """The stack that cases make in this order, up to the first that finds no spot."""
    length, width, _ = pallet
    placed = np.zeros((0, 6))
    for product in cases:
        tries = (_lowest_spot(placed, product.size, (length, width), s) for s in SUPPORTS)
        spot = next((spot for spot in tries if spot is not None), None)
        if spot is None:
            break
        row = [spot.x, spot.y, spot.height]
        row += [spot.x + spot.length, spot.y + spot.width, spot.height + product.size[2]]
        placed = np.vstack((placed, row))
    if not len(placed):
        return ()
    shift = (np.array([length, width]) - placed[:, :2].min(0) - placed[:, 3:5].max(0)) / 2
    placed[:, :2] += shift
    placed[:, 3:5] += shift
    return tuple(_case(product.gtin, row) for product, row in zip(cases, placed, strict=False))


def _case(gtin: Gtin, row: Floats) -> StackedCase:
    x, y, z, far_x, far_y, far_z = row.tolist()
    return StackedCase(gtin, (x, y, z), (far_x - x, far_y - y, far_z - z))


def _lowest_spot(
    placed: Floats,
    size: tuple[float, float, float],
    pallet: tuple[float, float],
    support: float,
) -> _Spot | None:
    """The lowest spot where a case stands firmly, in a corner that others leave."""
    best: _Spot | None = None
    for length, width in {(size[0], size[1]): 0, (size[1], size[0]): 0}:
        xs = sorted({0.0, *placed[:, 3].tolist(), *placed[:, 0].tolist()})
        ys = sorted({0.0, *placed[:, 4].tolist(), *placed[:, 1].tolist()})
        for y in ys:
            for x in xs:
                if x + length > pallet[0] + LEVEL or y + width > pallet[1] + LEVEL:
                    continue
                height = _rest(placed, x, y, (length, width), support)
                spot = _Spot(height, y, x, length, width)
                if height + size[2] <= HEIGHT and (best is None or spot.order < best.order):
                    best = spot
    return best


def _rest(
    placed: Floats, x: float, y: float, footprint: tuple[float, float], support: float
) -> float:
    """The height at which a case of this footprint stands firmly; infinite where it does not."""
    length, width = footprint
    if not len(placed):
        return 0.0
    over_x = np.minimum(placed[:, 3], x + length) - np.maximum(placed[:, 0], x)
    over_y = np.minimum(placed[:, 4], y + width) - np.maximum(placed[:, 1], y)
    below = (over_x > LEVEL) & (over_y > LEVEL)
    if not below.any():
        return 0.0
    top = float(placed[below, 5].max())
    carrying = below & (placed[:, 5] > top - LEVEL)
    area = float((over_x * over_y)[carrying].sum())
    return top if area >= support * length * width else float("inf")
