"""What is measured higher than a box around it: a tool that comes to its top keeps clear of it."""

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from depal.geometry import OrientedBox
from depal.ports import Relief

Flags = npt.NDArray[np.bool_]

HIGHER = 0.03
"""What is measured higher than a box's top by less may be the top itself [m]."""

NEAR = 0.5
"""No tool reaches farther from the middle of the box that it takes [m]."""

AROUND = 0.02
"""Where a box has left, what was measured so far around it may have been its edge [m]."""


def towers(
    relief: Relief, box: OrientedBox, gone: Iterable[OrientedBox] = ()
) -> tuple[OrientedBox, ...]:
    """Upright solids in the cell frame around what is higher than a box, near to it.

    Args:
        relief: as it was measured.
        box: that a tool is to come to.
        gone: boxes that have left since; what was measured there is not there any more.
    """
    rows, columns = np.indices(relief.heights.shape)
    middles = np.stack((rows + 0.5, columns + 0.5), axis=-1) * relief.step
    grid_from_cell = relief.cell_from_grid.inverse
    x, y, z = grid_from_cell.apply(box.centre)
    top = z + box.size[2] / 2
    with np.errstate(invalid="ignore"):
        high = relief.heights > top + HIGHER
    high &= np.hypot(middles[..., 0] - x, middles[..., 1] - y) < NEAR
    for each in gone:
        high &= ~_over(each.seen_from(grid_from_cell), middles)
    return tuple(
        OrientedBox.from_corner(
            (first * relief.step, left * relief.step, top),
            ((last - first) * relief.step, (right - left) * relief.step, height - top),
        ).seen_from(relief.cell_from_grid)
        for first, last, left, right, height in _blocks(high, relief)
    )


def _over(box: OrientedBox, middles: npt.NDArray[np.float64]) -> Flags:
    """The places that an upright box stands on, and a bit around."""
    turn = np.array(box.pose.rotation)[:2, :2]
    off = np.abs((middles - np.array(box.centre[:2])) @ turn)
    return np.asarray((off < np.array(box.size[:2]) / 2 + AROUND).all(axis=-1))


def _blocks(high: Flags, relief: Relief) -> Iterable[tuple[int, int, int, int, float]]:
    """Rows from, to, columns from, to, and height of rectangles that together are all places."""
    open_: dict[tuple[int, int], tuple[int, float]] = {}
    for row in range(len(high) + 1):
        runs = set(_runs(high[row])) if row < len(high) else set()
        for left, right in sorted(set(open_) - runs):
            first, height = open_.pop((left, right))
            yield first, row, left, right, height
        for left, right in runs:
            first, height = open_.get((left, right), (row, -np.inf))
            reached = float(relief.heights[row, left:right].max())
            open_[left, right] = (first, max(height, reached))


def _runs(flags: Flags) -> list[tuple[int, int]]:
    """Where flags are set: from, to."""
    edges = np.flatnonzero(np.diff(flags.astype(np.int8), prepend=0, append=0))
    return list(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))
