"""By how much two boxes satisfy each inequality of the relations, for all pairs at once."""

import numpy as np
import numpy.typing as npt

from depal.geometry import (
    footprint_overlap,
    holds_centre,
    lateral_interval,
    loop_kernel,
    slice_at,
)

Array = npt.NDArray[np.float64]

BESIDE, GROUND, RISE, FLAT, TALL, BEFORE, PARTED, CLASH = range(8)
"""Columns: the extent shared across the view; on the ground; how much higher; how flat they meet;
the height shared; how much nearer; how little they share along the view; whether they are one."""

COLUMNS = 8

X, Y, Z, HALF_LENGTH, HALF_WIDTH, HALF_HEIGHT = range(6)


def margins(prisms: Array, slack: float) -> Array:
    """Of every ordered pair of prisms.

    Args:
        prisms: (n, 8), see geometry.prisms_of.
        slack: by how much a box may seem to reach into the one that it stands on or hides [m].

    Returns:
        (n, n, COLUMNS): how far each inequality holds [m] where row a is the one that stands
        above or before row b; negative where it does not.
    """
    out = np.full((len(prisms), len(prisms), COLUMNS), -1.0)
    _fill(prisms, slack, out)
    return out


@loop_kernel
def _fill(prisms: Array, slack: float, out: Array) -> None:
    for a in range(prisms.shape[0]):
        low_a, high_a = lateral_interval(prisms, a)
        for b in range(prisms.shape[0]):
            if a == b:
                continue
            low_b, high_b = lateral_interval(prisms, b)
            low, high = max(low_a, low_b), min(high_a, high_b)
            beside = high - low
            rise = prisms[a, Z] - prisms[b, Z]
            tall = prisms[a, HALF_HEIGHT] + prisms[b, HALF_HEIGHT] - abs(rise)
            ground = footprint_overlap(prisms, a, b)
            out[a, b, BESIDE], out[a, b, GROUND] = beside, ground
            out[a, b, RISE], out[a, b, TALL] = rise, tall
            # Deeper than any slack: the boxes part most easily upwards, so one is on the other.
            out[a, b, FLAT] = max(slack, ground) - tall
            if beside <= 0.0:
                continue
            near_a, far_a = slice_at(prisms, a, (low + high) / 2)
            near_b, far_b = slice_at(prisms, b, (low + high) / 2)
            deep = min(far_a, far_b) - max(near_a, near_b)
            out[a, b, BEFORE] = (near_b + far_b - near_a - far_a) / 2
            out[a, b, PARTED] = max(slack, min(beside, tall)) - deep
            if holds_centre(prisms, a, b) or holds_centre(prisms, b, a):
                out[a, b, CLASH] = 1.0
