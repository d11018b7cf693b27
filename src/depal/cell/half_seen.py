"""Whether a box may be broader than it was seen, behind what stands before it."""

from collections.abc import Iterable, Sequence

import numpy as np

from depal.geometry import OrientedBox, Vector3
from depal.geometry.sight_lines import Blockers

LESS = 0.012
"""A box that is broader by less than this is no other [m]."""

SHARES = (0.5, 0.75, 1.0)
"""What makes a front broader is looked for there: nearer to the edge that was seen edges err."""

BEFORE = 0.015
"""What stands less far before a front hides nothing beside it [m]."""

FLATTEST = 0.3
"""Cosine between sight and normal below which a camera sees no front."""

HEIGHTS = (-0.25, 0.0, 0.25)
"""Where along its height a front is looked past."""


def may_reach_behind(
    box: OrientedBox,
    widths: Iterable[float],
    front: Vector3,
    around: Iterable[OrientedBox],
    eyes: Sequence[Vector3],
) -> bool:
    """Whether all that would make a front broader is hidden: then where it ends nobody has seen.

    Args:
        box: upright, as it was seen, in the cell frame.
        widths: of the fronts that it may have [m].
        front: the horizontal direction that fronts look to, of length 1.
        around: everything else, in the cell frame.
        eyes: where the cameras are [m].
    """
    turn = np.array(box.pose.rotation)
    facing = turn.T @ np.array(front)
    deep = int(np.argmax(np.abs(facing[:2])))
    normal = turn[:, deep] * np.sign(facing[deep])
    aside, width = turn[:, 1 - deep], box.size[1 - deep]
    middle = np.array(box.centre) + normal * (box.size[deep] / 2 + BEFORE)
    ways = np.array(eyes, dtype=float).reshape(-1, 3) - middle
    seeing = [
        eye
        for eye, way in zip(eyes, ways, strict=True)
        if normal @ way > FLATTEST * np.linalg.norm(way)
    ]
    blockers = Blockers.of(around)
    for more in (each - width for each in widths if each - width > LESS):
        beyond = width / 2 + more * np.array(SHARES)
        for side in (-1.0, 1.0):
            ends = np.array(
                [
                    middle + side * away * aside + (0.0, 0.0, up * box.size[2])
                    for away in beyond
                    for up in HEIGHTS
                ]
            )
            starts = (np.broadcast_to(eye, ends.shape) for eye in seeing)
            if all(blockers.between(start, ends).all() for start in starts):
                return True
    return False
