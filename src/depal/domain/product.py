"""What a store sells."""

from dataclasses import dataclass

from depal.domain.names import Gtin
from depal.geometry import Vector3


@dataclass(frozen=True, slots=True)
class Product:
    """A product in its shipping case.

    Attributes:
        gtin: the case's trade item number.
        name: what people call it.
        size: length, width, height of a case standing upright [m].
        mass: of one full case [kg].
    """

    gtin: Gtin
    name: str
    size: Vector3
    mass: float
