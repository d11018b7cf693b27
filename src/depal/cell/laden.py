"""Whether something unknown stands on a box: what is seen above it and nothing explains."""

from collections.abc import Iterable, Iterator

import numpy as np
import numpy.typing as npt

from depal.geometry import OrientedBox, Pose, Vector3
from depal.motion.grasping import EXACT

Floats = npt.NDArray[np.float64]

HIGHER = 0.05
"""What is seen this much above the top of a box is not the box itself [m]."""

OVER = 0.015
"""What reaches over a box by more than this, along both axes, may stand on it [m]."""

OWN = 0.12
"""And what ends no more than this above its top may be the true one [m]."""

ENDS = 0.03
"""Where something higher begins so near to a box, it may hide where the box ends [m]."""


def is_laden(box: OrientedBox, strange: Iterable[OrientedBox]) -> bool:
    """Whether something above a box reaches over it, and may fall when the box goes.

    Args:
        box: upright, in the cell frame.
        strange: upright solids where a look shows something and no box is believed, there too.
    """
    return any(over > OVER for _, over in _over(box, strange))


def raised(shape: OrientedBox, box: OrientedBox, strange: Iterable[OrientedBox]) -> OrientedBox:
    """The room that a box may take, up to what stands on it: that may be its own top.

    Args:
        shape: the room that it may take otherwise, around it.
        box: upright, in the cell frame; no print has named it.
        strange: as for `is_laden`.
    """
    _, high = _bounds(box)
    tops = [_bounds(solid)[1][2] for solid, over in _over(box, strange) if over > OVER]
    top = max((float(top) for top in tops if top <= high[2] + OWN), default=0.0)
    x, y, z = shape.centre
    a, b, c = shape.size
    up = max(top - (z + c / 2), 0.0)
    return OrientedBox(Pose((x, y, z + up / 2), shape.pose.rotation), (a, b, c + up))


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
    return any(over > -ENDS for _, over in _over(longest, strange))


def _over(box: OrientedBox, strange: Iterable[OrientedBox]) -> Iterator[tuple[OrientedBox, float]]:
    """What is higher than a box, and how far it reaches over it, along both axes.

    Less than 0 beside it.
    """
    low, high = _bounds(box)
    for solid in strange:
        least, most = _bounds(solid)
        shared = np.minimum(high, most) - np.maximum(low, least)
        if most[2] > high[2] + HIGHER:
            yield solid, float(min(shared[:2]))


def _bounds(box: OrientedBox) -> tuple[Floats, Floats]:
    corners = box.corners
    return corners.min(axis=0), corners.max(axis=0)
