"""Units of quantities that a task may limit, in terms of SI."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit as it is written.

    Attributes:
        base: the SI unit of the same quantity.
        factor: how many of these it is.
    """

    base: str
    factor: float


UNITS: Final[Mapping[str, Unit]] = {
    "m/s": Unit("m/s", 1.0),
    "mm/s": Unit("m/s", 0.001),
    "kg": Unit("kg", 1.0),
    "g": Unit("kg", 0.001),
    "rad": Unit("rad", 1.0),
    "deg": Unit("rad", math.pi / 180),
    "m": Unit("m", 1.0),
    "mm": Unit("m", 0.001),
}
"""By the way in which they are written."""
