"""Deliveries for light worlds: layers of cases, drawn from a seed."""

import numpy as np

from depal.domain import EURO_PALLET, Delivery, DeliveryLine, Gtin, Product, StackedCase
from depal.geometry import Vector3

COLUMNS, ROWS = 4, 3
"""Of a layer along the pallet's length and width."""

CELL = (0.30, 0.26)
"""Of the grid that cases stand in [m]: at its distances they are neighbours."""

LENGTHS, WIDTHS, HEIGHTS = (0.275, 0.298), (0.235, 0.258), (0.16, 0.26)
"""Of cases [m]."""

MASSES = (2.0, 9.0)
"""Of cases [kg]."""

PRODUCTS = 5


def light_delivery(boxes: int, seed: int) -> Delivery:
    """A delivery of so many cases in layers, each layer of one height.

    Args:
        boxes: how many.
        seed: of sizes, masses, and of which case is of which product.
    """
    random = np.random.default_rng([seed, 21])
    per_layer = COLUMNS * ROWS
    layers = -(-boxes // per_layer)
    counts: dict[Gtin, int] = {}
    products: dict[Gtin, Product] = {}
    stack: list[StackedCase] = []
    bottom = 0.0
    for layer in range(layers):
        height = _drawn(random, HEIGHTS)
        kinds = [_product(random, 10 * layer + kind, height) for kind in range(PRODUCTS)]
        number = min(per_layer, boxes - layer * per_layer)
        for slot in range(number):
            product = kinds[int(random.integers(PRODUCTS))]
            products[product.gtin] = product
            counts[product.gtin] = counts.get(product.gtin, 0) + 1
            stack.append(StackedCase(product.gtin, _corner(slot, bottom), product.size))
        bottom += height
    lines = tuple(DeliveryLine(product, counts[gtin]) for gtin, product in products.items())
    return Delivery(f"light-{seed}", EURO_PALLET, lines, tuple(stack))


def _drawn(random: np.random.Generator, span: tuple[float, float]) -> float:
    """A number, in steps of a millimetre or a gram."""
    return round(float(random.uniform(*span)), 3)


def _product(random: np.random.Generator, number: int, height: float) -> Product:
    size: Vector3 = (_drawn(random, LENGTHS), _drawn(random, WIDTHS), height)
    return Product(Gtin(f"1200080{number:06d}0"), f"case {number}", size, _drawn(random, MASSES))


def _corner(slot: int, bottom: float) -> Vector3:
    return (CELL[0] * (slot % COLUMNS), CELL[1] * (slot // COLUMNS), bottom)
