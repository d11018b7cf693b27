"""Where an unseen box may be: every placement of its size in what nobody has looked into."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from depal.selection.hidden.volume import NOBODY, Array, Cells, Owners, Region, View

Indices = npt.NDArray[np.intp]

SHARE = 0.7
"""A box is seen when so much of its front or of its top is in the open."""

CARRIED = 0.35
"""So much of a box's base stands on something, or on what may be something."""


@dataclass(frozen=True, slots=True, eq=False)
class Placements:
    """Windows of whole cells into which the wanted box fits.

    Attributes:
        first: (m, 3) the lowest cell of each window.
        spans: (m, 3) how many cells each has along x, y, z.
        sizes: (m, 3) the edges of the box as it lies there [m].
    """

    first: Indices
    spans: Indices
    sizes: Array

    def __len__(self) -> int:
        """How many."""
        return len(self.first)

    def centres(self, region: Region) -> Array:
        """(m, 3) the middles of the windows in the cell frame [m]."""
        middles: Array = np.array(region.low) + (self.first + self.spans / 2) * region.cell
        return middles


@dataclass(frozen=True, eq=False)
class Scene:
    """What is known of the region after a look.

    Attributes:
        region: the pallet's.
        owners: (x, y, z) the seen box of each cell, NOBODY in all others.
        empty: (x, y, z) cells known to be empty.
        view: of everything that is there, as far as it is known.
    """

    region: Region
    owners: Owners
    empty: Cells
    view: View

    @cached_property
    def solid(self) -> "Sums":
        """Cells of seen boxes."""
        return Sums(self.owners != NOBODY)

    @cached_property
    def vacant(self) -> "Sums":
        """Cells known to be empty."""
        return Sums(self.empty)


class Sums:
    """Counts of cells in windows, by sums over everything below a corner (Crow 1984)."""

    def __init__(self, cells: Cells) -> None:
        """Of marked cells."""
        self._sums = np.zeros(tuple(n + 1 for n in cells.shape), np.int64)
        self._sums[1:, 1:, 1:] = cells.cumsum(0).cumsum(1).cumsum(2)

    def within(self, first: Indices, spans: Indices) -> npt.NDArray[np.int64]:
        """(m,) how many marked cells lie in each window; what is outside the grid counts as not."""
        room = np.array(self._sums.shape) - 1
        low = np.clip(first, 0, room)
        high = np.clip(first + spans, 0, room)
        total = np.zeros(len(first), np.int64)
        for corner in range(8):
            picks = [(corner >> axis) & 1 for axis in range(3)]
            at = tuple(np.where(picks[axis], high[:, axis], low[:, axis]) for axis in range(3))
            sign = -1 if (3 - sum(picks)) % 2 else 1
            total += sign * self._sums[at]
        return total


def placements(scene: Scene, size: tuple[float, float, float]) -> Placements:
    """All places of a box that nobody has seen.

    Args:
        scene: what is known.
        size: length, width and height of the upright box [m]; it may be turned by a quarter.

    Returns:
        Windows without a cell that is empty or taken by a seen box, on whose base something may
        carry, and in which the box would not have been seen.
    """
    length, width, height = size
    turned = [(length, width, height)]
    if abs(length - width) > 0.0:
        turned.append((width, length, height))
    found = [_fitting(scene, each) for each in turned]
    first, spans, sizes = (
        np.concatenate([getattr(each, name) for each in found])
        for name in ("first", "spans", "sizes")
    )
    return Placements(first, spans, sizes)


def window_of(region: Region, size: Array) -> Indices:
    """(3,) cells of a box's window: none but such whose centres are in the box, wherever it is."""
    cells = np.floor(size / region.cell + 1e-9).astype(np.intp)
    return np.clip(cells, 1, np.array(region.shape))


def _fitting(scene: Scene, size: tuple[float, float, float]) -> Placements:
    edges = np.array(size)
    span = window_of(scene.region, edges)
    room = np.array(scene.region.shape) - span + 1
    first = np.indices(tuple(room)).reshape(3, -1).T
    spans = np.broadcast_to(span, first.shape)
    fits = scene.solid.within(first, spans) + scene.vacant.within(first, spans) == 0
    first, spans = first[fits], spans[fits]
    below = layer(first, spans, 2, low=True)
    open_below = scene.vacant.within(*below) / (span[0] * span[1])
    fits = open_below <= 1 - CARRIED
    for share in exposed(scene.view, first, spans):
        fits &= share < SHARE
    kept = int(fits.sum())
    return Placements(first[fits], spans[fits], np.broadcast_to(edges, (kept, 3)))


def exposed(view: View, first: Indices, spans: Indices) -> tuple[Array, Array]:
    """(m,) shares of the windows' fronts and of their tops that lines of sight reach."""
    return _reached(view.along, first, spans, 0), _reached(view.down, first, spans, 2)


def _reached(passed: Cells, first: Indices, spans: Indices, axis: int) -> Array:
    """The share of a side's cells before which lines of sight have passed."""
    side_first, side_spans = layer(first, spans, axis, low=axis == 0)
    face = side_spans.prod(axis=1)
    place = side_first[:, axis]
    outside = (place < 0) | (place >= passed.shape[axis])
    share: Array = np.where(outside, 1.0, Sums(passed).within(side_first, side_spans) / face)
    return share


def layer(first: Indices, spans: Indices, axis: int, *, low: bool) -> tuple[Indices, Indices]:
    """The layer of cells that touches a side of each window."""
    side_first, side_spans = first.copy(), spans.copy()
    side_first[:, axis] = first[:, axis] - 1 if low else first[:, axis] + spans[:, axis]
    side_spans[:, axis] = 1
    return side_first, side_spans
