"""The bench of perception: what was measured as dots beside targets, kind by kind of scene."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from depal.studies.drawing.lettering import BODY, SMALL, TYPEFACE, write
from depal.studies.drawing.palette import CHANGED, GREY, HAIR, INK, OURS, PAPER
from depal.studies.drawing.sheet import MARGIN, WIDTH, Sheet, joined, sheet

ROW, HEAD, FOOT, BETWEEN = 0.25, 0.36, 0.5, 0.12
"""Of a chart: a row, the room for its name, for its numbers, and below it [in]."""

KEY = 0.34
"""The height of the key [in]."""

NAMES, VALUES, GAP = 1.5, 0.5, 0.35
"""The width of the rows' names and of their values, and between two columns [in]."""

MARKERS = ("s", "^", "D", "v", "P")
"""Of the kinds of scenes, in their order."""


@dataclass(frozen=True, slots=True)
class Dots:
    """One quantity.

    Attributes:
        name: of the row.
        kinds: its value for each kind of scene; NaN where there is none.
        value: for all scenes together; NaN where there is none.
        ci95: its interval, where it is a share.
        target: NaN where there is none.
    """

    name: str
    kinds: tuple[float, ...]
    value: float
    ci95: tuple[float, float] | None = None
    target: float = math.nan


@dataclass(frozen=True, slots=True)
class Chart:
    """Quantities on one axis.

    Attributes:
        name: above it.
        unit: below it; empty for shares.
        rows: at least one.
        lower: whether lower values are better; then the axis begins at zero.
        ceiling: the greatest value that there can be, where there is one.
    """

    name: str
    unit: str
    rows: tuple[Dots, ...]
    lower: bool = False
    ceiling: float = math.inf


def perception_figure(
    columns: Sequence[Sequence[Chart]], kinds: Sequence[str], title: str, note: str = ""
) -> Figure:
    """Draws charts in columns.

    Args:
        columns: of charts, from the left and from the top.
        kinds: of scenes, as the rows' values have them.
        title: what was found, as a sentence.
        note: the parameters of the run, for the caption.
    """
    tall = max(sum(map(_height, charts)) for charts in columns)
    page = sheet(
        KEY + tall,
        title,
        "All scenes together with the 95 % interval, red where the target is missed, and by kind.",
        joined("Simulated scenes that perception was not tuned on", note),
    )
    _draw_key(page, kinds)
    width = (WIDTH - 2 * MARGIN - GAP * (len(columns) - 1)) / len(columns)
    for number, charts in enumerate(columns):
        top = tall
        for chart in charts:
            _draw_chart(page, chart, (MARGIN + number * (width + GAP), width), top)
            top -= _height(chart)
    return page.figure


def _height(chart: Chart) -> float:
    return HEAD + ROW * len(chart.rows) + FOOT + BETWEEN


def _draw_chart(page: Sheet, chart: Chart, place: tuple[float, float], top: float) -> None:
    """One chart; its place is where its column begins and how wide it is [in]."""
    left, width = place
    write(page.figure, page.point(left, top - HEAD / 2), chart.name, replace(BODY, bold=True))
    high = ROW * len(chart.rows)
    area = (left + NAMES, top - HEAD - high, width - NAMES - VALUES, high)
    axes = page.chart(area)
    axes.grid(visible=False)
    axes.grid(visible=True, axis="x", color=HAIR, linewidth=0.8)
    low, end = _extent(chart)
    axes.set_xlim(low, end)
    axes.set_ylim(len(chart.rows) - 0.5, -0.5)
    axes.set_yticks([])
    if chart.unit:
        axes.set_xlabel(chart.unit, color=GREY, size=9.0, family=TYPEFACE, labelpad=1.0)
    for number, row in enumerate(chart.rows):
        level = top - HEAD - ROW * (number + 0.5)
        style = replace(BODY, size=9.0, across="right")
        write(page.figure, page.point(left + NAMES - 0.12, level), row.name, style)
        _draw_row(axes, row, number, chart)
        style = replace(style, colour=CHANGED if _missed(row, chart) else INK, bold=True)
        write(page.figure, page.point(left + width, level), _said(row.value, chart), style)


def _draw_row(axes: Axes, row: Dots, number: int, chart: Chart) -> None:
    """Target, kinds, and all together."""
    if not math.isnan(row.target):
        axes.plot((row.target,) * 2, (number - 0.4, number + 0.4), color=INK, linewidth=1.3)
    for value, marker in zip(row.kinds, MARKERS, strict=False):
        axes.plot(
            (value,), (number,), marker, color=GREY, markersize=4.2, markerfacecolor=PAPER,
            markeredgewidth=0.9, clip_on=False, zorder=4,
        )  # fmt: skip
    colour = CHANGED if _missed(row, chart) else OURS
    if row.ci95 is not None:
        axes.plot(row.ci95, (number, number), color=colour, linewidth=1.6, zorder=5)
    axes.plot((row.value,), (number,), "o", color=colour, markersize=6.0, clip_on=False, zorder=6)


def _extent(chart: Chart) -> tuple[float, float]:
    """What the axis shows."""
    ends = [row.ci95 or (row.value, row.value) for row in chart.rows]
    values = [value for row in chart.rows for value in (*row.kinds, row.value, row.target)]
    known = [
        value for value in (*values, *(v for end in ends for v in end)) if not math.isnan(value)
    ]
    if not known:
        return 0.0, 1.0
    low, high = min(known), max(known)
    if chart.lower:
        return 0.0, max(high, 1e-6) * 1.08
    room = max(high - low, 0.02 * high, 1e-6)
    return low - 0.06 * room, min(high + 0.06 * room, chart.ceiling)


def _missed(row: Dots, chart: Chart) -> bool:
    if math.isnan(row.target):
        return False
    met = row.value <= row.target if chart.lower else row.value >= row.target
    return not met


def _said(value: float, chart: Chart) -> str:
    if math.isnan(value):
        return "\N{EN DASH}"
    if not chart.unit:
        return f"{value:.3f}"
    return f"{value:.2f}" if 0 < value < 1 else f"{value:.1f}"


def _draw_key(page: Sheet, kinds: Sequence[str]) -> None:
    """What marks mean, above the charts."""
    level, across = page.height - KEY / 2, MARGIN
    entries = [("all scenes", "o", OURS, OURS, 6.0)]
    entries += [(kind, mark, GREY, PAPER, 4.6) for kind, mark in zip(kinds, MARKERS, strict=False)]
    for words, marker, colour, filled, size in entries:
        x, y = page.point(across + 0.05, level)
        dot = Line2D(
            (x,), (y,), marker=marker, color=colour, markerfacecolor=filled, markersize=size,
            linestyle="none", transform=page.figure.transFigure,
        )  # fmt: skip
        page.figure.add_artist(dot)
        write(page.figure, page.point(across + 0.17, level), words, replace(SMALL, size=9.0))
        across += 0.17 + 0.08 * len(words) + 0.3
    x, y = page.point(across + 0.05, level)
    tick = Line2D(
        (x, x), (page.point(0, level - 0.07)[1], page.point(0, level + 0.07)[1]),
        color=INK, linewidth=1.3, transform=page.figure.transFigure,
    )  # fmt: skip
    page.figure.add_artist(tick)
    write(page.figure, page.point(across + 0.15, level), "target", replace(SMALL, size=9.0))
