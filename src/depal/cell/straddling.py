"""Whether a surface goes on beside a box that no print has named: then where it ends is not sure.

Of two boxes that stand flush one may be seen across the seam between them, as large as either.
Then what is seen beside it is as high as its top, and no box explains it.
"""

import math
from collections.abc import Iterable

import numpy as np

from depal.geometry import OrientedBox, Vector3
from depal.motion.grasping import EXACT

LEVEL = 0.03
"""What ends so near to a box's top, upward, may be the same surface [m]."""

BESIDE = 0.03
"""And what begins so near to one of its sides [m]."""

FARTHER = 0.03
"""It goes on where it reaches so much farther than the side [m]."""

MOST = 0.5
"""And is seen along so much of the side."""

STACKED = 0.06
"""A surface that goes on is joined with a higher one behind it where they differ by less [m]."""

HALF = 0.5
"""By no more of its edge a box is seen beside itself: what lies farther off is not held."""


def goes_on_beside(
    box: OrientedBox, strange: Iterable[OrientedBox], *, above: float = LEVEL
) -> Vector3:
    """How far a surface that no box explains goes on beside a box, at either end of its axes [m].

    Args:
        box: upright, in the cell frame; no print has named it.
        strange: upright solids where a look shows something and no box is believed.
        above: so much higher than the box's top one may end [m].
    """
    half = np.array(box.size) / 2
    spans: dict[tuple[int, int], list[tuple[float, float, float]]] = {}
    for solid in strange:
        if math.dist(solid.centre[:2], box.centre[:2]) > _radius(solid) + _radius(box) + BESIDE:
            continue
        corners = (solid.corners - box.centre) @ np.array(box.pose.rotation)
        low, high = corners.min(axis=0), corners.max(axis=0)
        if not -LEVEL <= high[2] - half[2] <= above:
            continue
        for axis in (0, 1):
            across = 1 - axis
            first, last = max(low[across], -half[across]), min(high[across], half[across])
            for side, near, far in ((1, low[axis], high[axis]), (-1, -high[axis], -low[axis])):
                beside = near < half[axis] + BESIDE and far > half[axis] + FARTHER
                if beside and first < last:
                    spans.setdefault((axis, side), []).append((first, last, far - half[axis]))
    out = list(EXACT)
    for (axis, _), found in spans.items():
        if _covered(found) > MOST * box.size[1 - axis]:
            reach = min(max(far for *_, far in found), HALF * box.size[axis])
            out[axis] = max(out[axis], float(reach))
    a, b, c = out
    return a, b, c


def _radius(solid: OrientedBox) -> float:
    """Of the circle around its middle that an upright solid lies in, seen from above [m]."""
    return math.hypot(solid.size[0], solid.size[1]) / 2


def _covered(spans: list[tuple[float, float, float]]) -> float:
    """How much of a line spans cover together, overlaps once [m]."""
    total, end = 0.0, -np.inf
    for first, last, _ in sorted(spans):
        total += max(last - max(first, end), 0.0)
        end = max(end, last)
    return total
