"""The boxes that a cell is checked with."""

from dataclasses import dataclass

from depal.domain import Delivery
from depal.geometry import Vector3


@dataclass(frozen=True, slots=True)
class BoxSize:
    """One box to try.

    Attributes:
        name: what it is called in a report.
        size: depth, width, height as seen by the arm that takes it from the front [m].
        mass: [kg].
    """

    name: str
    size: Vector3
    mass: float


USUAL = (
    BoxSize("small", (0.18, 0.22, 0.14), 2.5),
    BoxSize("median", (0.25, 0.29, 0.23), 5.4),
    BoxSize("large", (0.42, 0.46, 0.28), 8.0),
)
"""About the 5 %, the 50 % and the 95 % of the edges of 1,842 cases of 58 real deliveries."""


def sizes_of(delivery: Delivery) -> tuple[BoxSize, ...]:
    """The smallest, the median and the largest product of a note by volume, standing upright.

    Args:
        delivery: with at least one line.
    """
    products = sorted(
        (line.product for line in delivery.lines),
        key=lambda product: (product.size[0] * product.size[1] * product.size[2], product.gtin),
    )
    chosen = {
        "smallest": products[0],
        "median": products[len(products) // 2],
        "largest": products[-1],
    }
    return tuple(
        BoxSize(name, (product.size[1], product.size[0], product.size[2]), product.mass)
        for name, product in chosen.items()
    )
