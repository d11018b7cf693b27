"""Throughput: boxes per hour of each delivery, and where the time of a box goes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from statistics import median

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from depal.studies.drawing.lettering import BODY, SMALL, TYPEFACE, write
from depal.studies.drawing.palette import (
    CASE_EDGE,
    CASES,
    CHANGED,
    GREY,
    HAIR,
    INK,
    LINE,
    OURS,
    PAPER,
    Colour,
    blend,
)
from depal.studies.drawing.sheet import Sheet, joined, sheet

ROW, DENSE_ROW = 0.3, 0.21
"""The height of a delivery's row [in]: of few, of many."""

MANY = 24
"""From so many deliveries on the rows are dense."""

HEAD, FOOT = 0.95, 0.5
"""Above and below the rows [in]."""

NAMES, RATES, GAP = 1.9, 2.75, 0.4
"""The widths of the names, of the rates, and from there to the times [in]."""

PARTS: tuple[Colour, ...] = (
    OURS,
    blend(OURS, PAPER, 0.55),
    CASE_EDGE,
    CASES[3],
    GREY,
    blend(CHANGED, PAPER, 0.35),
    HAIR,
)
"""The colours of what the cell does, in order; the rest, last, is pale."""

LETTERS = 13
"""Of a delivery's name."""

KEY_ROWS, KEY_WIDTH, KEY_LINE = 3, 1.6, 0.2
"""How many entries of the key stand below one another, and the room of one [in]."""

NARROW = 0.62
"""The bar of a delivery, as a share of its row."""


@dataclass(frozen=True, slots=True)
class Emptied:
    """One delivery, run once or several times.

    Attributes:
        name: of the delivery.
        boxes: how many it has.
        rates: of each run, stored boxes per hour without the waiting for people.
        seconds: for each box of the runs, by what the cell did [s].
        whole: whether nothing was lost, hit or booked wrongly.
    """

    name: str
    boxes: int
    rates: tuple[float, ...]
    seconds: Mapping[str, float]
    whole: bool = True


def throughput_figure(
    deliveries: Sequence[Emptied], shares: Mapping[str, float], target: float, note: str = ""
) -> Figure:
    """The rates of deliveries as bars, and the time of a box by what the cell did, stacked.

    Args:
        deliveries: at least one.
        shares: of the time of all runs together, in [0, 1], by what the cell did.
        target: of the median rate [boxes/h].
        note: the parameters of the run, for the caption.
    """
    row = DENSE_ROW if len(deliveries) >= MANY else ROW
    rates = [rate for emptied in deliveries for rate in emptied.rates]
    page = sheet(
        HEAD + row * len(deliveries) + FOOT,
        _finding(rates, len(deliveries), shares),
        "Stored boxes per hour without the waiting for people (left); "
        "simulated seconds a box by what the cell did (right).",
        joined("Physics, motion planning and suction in the simulated cell", note),
    )
    left, _, width, height = page.whole
    rows = row * len(deliveries)
    _draw_names(page, deliveries, row)
    start = left + NAMES
    _draw_rates(page.chart((start, FOOT, RATES, rows)), deliveries, target)
    write(
        page.figure,
        page.point(start, height - HEAD + 0.16),
        f"line: target of the median, {target:.0f}",
        SMALL,
    )
    start += RATES + GAP
    _draw_times(page.chart((start, FOOT, left + width - start, rows)), deliveries, list(shares))
    _draw_key(page, start, shares)
    return page.figure


def _finding(rates: Sequence[float], deliveries: int, shares: Mapping[str, float]) -> str:
    """The title: the rate, and what takes most of the time."""
    what = f"{deliveries} deliveries" if deliveries > 1 else "One delivery"
    most = max(shares, key=shares.__getitem__, default="")
    took = f", {most} {100 * shares[most]:.0f} % of the time" if most else ""
    return f"{what}: {median(rates):.0f} boxes/h in the median{took}"


def _draw_names(page: Sheet, deliveries: Sequence[Emptied], row: float) -> None:
    """The name and the boxes of each delivery, the first on top; red where something went wrong."""
    left, _, _, height = page.whole
    size = 8.5 if row == DENSE_ROW else 9.5
    head = height - HEAD + 0.16
    style = replace(SMALL, size=9.5, across="right")
    write(page.figure, page.point(left + NAMES - 0.75, head), "delivery", style)
    write(page.figure, page.point(left + NAMES - 0.15, head), "boxes", style)
    for number, emptied in enumerate(deliveries):
        level = FOOT + row * (len(deliveries) - number - 0.5)
        colour = INK if emptied.whole else CHANGED
        style = replace(BODY, size=size, colour=colour, across="right")
        write(page.figure, page.point(left + NAMES - 0.75, level), _short(emptied.name), style)
        style = replace(style, colour=GREY)
        write(page.figure, page.point(left + NAMES - 0.15, level), str(emptied.boxes), style)


def _short(name: str) -> str:
    """A name that fits, whatever is in it."""
    short = name if len(name) <= LETTERS else f"{name[: LETTERS - 1]}\N{HORIZONTAL ELLIPSIS}"
    return short.replace("$", r"\$")


def _draw_rates(axes: Axes, deliveries: Sequence[Emptied], target: float) -> None:
    """The median rate of each delivery as a bar with its value, its runs as dots."""
    most = max([target, *(rate for emptied in deliveries for rate in emptied.rates)])
    _lay_out(axes, len(deliveries), 1.18 * most, "boxes/h")
    size = 8.0 if len(deliveries) >= MANY else 9.0
    for number, emptied in enumerate(deliveries):
        middle = median(emptied.rates)
        colour = blend(OURS if emptied.whole else CHANGED, PAPER, 0.35)
        axes.barh(number, middle, NARROW, color=colour, zorder=3)
        if len(emptied.rates) > 1:
            axes.plot(emptied.rates, [number] * len(emptied.rates), "|", color=INK, zorder=5)
        end = max(emptied.rates) + 0.02 * most
        write(axes, (end, number), f"{middle:.0f}", replace(BODY, size=size, halo=True))
    axes.axvline(target, color=INK, linewidth=1.0, linestyle=(0, (4, 3)), zorder=4)


def _draw_times(axes: Axes, deliveries: Sequence[Emptied], names: Sequence[str]) -> None:
    """The time of a box of each delivery, stacked."""
    totals = [sum(emptied.seconds.values()) for emptied in deliveries]
    _lay_out(axes, len(deliveries), 1.04 * max([1.0, *totals]), "s a box")
    for number, emptied in enumerate(deliveries):
        begin = 0.0
        for part, name in enumerate(names):
            seconds = emptied.seconds.get(name, 0.0)
            axes.barh(number, seconds, NARROW, begin, color=_colour(part), zorder=3)
            begin += seconds


def _lay_out(axes: Axes, rows: int, last: float, unit: str) -> None:
    """Rows from top to bottom, numbers below."""
    axes.grid(visible=False)
    axes.grid(visible=True, axis="x", color=HAIR, linewidth=0.8)
    axes.set_ylim(rows - 0.5, -0.5)
    axes.set_yticks([])
    axes.set_xlim(0.0, last)
    axes.spines["left"].set_visible(True)
    axes.spines["left"].set_color(LINE)
    axes.set_xlabel(unit, color=GREY, size=9.5, family=TYPEFACE)


def _draw_key(page: Sheet, start: float, shares: Mapping[str, float]) -> None:
    """What the colours mean, with the shares of all runs together."""
    _, _, _, height = page.whole
    side = 0.11
    for number, (name, share) in enumerate(shares.items()):
        column, line = divmod(number, KEY_ROWS)
        at, level = start + column * KEY_WIDTH, height - 0.14 - line * KEY_LINE
        corner, far = page.point(at, level - side / 2), page.point(at + side, level + side / 2)
        box = Rectangle(
            corner,
            far[0] - corner[0],
            far[1] - corner[1],
            transform=page.figure.transFigure,
            facecolor=_colour(number),
            edgecolor=LINE,
            linewidth=0.5,
        )
        page.figure.add_artist(box)
        words = f"{name} {_percent(share)}"
        write(page.figure, page.point(at + side + 0.06, level), words, replace(SMALL, size=8.5))


def _percent(share: float) -> str:
    """In whole per cent, or with a digit below one."""
    return f"{100 * share:.0f} %" if share == 0 or share >= 0.01 else f"{100 * share:.1f} %"  # noqa: PLR2004


def _colour(part: int) -> Colour:
    return PARTS[min(part, len(PARTS) - 1)]
