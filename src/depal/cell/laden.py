"""Whether something unknown may stand on a box: what is seen above it and nothing explains."""

from collections.abc import Iterable, Iterator

import numpy as np
import numpy.typing as npt

from depal.geometry import OrientedBox, Vector3
from depal.motion.grasping import EXACT

Floats = npt.NDArray[np.float64]

HIGHER = 0.05
"""What is seen this much above the top of a box is not the box itself [m]."""

OVER = 0.015
"""What reaches over a box by more than this, along both axes, may stand on it [m]."""

ENDS = 0.03
"""Where something higher begins so near to a box, it may hide where the box ends [m]."""


def is_laden(box: OrientedBox, strange: Iterable[OrientedBox]) -> bool:
    """Whether something above a box reaches over it, and may fall when the box goes.

    Args:
        box: upright, in the cell frame.
        strange: upright solids where a look shows something and no box is believed, there too.
    """
    return any(over > OVER for over in _over(box, strange))


def may_reach_under(
    box: OrientedBox, strange: Iterable[OrientedBox], beyond: Vector3 = EXACT
) -> bool:
    """Whether a box may go on below something higher beside it: what is seen of it is a strip.

    Args:
        box: upright, in the cell frame; no print has named it.
        strange: as for `is_laden`.
        beyond: how much longer it may be than it looks, at either end of its own axes [m].
    """
    a, b, c = box.size
    longest = OrientedBox(box.pose, (a + 2 * beyond[0], b + 2 * beyond[1], c))
    return any(over > -ENDS for over in _over(longest, strange))


def _over(box: OrientedBox, strange: Iterable[OrientedBox]) -> Iterator[float]:
    """How far what is higher than a box reaches over it, along both axes; less than 0 beside it."""
    low, high = _bounds(box)
    for solid in strange:
        least, most = _bounds(solid)
        shared = np.minimum(high, most) - np.maximum(low, least)
        if most[2] > high[2] + HIGHER:
            yield float(min(shared[:2]))


def _bounds(box: OrientedBox) -> tuple[Floats, Floats]:
    corners = box.corners
    return corners.min(axis=0), corners.max(axis=0)
