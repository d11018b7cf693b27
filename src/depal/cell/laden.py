"""Whether something unknown may stand on a box: what is seen above it and nothing explains."""

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from depal.geometry import OrientedBox

Floats = npt.NDArray[np.float64]

HIGHER = 0.05
"""What is seen this much above the top of a box is not the box itself [m]."""

OVER = 0.015
"""What reaches over a box by more than this, along both axes, may stand on it [m]."""


def is_laden(box: OrientedBox, strange: Iterable[OrientedBox]) -> bool:
    """Whether something above a box reaches over it, and may fall when the box goes.

    Args:
        box: upright, in the cell frame.
        strange: upright solids where a look shows something and no box is believed, there too.
    """
    low, high = _bounds(box)
    for solid in strange:
        least, most = _bounds(solid)
        shared = np.minimum(high, most) - np.maximum(low, least)
        if most[2] > high[2] + HIGHER and min(shared[:2]) > OVER:
            return True
    return False


def _bounds(box: OrientedBox) -> tuple[Floats, Floats]:
    corners = box.corners
    return corners.min(axis=0), corners.max(axis=0)
