"""Places of a relief as solids."""

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from depal.geometry import OrientedBox
from depal.ports import Relief

Flags = npt.NDArray[np.bool_]


def over(relief: Relief, box: OrientedBox, around: float) -> Flags:
    """The places that an upright box stands over, and so far around it [m].

    Args:
        relief: tells which places there are.
        box: in the relief's frame.
        around: see above.
    """
    rows, columns = np.indices(relief.heights.shape)
    middles = np.stack((rows + 0.5, columns + 0.5), axis=-1) * relief.step
    turn = np.array(box.pose.rotation)[:2, :2]
    off = np.abs((middles - np.array(box.centre[:2])) @ turn)
    return np.asarray((off < np.array(box.size[:2]) / 2 + around).all(axis=-1))


def solids_over(relief: Relief, places: Flags, low: float) -> tuple[OrientedBox, ...]:
    """Upright solids in the cell frame from a height [m] up to what is measured at these places."""
    return tuple(
        OrientedBox.from_corner(
            (first * relief.step, left * relief.step, low),
            ((last - first) * relief.step, (right - left) * relief.step, height - low),
        ).seen_from(relief.cell_from_grid)
        for first, last, left, right, height in _blocks(places, relief)
    )


def _blocks(high: Flags, relief: Relief) -> Iterator[tuple[int, int, int, int, float]]:
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
