"""Lengths as whole numbers of a tick far below a nanometre.

The generators cut and stack in ticks. Integers do not round: what touches touches exactly, a
side of just 5 cm is not below 5 cm, and every machine gets the same boxes. A tick is a power of
two, so that ticks become metres without rounding as well.
"""

import math

TICK = 2.0**-40
"""The spacing of all coordinates [m]."""

Cuboid = list[int]
"""Low x, y, z and high x, y, z of an axis-aligned box, in ticks, in the cell frame."""


def ticks_below(length: float) -> int:
    """The largest number of ticks that is not above a length [m]."""
    return math.floor(length / TICK)


def ticks_above(length: float) -> int:
    """The smallest number of ticks that is not below a length [m]."""
    return math.ceil(length / TICK)
