"""What was taken for a face and is none: nothing that looks like it is proposed again.

A gripper that cannot seal on a box that the picture shows, or a person who finds none, tells that
the picture was read wrong: two boxes side by side, say, were taken for one. What is seen there is
still there, so the next best that explains it is looked for.
"""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from depal.geometry import OrientedBox
from depal.perception.faces import Raster, Rectangle
from depal.perception.proposals.candidates import Candidates

Flags = npt.NDArray[np.bool_]

SAME = 0.025
"""A candidate whose sides are all within this of a refuted face is that face again [m]."""

DEEP = 0.06
"""A candidate so far before or behind it is another [m]."""


def refuted_on(raster: Raster, boxes: Sequence[OrientedBox]) -> tuple[Rectangle, ...]:
    """The faces that upright boxes would show on a raster.

    Args:
        raster: of fronts or of tops.
        boxes: in the cell frame.
    """
    return tuple(_face(raster, box) for box in boxes)


def _face(raster: Raster, box: OrientedBox) -> Rectangle:
    """The face of a box that looks to the raster's viewer, its edges along the raster's."""
    local = np.abs(
        np.array(raster.cell_from_raster.inverse.rotation) @ np.array(box.pose.rotation)
    ) @ np.array(box.size)
    width, height, depth = local.tolist()
    u, v, middle = raster.cell_from_raster.inverse.apply(box.centre)
    return Rectangle(u, v, width, height, 0.0, middle - depth / 2)


def is_refuted(candidates: Candidates, refuted: Sequence[Rectangle]) -> Flags:
    """(n,): which candidates are a refuted face again.

    Args:
        candidates: on one raster.
        refuted: faces on it, their edges along its own.
    """
    u, v, w, h, _, depth = candidates.values.T
    out = np.zeros(len(candidates), dtype=np.bool_)
    for each in refuted:
        along = np.abs(u - each.u) + np.abs(w - each.width) / 2
        across = np.abs(v - each.v) + np.abs(h - each.height) / 2
        out |= (np.maximum(along, across) < SAME) & (np.abs(depth - each.depth) < DEEP)
    return out
