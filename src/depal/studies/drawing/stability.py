"""Stability: the margin along an unloading with and without the guard, and who agrees on what."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from depal.studies.drawing.lettering import BODY, SMALL, TYPEFACE, write
from depal.studies.drawing.palette import CHANGED, GREY, INK, LINE, OURS, Colour
from depal.studies.drawing.sheet import Area, Sheet, joined, sheet

HEIGHT = 3.6
"""Of the picture [in]."""

TABLE = 3.6
"""The width of the table of agreement [in]."""

LOWEST = -0.04
"""A pile that has fallen is drawn here [g]."""


@dataclass(frozen=True, slots=True)
class Along:
    """The margin along an unloading.

    Attributes:
        margins: in equal parts of the unloading, from its begin to its end [g]; below 0 where
            the pile has fallen.
        collapse: the share of unloadings in which a pile falls, in [0, 1].
    """

    margins: Sequence[float]
    collapse: float


@dataclass(frozen=True, slots=True)
class Agreed:
    """How many states the program calls stable or not, and how many fell.

    Attributes:
        stood: called stable, called unstable, of those that stood.
        fell: called stable, called unstable, of those that fell.
    """

    stood: tuple[int, int]
    fell: tuple[int, int]


def stability_figure(
    without: Along, guarded: Along, agreed: Agreed, threshold: float, note: str = ""
) -> Figure:
    """The two lines of margins, and the table of agreement.

    Args:
        without: Algorithm 1 alone.
        guarded: the same pallets and requests under the guard.
        agreed: the linear program against MuJoCo.
        threshold: of the guard [g].
        note: the parameters of the run, for the caption.
    """
    page = sheet(
        HEIGHT,
        f"{100 * without.collapse:.1f} % of unloadings collapse without a guard, "
        f"{100 * guarded.collapse:.1f} % with it",
        "The margin of all but the weakest tenth of piles (left); what the program says and what "
        "MuJoCo does (right).",
        joined("Loose pallets, paper's policy; margins by the contact-force program", note),
    )
    left, bottom, width, height = page.whole
    area = (left + 0.45, bottom + 0.5, width - TABLE - 0.75, height - 0.85)
    axes = page.chart(area)
    _draw_margins(axes, without, guarded, threshold)
    write(
        page.figure,
        page.point(left, height - 0.12),
        "margin [g]",
        replace(SMALL, size=9.5),
    )
    _draw_table(page, (left + width - TABLE, bottom, TABLE, height), agreed)
    return page.figure


def _draw_margins(axes: Axes, without: Along, guarded: Along, threshold: float) -> None:
    shares = _shares(len(without.margins))
    axes.axhline(threshold, color=INK, linewidth=1.0, linestyle=(0, (4, 3)), zorder=2)
    axes.axhline(0.0, color=LINE, linewidth=1.0, zorder=1)
    for along, colour, name, side in (
        (without, CHANGED, "without guard", -1),
        (guarded, OURS, "with guard", 1),
    ):
        drawn = [max(margin, LOWEST) for margin in along.margins]
        axes.plot(shares, drawn, color=colour, linewidth=2.2, marker="o", markersize=5, zorder=5)
        _name(axes, (shares[-1], drawn[-1]), name, colour, side)
    highest = max([threshold, *without.margins, *guarded.margins])
    axes.set_xlim(0.0, 100.0)
    axes.set_ylim(LOWEST - 0.012, 1.25 * highest)
    words = f"threshold {threshold:g} g"
    write(axes, (1.5, threshold - 0.035 * (1.25 * highest - LOWEST)), words, SMALL)
    axes.set_xlabel("boxes stored [%]", color=GREY, size=9.5, family=TYPEFACE)


def _shares(parts: int) -> list[float]:
    """The middles of equal parts [%]."""
    return [float(share) for share in 100 * (np.arange(parts) + 0.5) / parts]


def _name(axes: Axes, at: tuple[float, float], name: str, colour: Colour, side: int) -> None:
    """The name of a line above or below its end."""
    style = replace(BODY, colour=colour, bold=True, across="right", halo=True)
    low, high = axes.get_ylim()
    write(axes, (98.5, at[1] + side * 0.09 * (high - low)), name, style)


def _draw_table(page: Sheet, area: Area, agreed: Agreed) -> None:
    """Two by two counts, the disagreements in red."""
    left, bottom, width, height = area
    columns = [left + 0.42 * width, left + 0.7 * width, left + 0.98 * width]
    rows = [bottom + height - 0.55 - 0.42 * row for row in range(4)]
    head = replace(SMALL, size=9.5, across="right")
    number = replace(BODY, size=12.0, across="right")
    for column, words in zip(columns[1:], ("stood", "fell"), strict=True):
        write(page.figure, page.point(column, rows[0]), words, head)
    for row, (words, counts) in enumerate(
        (
            ("called stable", (agreed.stood[0], agreed.fell[0])),
            ("called unstable", (agreed.stood[1], agreed.fell[1])),
        )
    ):
        write(page.figure, page.point(columns[0], rows[row + 1]), words, head)
        for place, count in enumerate(counts):
            wrong = place != row
            style = replace(number, colour=CHANGED if wrong and count else INK, bold=not wrong)
            write(page.figure, page.point(columns[place + 1], rows[row + 1]), f"{count}", style)
    right, states = agreed.stood[0] + agreed.fell[1], sum(agreed.stood) + sum(agreed.fell)
    share = f"{100 * right / states:.1f} %" if states else "none"
    words = f"agree: {share} of {states} states"
    write(page.figure, page.point(columns[2], rows[3]), words, replace(head, colour=INK))
