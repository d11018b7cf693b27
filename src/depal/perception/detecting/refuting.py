"""What was taken for a face and is none: nothing that looks like it is proposed again.

A gripper of whose cups some seal on a box that the picture shows, or a person who finds none, tells
that the picture was read wrong: two boxes side by side, say, were taken for one. What is seen there
is still there, so the next best that explains it is looked for.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.geometry import OrientedBox
from depal.perception.faces import Raster, Rectangle
from depal.perception.proposals.candidates import Candidates

Flags = npt.NDArray[np.bool_]

SAME = 0.025
"""A candidate whose sides are all within this of a refuted face is that face again [m]."""

BEYOND = 0.006
"""A candidate reaches over all of a place whose sides are so far outside of it: a cup that leaks at
the edge of a face tells of no seam [m]."""

DEEP = 0.06
"""A candidate so far before or behind it is another [m]."""

FLAT = 0.5
"""A place is seen from the side where it is deeper than this share of its lesser edge."""


@dataclass(frozen=True, slots=True)
class RefutedFaces:
    """What is no face of a raster.

    Attributes:
        faces: that are none, their edges along the raster's own.
        spans: places over all of which no one face reaches.
    """

    faces: tuple[Rectangle, ...] = ()
    spans: tuple[Rectangle, ...] = ()

    def among(self, candidates: Candidates) -> Flags:
        """(n,): which candidates are refuted."""
        u, v, w, h, _, depth = candidates.values.T
        out = np.zeros(len(candidates), dtype=np.bool_)
        for each in self.faces:
            along = np.abs(u - each.u) + np.abs(w - each.width) / 2
            across = np.abs(v - each.v) + np.abs(h - each.height) / 2
            near = np.abs(depth - each.depth) < DEEP
            out |= (np.maximum(along, across) < SAME) & near
        for each in self.spans:
            along = np.abs(u - each.u) + (each.width - w) / 2
            across = np.abs(v - each.v) + (each.height - h) / 2
            near = np.abs(depth - each.depth) < DEEP
            out |= (np.maximum(along, across) < -BEYOND) & near
        return out


@dataclass(frozen=True, slots=True)
class Refuted:
    """What is no box, in the cell frame.

    Attributes:
        boxes: that were believed, upright.
        spans: flat places that lie on no one face: of cups there some sealed and others did not.
    """

    boxes: tuple[OrientedBox, ...] = ()
    spans: tuple[OrientedBox, ...] = ()

    def on(self, raster: Raster) -> RefutedFaces:
        """What of it a raster would show."""
        return RefutedFaces(_seen(raster, self.boxes, np.inf), _seen(raster, self.spans, FLAT))


def _seen(raster: Raster, solids: Sequence[OrientedBox], flat: float) -> tuple[Rectangle, ...]:
    """What solids show on a raster, their edges along its own; those that are flat enough."""
    raster_from_cell = raster.cell_from_raster.inverse
    out = []
    for solid in solids:
        turned = np.array(raster_from_cell.rotation) @ np.array(solid.pose.rotation)
        width, height, depth = (np.abs(turned) @ np.array(solid.size)).tolist()
        u, v, middle = raster_from_cell.apply(solid.centre)
        if depth < flat * min(width, height):
            out.append(Rectangle(u, v, width, height, 0.0, middle - depth / 2))
    return tuple(out)
