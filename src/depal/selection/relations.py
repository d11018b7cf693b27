"""When one box must leave before another: on top of it, or in front of it (section II-C).

Two relations make an edge of G from b1 to b2: b2 lies on b1 (their footprints overlap and b2 is
higher, at whatever distance), or b2 occludes b1 (they overlap as seen from the robot, which
looks along +x, and b2 is nearer). Real poses are slightly wrong, so both are asked with
tolerances, and boxes that seem to reach deep into each other are related by the direction in
which they part most easily: no wrong pose frees a box that carries another. The answer depends
on the two boxes alone, never on their names or their order.
"""

import math
from dataclasses import dataclass
from enum import IntFlag

import numpy as np
import numpy.typing as npt

from depal.errors import SettingError
from depal.geometry import (
    footprint_overlap,
    holds_centre,
    lateral_interval,
    loop_kernel,
    slice_at,
)

Array = npt.NDArray[np.float64]

X, Y, Z, HALF_HEIGHT = 0, 1, 2, 5


class Relation(IntFlag):
    """How a blocker stands to the box that it blocks; several can hold at once.

    CROWDS is no relation of the paper's: the blocker stands where the tool has to go.
    """

    ON_TOP = 1
    OCCLUDES = 2
    CROWDS = 4


# The pair code of `relate(a, b)`: the relation of b to a, and of a to b two bits higher.
B_ON_A, B_BEFORE_A, A_ON_B, A_BEFORE_B, CLASH = 1, 2, 4, 8, 16
A_SHIFT = 2
BOTH = 3


@dataclass(frozen=True, slots=True)
class Tolerances:
    """How wrong poses may be before a relation is missed or made up.

    Attributes:
        overlap: boxes that overlap by no more than this do not block each other [m].
        slack: by how much a box may seem to reach into the one that it stands on or hides [m].
    """

    overlap: float
    slack: float

    def __post_init__(self) -> None:
        """Refuses what would turn the relations around."""
        for name, value in (("overlap", self.overlap), ("slack", self.slack)):
            if not (math.isfinite(value) and value >= 0):
                raise SettingError(f"tolerance {name}", f"{value!r} m", "a length of 0 m or more")


EXACT = Tolerances(overlap=1e-6, slack=1e-6)
"""For poses that are known: random pallets and the stack of a delivery."""

PERCEIVED = Tolerances(overlap=0.01, slack=0.02)
"""For poses from a camera, some millimetres and some tenths of a degree off."""


@loop_kernel
def relate(prisms: Array, a: int, b: int, overlap: float, slack: float) -> int:
    """The pair code of two prisms: who blocks whom.

    Args:
        prisms: (n, 8).
        a: the row of one prism.
        b: the row of another.
        overlap: see Tolerances [m].
        slack: see Tolerances [m].

    Returns:
        A sum of B_ON_A, B_BEFORE_A, A_ON_B, A_BEFORE_B; or CLASH when the centre of one lies
        inside the other, which no two cases can do.
    """
    low_a, high_a = lateral_interval(prisms, a)
    low_b, high_b = lateral_interval(prisms, b)
    low, high = max(low_a, low_b), min(high_a, high_b)
    if high - low <= overlap:
        return 0
    rise = abs(prisms[a, Z] - prisms[b, Z])
    shared_height = prisms[a, HALF_HEIGHT] + prisms[b, HALF_HEIGHT] - rise
    code = 0
    if rise > 0:
        ground = footprint_overlap(prisms, a, b)
        # Deeper than any slack: the boxes part most easily upwards, so one stands on the other.
        if ground > overlap and shared_height <= max(slack, ground):
            code = A_ON_B if prisms[a, Z] > prisms[b, Z] else B_ON_A
    if shared_height > overlap:
        if holds_centre(prisms, a, b) or holds_centre(prisms, b, a):
            return CLASH
        near_a, far_a = slice_at(prisms, a, (low + high) / 2)
        near_b, far_b = slice_at(prisms, b, (low + high) / 2)
        shared_depth = min(far_a, far_b) - max(near_a, near_b)
        # The same along x: in front, unless they part more easily sideways or upwards.
        if shared_depth <= max(slack, min(high - low, shared_height)):
            if near_a + far_a < near_b + far_b:
                code |= A_BEFORE_B
            elif near_b + far_b < near_a + far_a:
                code |= B_BEFORE_A
    return code
