"""Which cuboid to paint first, so that what is painted later hides only what lies behind it.

A cuboid hides another when a ray from the inside of the other towards the viewer meets its own
inside. Painting in an order that respects this relation gives a correct picture. Three cuboids
can hide each other in a circle; then one of them is cut where another one begins or ends, until
no circle is left. Coordinates are whole micrometres, so that touching is exact.
"""

import heapq
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from depal.studies.drawing.view import Array

MICROMETRES = 1_000_000
"""In a metre."""

Corner = tuple[int, int, int]
"""A corner in whole micrometres."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A cuboid, or what a cut has left of it.

    Attributes:
        owner: the index of the cuboid that it is of.
        lower: its corner with the smallest coordinates [um].
        upper: its corner with the greatest coordinates [um].
    """

    owner: int
    lower: Corner
    upper: Corner


def hiding(lower: npt.ArrayLike, upper: npt.ArrayLike, towards: Array) -> npt.NDArray[np.bool_]:
    """What hides what.

    Args:
        lower: corners with the smallest coordinates, (n, 3).
        upper: corners with the greatest coordinates, (n, 3).
        towards: from the scene to the viewer, (3,), no component zero.

    Returns:
        (n, n): true at [i, j] where cuboid j hides a part of cuboid i. Cuboids that share space
        would hide each other; neither is said to.
    """
    ends = np.stack((np.asarray(lower, dtype=float), np.asarray(upper, dtype=float)))
    ends = np.sort(ends * np.sign(towards), axis=0)
    # The steps along a ray that lead from the inside of i to the inside of j, axis by axis.
    enter = ((ends[0][None, :] - ends[1][:, None]) / np.abs(towards)).max(axis=2)
    leave = ((ends[1][None, :] - ends[0][:, None]) / np.abs(towards)).min(axis=2)
    hides: npt.NDArray[np.bool_] = np.maximum(enter, 0.0) < leave
    return hides & ~hides.T


def painted(lower: npt.ArrayLike, upper: npt.ArrayLike, towards: Array) -> list[Piece]:
    """The cuboids in the order in which to paint them, cut where no order would do.

    Args:
        lower: corners with the smallest coordinates, (n, 3) [m].
        upper: corners with the greatest coordinates, (n, 3) [m].
        towards: from the scene to the viewer, (3,), no component zero.

    Returns:
        At least one piece for each cuboid; a piece hides only pieces before it.
    """
    pieces = [
        Piece(owner, _corner(low), _corner(high))
        for owner, (low, high) in enumerate(zip(_whole(lower), _whole(upper), strict=True))
    ]
    while True:
        low = np.array([piece.lower for piece in pieces]).reshape(-1, 3)
        high = np.array([piece.upper for piece in pieces]).reshape(-1, 3)
        hides = hiding(low, high, towards)
        order = _order(hides, (low + high) @ towards)
        if len(order) == len(pieces):
            return [pieces[index] for index in order]
        circle = _circle(hides, set(range(len(pieces))).difference(order))
        index, halves = _cut(pieces, circle)
        pieces[index : index + 1] = halves


def _order(hides: npt.NDArray[np.bool_], nearness: Array) -> list[int]:
    """As many as can be painted, each after all that it hides, the farthest first."""
    behind = hides.sum(axis=0)
    ready = [(float(nearness[index]), int(index)) for index in np.flatnonzero(behind == 0)]
    heapq.heapify(ready)
    order = []
    while ready:
        _, index = heapq.heappop(ready)
        order.append(index)
        before = np.flatnonzero(hides[index])
        behind[before] -= 1
        for freed in before[behind[before] == 0]:
            heapq.heappush(ready, (float(nearness[freed]), int(freed)))
    return order


def _circle(hides: npt.NDArray[np.bool_], left: set[int]) -> list[int]:
    """Pieces that hide each other in a circle, among those that could not be painted."""
    walk = [min(left)]
    while True:
        farther = next(int(i) for i in np.flatnonzero(hides[:, walk[-1]]) if int(i) in left)
        if farther in walk:
            return walk[walk.index(farther) :]
        walk.append(farther)


def _cut(pieces: list[Piece], circle: list[int]) -> tuple[int, tuple[Piece, Piece]]:
    """A piece of the circle, and its halves where a side of another one runs through it.

    There is always one: where no side runs through any piece, the pieces are cells of a grid,
    and cells of a grid do not hide each other in a circle.
    """
    index, axis, level = next(
        (index, axis, level)
        for index in circle
        for other in circle
        for corner in (pieces[other].lower, pieces[other].upper)
        for axis, level in enumerate(corner)
        if pieces[index].lower[axis] < level < pieces[index].upper[axis]
    )
    piece = pieces[index]
    below = replace(piece, upper=_moved(piece.upper, axis, level))
    above = replace(piece, lower=_moved(piece.lower, axis, level))
    return index, (below, above)


def _whole(corners: npt.ArrayLike) -> npt.NDArray[np.int64]:
    """Corners in whole micrometres, (n, 3)."""
    metres = np.asarray(corners, dtype=float).reshape(-1, 3)
    whole: npt.NDArray[np.int64] = np.rint(metres * MICROMETRES).astype(np.int64)
    return whole


def _corner(row: npt.NDArray[np.int64]) -> Corner:
    """A row of three as a corner."""
    x, y, z = row.tolist()
    return x, y, z


def _moved(corner: Corner, axis: int, level: int) -> Corner:
    """The corner with one coordinate changed."""
    x, y, z = (level if along == axis else corner[along] for along in range(3))
    return x, y, z
