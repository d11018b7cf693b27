"""Units of quantities that a task may limit, in terms of each quantity's base unit."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit as it is written.

    Attributes:
        base: the unit of the same quantity in which everything is reckoned: SI's, and g for
            accelerations.
        factor: how many of these it is.
    """

    base: str
    factor: float


UNITS: Final[Mapping[str, Unit]] = {
    "m/s": Unit("m/s", 1.0),
    "mm/s": Unit("m/s", 0.001),
    "kg": Unit("kg", 1.0),
    "rad": Unit("rad", 1.0),
    "deg": Unit("rad", math.pi / 180),
    "m": Unit("m", 1.0),
    "mm": Unit("m", 0.001),
    "g": Unit("g", 1.0),
}
"""By the way in which they are written; g is the acceleration of a fall, masses are in kg."""


@dataclass(frozen=True, slots=True)
class Quantity:
    """What a task may limit.

    Attributes:
        base: the base unit in which it is measured.
        at_least: whether it is bounded from below.
    """

    base: str
    at_least: bool = False
