"""Table I: actions until the requested box is stored, ours and the paper's side by side."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from depal.studies.drawing.lettering import BODY, SMALL, TYPEFACE, write
from depal.studies.drawing.palette import GREY, HAIR, INK, LINE, OURS, PAPER, Colour
from depal.studies.drawing.sheet import MARGIN, WIDTH, Sheet, joined, sheet

ROW = 0.27
"""The height of a line of the table [in]."""

COLUMNS = (0.95, 1.75, 2.65, 3.75, 4.65)
"""The right ends of: avg/std, h ours, h paper, h+l ours, h+l paper [in]."""

TABLE = 4.75
"""The width of the table [in]."""

HEAD = 2.3
"""The height of the table's head, in lines."""

FOOT = 1.7
"""The height of the axis below, in lines."""

Pair = tuple[float, float]
"""A number for h(x) only and one for h(x) + l(x)."""

Z95 = 1.96
"""Half the width of a 95 % interval, in standard errors."""


@dataclass(frozen=True, slots=True)
class TableRow:
    """The actions needed at one weight: boxes stored before the requested one.

    Attributes:
        weight: w, in [0, 1].
        h_mean: with h(x) only, on average.
        h_std: with h(x) only, standard deviation.
        hl_mean: with h(x) + l(x), on average.
        hl_std: with h(x) + l(x), standard deviation.
    """

    weight: float
    h_mean: float
    h_std: float
    hl_mean: float
    hl_std: float


def table_figure(
    ours: Sequence[TableRow],
    paper: Sequence[TableRow],
    pallets: int,
    paper_pallets: int = 50,
    note: str = "",
) -> Figure:
    """Table I in the paper's layout, and the means with their intervals beside it.

    Args:
        ours: one row for each weight; at least one.
        paper: the paper's rows; weights that it does not have are left blank.
        pallets: how many pallets are behind each of our means.
        paper_pallets: how many are behind each of the paper's.
        note: the parameters of the run, for the caption.
    """
    rows = sorted(ours, key=lambda row: row.weight)
    theirs = {row.weight: row for row in paper}
    height = ROW * (HEAD + 2 * len(rows) + FOOT)
    page = sheet(
        height,
        _finding(rows),
        "Boxes stored before the requested one: average and standard deviation (left); averages "
        "with the 95 % interval that so many pallets allow (right).",
        joined(
            "After Table I, section III-B",
            f"depal: {pallets:,} pallets a cell",
            f"paper: {paper_pallets:,}",
            note,
        ),
    )
    _draw_table(page, rows, theirs)
    _draw_means(page, rows, theirs, (pallets, paper_pallets))
    return page.figure


def _finding(rows: Sequence[TableRow]) -> str:
    """The title: from the baseline to the best weight."""
    best = min(rows, key=lambda row: row.hl_mean)
    numbers = f"{best.h_mean:.1f} actions", f"{best.hl_mean:.1f} at w = {best.weight:g}"
    if best.hl_mean < best.h_mean:
        return f"Knowing the request cuts {numbers[0]} to {numbers[1]}"
    return f"Knowing the request saves nothing: {numbers[0]} become {numbers[1]}"


def _draw_table(page: Sheet, rows: Sequence[TableRow], theirs: dict[float, TableRow]) -> None:
    """The numbers, in inches from the body's lower left corner."""
    left, _, _, height = page.whole
    axes, _ = page.picture((left, 0.0, TABLE, height), (0.0, TABLE, 0.0, height))
    head = replace(BODY, bold=True)
    under = height - HEAD * ROW
    _rule(axes, height - 0.02, INK, 1.2)
    write(axes, (0.0, under + ROW * 0.6), "weight", head)
    for name, (own, other) in (("h(x) only", COLUMNS[1:3]), ("h(x) + l(x)", COLUMNS[3:5])):
        start = own - 0.5
        write(axes, ((start + other) / 2, under + ROW * 1.75), name, replace(head, across="center"))
        axes.plot((start, other), (under + ROW * 1.2,) * 2, color=LINE, linewidth=0.8)
        for end, series, colour in ((own, "depal", OURS), (other, "paper", GREY)):
            style = replace(BODY, colour=colour, across="right", bold=series == "depal")
            write(axes, (end, under + ROW * 0.6), series, style)
    _rule(axes, under, INK, 0.8)
    for number, row in enumerate(rows):
        level = under - ROW * (2 * number + 0.5)
        write(axes, (0.0, level - ROW / 2), f"w = {row.weight:g}", BODY)
        paper = theirs.get(row.weight)
        _draw_line(axes, level, "avg", _means(row), _means(paper) if paper else ())
        _draw_line(axes, level - ROW, "std", _deviations(row), _deviations(paper) if paper else ())
        if number + 1 < len(rows):
            _rule(axes, level - ROW * 1.5, HAIR, 0.8)
    _rule(axes, under - ROW * 2 * len(rows), INK, 1.2)


def _means(row: TableRow) -> Pair:
    """Both averages of a row."""
    return row.h_mean, row.hl_mean


def _deviations(row: TableRow) -> Pair:
    """Both standard deviations of a row."""
    return row.h_std, row.hl_std


def _draw_line(axes: Axes, level: float, name: str, ours: Pair, paper: Pair | tuple[()]) -> None:
    """One line of the table: averages in ink, deviations in grey, the paper's always grey."""
    style = replace(BODY, across="right", colour=INK if name == "avg" else GREY)
    write(axes, (COLUMNS[0], level), name, replace(style, colour=GREY, size=9.0))
    for value, end in zip(ours, COLUMNS[1::2], strict=True):
        write(axes, (end, level), f"{value:.2f}", replace(style, bold=name == "avg"))
    for value, end in zip(paper, COLUMNS[2::2], strict=False):
        write(axes, (end, level), f"{value:.2f}", replace(style, colour=GREY))


def _rule(axes: Axes, level: float, colour: Colour, width: float) -> None:
    """A line across the table."""
    axes.plot((0.0, TABLE), (level, level), color=colour, linewidth=width, clip_on=False)


def _draw_means(
    page: Sheet, rows: Sequence[TableRow], theirs: dict[float, TableRow], counts: tuple[int, int]
) -> None:
    """The averages as dots on the level of their rows, with their intervals."""
    left, _, width, height = page.whole
    start, under, foot = left + TABLE + 0.45, height - HEAD * ROW, FOOT * ROW
    axes = page.chart((start, foot, left + width - start, under - foot))
    axes.grid(visible=False)
    axes.grid(visible=True, axis="x", color=HAIR, linewidth=0.8)
    axes.set_ylim(foot, under)
    axes.set_yticks([])
    axes.set_xlabel("actions [boxes]", color=GREY, size=9.5, family=TYPEFACE)
    for number, row in enumerate(rows):
        level = under - ROW * (2 * number + 0.5)
        _draw_dots(axes, level, row, counts[0], OURS)
        if row.weight in theirs:
            _draw_dots(axes, level - ROW, theirs[row.weight], counts[1], GREY)
    axes.set_xlim(0.0, float(axes.get_xlim()[1]))
    _draw_key(page, start, under)


def _draw_dots(axes: Axes, level: float, row: TableRow, count: int, colour: Colour) -> None:
    """Both averages on one level: h(x) only hollow, h(x) + l(x) full."""
    for mean, std, face, aside in (
        (row.h_mean, row.h_std, PAPER, 0.045),
        (row.hl_mean, row.hl_std, colour, -0.045),
    ):
        axes.errorbar(
            [mean],
            [level + aside],
            xerr=Z95 * std / math.sqrt(count),
            color=colour,
            marker="o",
            markersize=6.5,
            markerfacecolor=face,
            markeredgewidth=1.4,
            elinewidth=1.3,
            zorder=4,
        )


def _draw_key(page: Sheet, start: float, under: float) -> None:
    """What hollow and full dots mean, above the dots."""
    width, level = WIDTH - MARGIN - start, under + ROW * 0.6
    axes, _ = page.picture(
        (start, under, width, 2 * ROW), (start, start + width, under, under + 2 * ROW)
    )
    for across, name, face in ((0.1, "h(x) only", PAPER), (1.45, "h(x) + l(x)", INK)):
        axes.plot(
            [start + across],
            [level],
            color=INK,
            marker="o",
            markersize=6.5,
            markerfacecolor=face,
            markeredgewidth=1.4,
        )
        write(axes, (start + across + 0.15, level), name, replace(SMALL, size=9.5))
