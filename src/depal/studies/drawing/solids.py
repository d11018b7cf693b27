"""Solid cuboids with edges, light from above, each hiding what lies behind it."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from matplotlib.path import Path

from depal.studies.drawing.painter import MICROMETRES, Piece, painted
from depal.studies.drawing.palette import CASE_EDGE, PAPER, WOOD, Colour, blend, darker
from depal.studies.drawing.view import Array, View

CLEAR = (0.0, 0.0, 0.0, 0.0)
"""No colour at all."""


@dataclass(frozen=True, slots=True)
class Paint:
    """How one cuboid looks.

    Attributes:
        face: the colour of its sides.
        edge: the colour of its edges.
        width: of the edges [pt].
        lit: whether light falls on it; not where the colour is a number.
    """

    face: Colour
    edge: Colour = CASE_EDGE
    width: float = 0.8
    lit: bool = True

    def side(self, axis: int) -> Colour:
        """The colour of the side across an axis: light from above and from the robot."""
        if not self.lit:
            return self.face
        return (self.face, darker(self.face, 0.2), blend(self.face, PAPER, 0.38))[axis]


@dataclass(frozen=True, slots=True, eq=False)
class Solids:
    """Axis-aligned cuboids and their paint.

    Attributes:
        centres: (n, 3) [m].
        sizes: full edge lengths, (n, 3) [m].
        paints: one each.
    """

    centres: Array
    sizes: Array
    paints: Sequence[Paint]

    @property
    def lower(self) -> Array:
        """The corners with the smallest coordinates, (n, 3) [m]."""
        return self.centres - self.sizes / 2

    @property
    def upper(self) -> Array:
        """The corners with the greatest coordinates, (n, 3) [m]."""
        return self.centres + self.sizes / 2


def solids(centres: npt.ArrayLike, sizes: npt.ArrayLike, paints: Sequence[Paint]) -> Solids:
    """Cuboids from anything that holds (n, 3) numbers [m]; n may be 0."""
    return Solids(
        np.asarray(centres, dtype=float).reshape(-1, 3),
        np.asarray(sizes, dtype=float).reshape(-1, 3),
        tuple(paints),
    )


def pallet(lower: npt.ArrayLike, upper: npt.ArrayLike, height: float = 0.12) -> Solids:
    """A wooden pallet under a load.

    Args:
        lower: the load's corner with the smallest coordinates, (3,) [m].
        upper: the load's corner with the greatest coordinates, (3,) [m].
        height: of the pallet [m].
    """
    low, high = np.asarray(lower, dtype=float), np.asarray(upper, dtype=float)
    middle, size, board = (low + high) / 2, high - low, height / 4
    deck = (middle[0], middle[1], low[2] - board / 2), (size[0], size[1], board)
    foot = (size[0], size[1] * 0.07, height - board)
    level = low[2] - board - foot[2] / 2
    places = (low[1] + foot[1] / 2, middle[1], high[1] - foot[1] / 2)
    wood = Paint(WOOD, darker(WOOD, 0.4), 0.6)
    return solids(
        [deck[0], *((middle[0], place, level) for place in places)],
        [deck[1], *(foot for _ in places)],
        [wood] * 4,
    )


def together(*groups: Solids) -> Solids:
    """Several groups as one, so that they hide each other."""
    return Solids(
        np.concatenate([group.centres for group in groups]),
        np.concatenate([group.sizes for group in groups]),
        [paint for group in groups for paint in group.paints],
    )


def draw_solids(axes: Axes, view: View, group: Solids, layer: float = 2.0) -> None:
    """Paints cuboids from the farthest to the nearest."""
    paths: list[Path] = []
    faces: list[tuple[float, ...]] = []
    edges: list[Colour] = []
    widths: list[float] = []
    whole = np.rint(np.stack((group.lower, group.upper)) * MICROMETRES).astype(np.int64)
    for piece in painted(group.lower, group.upper, view.towards):
        paint = group.paints[piece.owner]
        for axis in range(3):
            side = _side(piece, whole[:, piece.owner], axis, view)
            if side is None:
                continue
            # The side itself, rimmed with its own colour against hairlines; then its edges.
            colour = paint.side(axis)
            paths += [Path(side.corners, closed=True), side.edges]
            faces += [colour, CLEAR]
            edges += [colour, paint.edge]
            widths += [0.3, paint.width]
    axes.add_collection(
        PathCollection(
            paths,
            facecolors=faces,
            edgecolors=edges,
            linewidths=widths,
            joinstyle="round",
            capstyle="round",
            zorder=layer,
        ),
        autolim=False,
    )


def outline(view: View, centre: npt.ArrayLike, size: npt.ArrayLike) -> list[Array]:
    """The nine edges that would be seen of a cuboid alone, each (2, 2) [m] in the picture."""
    low, high = _ends(centre, size)
    near = np.where(view.towards > 0, high, low)
    lines = []
    for axis in range(3):
        for corner in range(4):
            start = np.where(view.towards > 0, low, high)
            others = [other for other in range(3) if other != axis]
            for bit, other in enumerate(others):
                if corner >> bit & 1:
                    start[other] = near[other]
            if corner:
                end = start.copy()
                end[axis] = near[axis]
                lines.append(view.flat(np.stack((start, end))))
    return lines


@dataclass(frozen=True, slots=True, eq=False)
class _Side:
    """One side of a piece in the picture.

    Attributes:
        corners: (5, 2) [m], the first one again at the end.
        edges: those of its four edges that are edges of the whole cuboid.
    """

    corners: Array
    edges: Path


def _side(piece: Piece, whole: npt.NDArray[np.int64], axis: int, view: View) -> _Side | None:
    """The side across an axis that faces the viewer, or None where a cut made it.

    Args:
        piece: what is painted.
        whole: the lower and the upper corner of the cuboid that it is of, (2, 3) [um].
        axis: 0, 1 or 2.
        view: where the viewer stands.
    """
    ends = np.array((piece.lower, piece.upper))
    near = int(view.towards[axis] > 0)
    if ends[near, axis] != whole[near, axis]:
        return None
    first, second = (other for other in range(3) if other != axis)
    turns = np.array(((0, 0), (1, 0), (1, 1), (0, 1), (0, 0)))
    corners = np.empty((5, 3))
    corners[:, axis] = ends[near, axis]
    corners[:, first] = ends[turns[:, 0], first]
    corners[:, second] = ends[turns[:, 1], second]
    flat = view.flat(corners / MICROMETRES)
    # Edge k runs from corner k to k + 1, along which one coordinate stays the same.
    borders = ((second, 0), (first, 1), (second, 1), (first, 0))
    codes = [Path.MOVETO] + [
        Path.LINETO if ends[end, other] == whole[end, other] else Path.MOVETO
        for other, end in borders
    ]
    return _Side(flat, Path(flat, codes))


def _ends(centre: npt.ArrayLike, size: npt.ArrayLike) -> tuple[Array, Array]:
    """The lower and the upper corner, (3,) each [m]."""
    middle, half = np.asarray(centre, dtype=float), np.asarray(size, dtype=float) / 2
    return middle - half, middle + half
