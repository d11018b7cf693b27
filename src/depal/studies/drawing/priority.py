"""Fig. 4: where on the pallet the position alone says "first"."""

import math
from dataclasses import replace

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, Polygon

from depal.geometry import Vector3
from depal.studies.drawing.lettering import BODY, SMALL, write
from depal.studies.drawing.palette import GREY, INK, LINE, PAPER, URGENCY, blend
from depal.studies.drawing.sheet import Sheet, joined, sheet
from depal.studies.drawing.solids import Paint, Solids, draw_solids, pallet, solids, together
from depal.studies.drawing.view import FROM_THE_ROBOT, Array

VIEW = FROM_THE_ROBOT

PALLET_HEIGHT = 0.12
"""Of the pallet under the load [m]."""

APPROACH = 0.8
"""How much of the floor before the load is shown [m]."""

BAR_ROOM = 1.2
"""For the colours and their values [in]."""


def grid_centres(lower: Vector3, upper: Vector3, counts: tuple[int, int, int]) -> Array:
    """The centres of equal cells that fill a volume.

    Args:
        lower: the volume's corner with the smallest coordinates [m].
        upper: the volume's corner with the greatest coordinates [m].
        counts: how many cells along x, y, z.

    Returns:
        (n, 3) [m], x slowest.
    """
    lines = [
        low + (np.arange(count) + 0.5) * (high - low) / count
        for low, high, count in zip(lower, upper, counts, strict=True)
    ]
    centres: Array = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1).reshape(-1, 3)
    return centres


def priority_field(
    centres: npt.ArrayLike, values: npt.ArrayLike, cell: Vector3, note: str = ""
) -> Figure:
    """The priority h(b) over the pallet's volume, from red (first) to blue (last); Fig. 4.

    Args:
        centres: of the cells, (n, 3) [m]; the robot is at the origin and looks along +x.
        values: h at the cells, (n,) [m].
        cell: the edges of one cell along x, y, z [m].
        note: the parameters of the run, for the caption.

    Returns:
        A figure of the volume as the robot's side sees it.
    """
    middles, heights = np.asarray(centres, dtype=float), np.asarray(values, dtype=float)
    size = np.asarray(cell, dtype=float)
    low, high = middles.min(axis=0) - size / 2, middles.max(axis=0) + size / 2
    paper = sheet(
        4.7,
        f"First the {_where(middles, heights.max() - heights)}, "
        f"last the {_where(middles, heights - heights.min())}",
        "The priority of a box by its position alone; the robot stands at the origin "
        "and looks along +x.",
        joined("After Fig. 4 and Eq. (1), section II-C", note),
    )
    left, bottom, width, height = paper.whole
    room = np.array(((-APPROACH, -0.25, -PALLET_HEIGHT), (0.0, 0.2, 0.0)))
    reach = np.stack((low, high)) + room
    seen = VIEW.flat(np.stack(np.meshgrid(*reach.T), axis=-1).reshape(-1, 3))
    (first, floor), (last, roof) = seen.min(axis=0), seen.max(axis=0)
    area = left, bottom, width - BAR_ROOM, height
    axes, _ = paper.picture(area, (first, last, floor, roof))
    scale = Normalize(float(heights.min()), float(heights.max()))
    draw_solids(
        axes,
        VIEW,
        together(pallet(low, high, PALLET_HEIGHT), _cells(middles, heights, size, scale)),
    )
    _edges(axes, low, high)
    _robot(axes, low, high)
    _bar(paper, scale)
    return paper.figure


def _where(centres: Array, cost: Array) -> str:
    """The place of the cell with the least cost, in words."""
    low, high = centres.min(axis=0), centres.max(axis=0)
    centre = centres[int(np.argmin(cost))]
    depth, _, height = ((centre - low) / np.maximum(high - low, 1e-9)).tolist()
    aside = abs(float(centre[1])) / max(abs(float(low[1])), abs(float(high[1])), 1e-9)
    level = _third(height, ("bottom", "middle", "top"))
    row = _third(depth, ("front", "middle", "back"))
    return f"{level} {row} {_third(aside, ('in the centre', 'half-way', 'at the sides'))}"


def _third(share: float, names: tuple[str, str, str]) -> str:
    """The name for the third that a share in [0, 1] lies in."""
    return names[min(int(share * 3), 2)]


def _cells(centres: Array, heights: Array, size: Array, scale: Normalize) -> Solids:
    """The cells that can be seen, coloured by h."""
    places = [
        tuple(row) for row in np.rint(centres / size - centres[0] / size).astype(int).tolist()
    ]
    taken = set(places)
    x, y, z = np.sign(VIEW.towards).astype(int).tolist()
    shown = [
        index
        for index, (i, j, k) in enumerate(places)
        if not {(i + x, j, k), (i, j + y, k), (i, j, k + z)} <= taken
    ]
    paints = []
    for value in heights[shown]:
        red, green, blue, _ = URGENCY(scale(float(value)))
        paints.append(
            Paint((red, green, blue), blend((red, green, blue), PAPER, 0.55), 0.6, lit=False)
        )
    return solids(centres[shown], np.tile(size, (len(shown), 1)), paints)


def _edges(axes: Axes, low: Array, high: Array) -> None:
    """The volume's three visible lengths, as arrows along the frame's axes."""
    gap, floor, (front, right, _), (back, left, _) = 0.14, low[2] - PALLET_HEIGHT, low, high
    rightward, leftward = SMALL, replace(SMALL, across="right")
    for name, start, end, share, style in (
        ("y", (front - gap, right, floor), (front - gap, left, floor), 0.24, leftward),
        ("x", (front, right - gap, floor), (back, right - gap, floor), 0.5, rightward),
        ("z", (front, left + gap / 2, low[2]), (front, left + gap / 2, high[2]), 0.5, leftward),
    ):
        ends = VIEW.flat((start, end))
        axes.add_patch(_arrow(ends))
        aside, drop = (0.04 if name == "x" else -0.04), (0.0 if name == "z" else 0.045)
        spot = ends[0] + (ends[1] - ends[0]) * share + (aside, -drop)
        words = f"{name}  {math.dist(start, end):.1f} m"
        write(axes, (float(spot[0]), float(spot[1])), words, style)


def _robot(axes: Axes, low: Array, high: Array) -> None:
    """The direction that the robot comes from, as an arrow on the floor."""
    middle, floor = (low[1] + high[1]) / 2, low[2] - PALLET_HEIGHT
    start, neck, tip = (low[0] - (APPROACH, 0.42, 0.25)).tolist()
    half = ((start, 0.045), (neck, 0.045), (neck, 0.11), (tip, 0.0))
    around = [*half, *((along, -aside) for along, aside in reversed(half[:3]))]
    points = [(along, middle + aside, floor) for along, aside in around]
    axes.add_patch(
        Polygon(VIEW.flat(points), closed=True, facecolor=INK, edgecolor="none", zorder=1)
    )
    tail = VIEW.flat((start, middle, floor))
    words = f"robot at the origin,\n{low[0]:.1f} m before the front"
    write(
        axes,
        (float(tail[0]) - 0.05, float(tail[1])),
        words,
        replace(BODY, size=9.5, across="right", up="center"),
    )


def _arrow(ends: Array) -> FancyArrowPatch:
    """A thin arrow between two points of the picture, (2, 2) [m]."""
    return FancyArrowPatch(
        *map(tuple, ends.tolist()),
        arrowstyle="-|>",
        mutation_scale=9.0,
        shrinkA=0,
        shrinkB=0,
        color=GREY,
        linewidth=1.0,
        zorder=1,
    )


def _bar(paper: Sheet, scale: Normalize) -> None:
    """The colours with their values, at the right of the sheet."""
    left, bottom, width, height = paper.whole
    axes = paper.chart((left + width - 0.85, bottom + 0.55, 0.2, height - 1.1))
    bar = paper.figure.colorbar(ScalarMappable(scale, URGENCY), cax=axes)
    bar.outline.set_visible(False)
    axes.tick_params(axis="y", length=3, color=LINE)
    axes.grid(visible=False)
    across, style = left + width - 0.85, replace(BODY, size=9.5)
    write(paper.figure, paper.point(across, height - 0.1), "h(b) [m]", replace(style, bold=True))
    write(paper.figure, paper.point(across, height - 0.36), "first", style)
    write(paper.figure, paper.point(across, 0.36), "last", style)
