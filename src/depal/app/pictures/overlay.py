"""What was seen, drawn over the pictures that it was seen in."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch, Polygon
from matplotlib.patheffects import Normal, withStroke

from depal.app.pictures.marks import Spot, spots_for
from depal.studies.drawing.lettering import BODY, SMALL, write
from depal.studies.drawing.palette import GREY, INK, PAPER, Colour
from depal.studies.drawing.sheet import MARGIN, WIDTH, Area, Sheet, sheet

Floats = npt.NDArray[np.float64]

FRONT: Colour = to_rgb("#0072b2")
TOP: Colour = to_rgb("#d55e00")
"""Blue and vermilion are told apart by every kind of eye (Okabe and Ito); lines differ as well."""

LineStyle = Literal["solid"] | tuple[float, Sequence[float]]

SOLID: LineStyle = "solid"
DASHED: LineStyle = (0.0, (3.2, 1.4))
DOTTED: LineStyle = (0.0, (1.2, 1.2))

ARROW: dict[str, Any] = {
    "arrowstyle": "-|>",
    "mutation_scale": 7.5,
    "shrinkA": 0.0,
    "shrinkB": 0.0,
    "linewidth": 1.1,
}

BETWEEN, TALLEST, KEY, NAMES = 0.2, 7.5, 0.42, 0.24
"""Between two pictures; of a picture at the most; of the key; of the pictures' names [in]."""

AROUND = 0.06
"""So much of the picture is kept around what is marked, as a share of its extent."""

LETTERS = 6.6
"""Of the words on a picture [pt]."""

LINE, LETTER, PAD = 0.108, 0.0585, 0.035
"""Of these words: a line's height, a letter's width, the paper around [in]."""

PALE = 0.12
"""So much lighter is the picture below what is drawn on it."""

TRIM = 0.3
"""An arrow leaves out such a share of its way at both ends."""


@dataclass(frozen=True, slots=True, eq=False)
class Mark:
    """An outline with words.

    Attributes:
        outline: (4, 2) in the picture [pixel].
        words: lines, the first in bold.
        top: whether it is a top, which is drawn dashed and in another colour.
        sure: whether the words are certain; others are grey.
    """

    outline: Floats
    words: tuple[str, ...]
    top: bool = False
    sure: bool = True


@dataclass(frozen=True, slots=True, eq=False)
class Arrow:
    """From one mark to another.

    Attributes:
        start: index of a mark of the same picture.
        end: another.
        dotted: whether it says that one hides the other, not that it stands on it.
    """

    start: int
    end: int
    dotted: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Panel:
    """A picture with what is drawn on it.

    Attributes:
        name: of the camera; may be empty.
        colour: (h, w, 3) uint8, RGB.
        marks: on it.
        arrows: between them.
    """

    name: str
    colour: npt.NDArray[np.uint8]
    marks: tuple[Mark, ...] = ()
    arrows: tuple[Arrow, ...] = ()


def overlay(panels: Sequence[Panel], title: str, note: str) -> Figure:
    """Draws pictures side by side, each cut to what is marked on it.

    Args:
        panels: at least one.
        title: what was found, as a sentence.
        note: where the pictures come from, for the caption.
    """
    windows = [_window(panel) for panel in panels]
    shapes = [(right - left) / (bottom - top) for left, right, top, bottom in windows]
    room = WIDTH - 2 * MARGIN - BETWEEN * (len(panels) - 1)
    height = min(room / sum(shapes), TALLEST)
    names = NAMES if any(panel.name for panel in panels) else 0.0
    page = sheet(
        height + names + KEY,
        title,
        "On each face its box, its score, and the end of its product's number (?: not certain).",
        note,
    )
    left = MARGIN + (room - height * sum(shapes)) / 2
    for panel, window, shape in zip(panels, windows, shapes, strict=True):
        area = (left, KEY, height * shape, height)
        _draw(page, panel, window, area)
        if panel.name:
            at = page.point(left, KEY + height + NAMES / 2)
            write(page.figure, at, panel.name, replace(BODY, bold=True))
        left += height * shape + BETWEEN
    _draw_key(page, any(panel.arrows for panel in panels))
    return page.figure


def _window(panel: Panel) -> tuple[int, int, int, int]:
    """Left, right, top, bottom of what is shown of a picture [pixel]."""
    height, width = panel.colour.shape[:2]
    if not panel.marks:
        return 0, width, 0, height
    corners = np.concatenate([mark.outline for mark in panel.marks])
    low, high = corners.min(axis=0), corners.max(axis=0)
    rim = AROUND * float((high - low).max())
    left, top = np.clip(low - rim, 0, (width - 1, height - 1)).astype(int).tolist()
    right, bottom = np.ceil(np.clip(high + rim, (left + 1, top + 1), (width, height))).tolist()
    return left, int(right), top, int(bottom)


def _draw(page: Sheet, panel: Panel, window: tuple[int, int, int, int], area: Area) -> None:
    """One picture; its axes are in pixels of the camera's picture."""
    left, right, top, bottom = window
    axes, scale = page.picture(area, (left - 0.5, right - 0.5, -bottom + 0.5, -top + 0.5))
    axes.invert_yaxis()
    axes.set_ylim(bottom - 0.5, top - 0.5)
    shown = panel.colour[top:bottom, left:right] * (1 - PALE) + 255 * PALE
    axes.imshow(
        shown.astype(np.uint8),
        extent=(left - 0.5, right - 0.5, bottom - 0.5, top - 0.5),
        aspect="auto",
        interpolation="antialiased",
        zorder=0,
    )
    for mark in panel.marks:
        _draw_outline(axes, mark)
    for arrow in panel.arrows:
        _draw_arrow(axes, panel, arrow)
    corner = np.array((left, top))
    outlines = [(mark.outline - corner) * scale for mark in panel.marks]
    spots = spots_for(outlines, [_size(mark) for mark in panel.marks], (area[2], area[3]))
    for mark, spot in zip(panel.marks, spots, strict=True):
        _draw_words(axes, mark, spot, corner, 1 / scale)


def _draw_outline(axes: Axes, mark: Mark) -> None:
    axes.add_patch(
        Polygon(
            mark.outline,
            closed=True,
            fill=False,
            edgecolor=TOP if mark.top else FRONT,
            linewidth=1.5,
            linestyle=DASHED if mark.top else SOLID,
            joinstyle="round",
            path_effects=[withStroke(linewidth=3.0, foreground=PAPER)],
            zorder=4 if mark.top else 5,
        )
    )


def _draw_arrow(axes: Axes, panel: Panel, arrow: Arrow) -> None:
    start, end = (panel.marks[index].outline.mean(axis=0) for index in (arrow.start, arrow.end))
    axes.add_patch(
        FancyArrowPatch(
            tuple(start + TRIM * (end - start)),
            tuple(end - TRIM * (end - start)),
            color=INK,
            linestyle=DOTTED if arrow.dotted else SOLID,
            **ARROW,
            path_effects=[withStroke(linewidth=2.6, foreground=PAPER), Normal()],
            zorder=6,
        )
    )


def _size(mark: Mark) -> tuple[float, float]:
    """Of the words on their paper [in]."""
    longest = max(map(len, mark.words), default=0)
    return longest * LETTER + 2 * PAD, len(mark.words) * LINE + PAD


def _draw_words(axes: Axes, mark: Mark, spot: Spot, corner: Floats, inch: float) -> None:
    """Words on a slip of paper, and the line that leads from it to where they belong.

    Args:
        axes: of the picture.
        mark: whose words.
        spot: where they stand.
        corner: of the window [pixel].
        inch: one inch of the sheet [pixel].
    """
    colour = TOP if mark.top else FRONT
    x, y = (corner + np.array((spot.x, spot.y)) * inch).tolist()
    if not spot.inside:
        a, b = mark.outline.mean(axis=0).tolist()
        axes.plot((a, x), (b, y), color=PAPER, linewidth=2.2, zorder=7)
        axes.plot((a, x), (b, y), color=colour, linewidth=0.9, zorder=8)
        axes.plot((a,), (b,), "o", color=colour, markersize=2.6, markeredgecolor=PAPER, zorder=8)
    wide, high = spot.width * inch, spot.height * inch
    axes.add_patch(
        FancyBboxPatch(
            (x - wide / 2, y - high / 2),
            wide,
            high,
            boxstyle=f"round,pad=0,rounding_size={0.03 * inch}",
            facecolor=(*PAPER, 0.86),
            edgecolor=colour if not spot.inside else "none",
            linewidth=0.6,
            zorder=9,
        )
    )
    count = len(mark.words)
    for number, line in enumerate(mark.words):
        level = y + (number - (count - 1) / 2) * LINE * inch
        head = number == 0
        ink = INK if head or mark.sure else GREY
        style = replace(BODY, size=LETTERS, across="center", bold=head, colour=ink, layer=10)
        write(axes, (x, level), line, style)


def _draw_key(page: Sheet, arrows: bool) -> None:  # noqa: FBT001 - whether there are any
    """What lines mean."""
    entries: list[tuple[str, Colour, LineStyle, bool]] = [
        ("front", FRONT, SOLID, False),
        ("top", TOP, DASHED, False),
    ]
    if arrows:
        entries += [
            ("is on top of", INK, SOLID, True),
            ("hides from the robot", INK, DOTTED, True),
        ]
    across, level = MARGIN, KEY / 2 - 0.06
    for words, colour, style, headed in entries:
        start, end = page.point(across, level), page.point(across + 0.34, level)
        line: Artist = Line2D(
            (start[0], end[0]),
            (start[1], end[1]),
            color=colour,
            linewidth=1.8,
            linestyle=style,
            transform=page.figure.transFigure,
        )
        if headed:
            line = FancyArrowPatch(
                start,
                end,
                color=colour,
                linestyle=style,
                transform=page.figure.transFigure,
                **ARROW,
            )
        page.figure.add_artist(line)
        write(page.figure, page.point(across + 0.42, level), words, replace(SMALL, size=8.5))
        across += 0.42 + 0.075 * len(words) + 0.35
