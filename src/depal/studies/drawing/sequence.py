"""Two storing sequences above each other, each box tied to itself, changes in red (Fig. 10)."""

from collections.abc import Sequence
from dataclasses import replace

from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.patches import Circle

from depal.studies.drawing.lettering import BODY, SMALL, write
from depal.studies.drawing.palette import ASKED, CHANGED, GREY, INK, LINE
from depal.studies.drawing.sheet import Area, Sheet

NAMES = 0.62
"""The room for "before" and "after" at the left [in]."""

WIDEST = 0.62
"""From one place to the next, at the most [in]."""

STRIP = 1.0
"""The height of both sequences with the numbers of the places [in]."""

MARK = 0.135
"""The radius of the ring around the requested box [in]."""

LEVELS = 0.88, 0.63, 0.17
"""Where the numbers, the first and the second sequence stand above the strip's foot [in]."""


def draw_sequences(
    page: Sheet, area: Area, before: Sequence[str], after: Sequence[str], requested: str
) -> None:
    """Draws two orders of the same boxes.

    Args:
        page: the sheet.
        area: where, `STRIP` high; from its left side on.
        before: the labels as typeset, in the order without the request.
        after: the same in the order with it.
        requested: the label of the requested box.
    """
    _, _, width, height = area
    axes, _ = page.picture(area, (0.0, width, 0.0, height))
    step = min(WIDEST, (width - NAMES) / max(len(before), 1))
    across = [NAMES + (place + 0.5) * step for place in range(len(before))]
    numbers, upper, lower = LEVELS
    small = replace(SMALL, size=8.5)
    for level, name in ((numbers, "place"), (upper, "before"), (lower, "after")):
        write(axes, (0.0, level), name, small)
    ties, colours = [], []
    for place, (first, second) in enumerate(zip(before, after, strict=True)):
        write(axes, (across[place], numbers), str(place + 1), replace(small, across="center"))
        goal = after.index(first)
        ties.append(((across[place], upper - 0.15), (across[goal], lower + 0.15)))
        colours.append(LINE if goal == place else CHANGED)
        for level, label, calm in ((upper, first, GREY), (lower, second, INK)):
            colour = calm if first == second else CHANGED
            style = replace(BODY, size=10.5, across="center", colour=colour)
            write(axes, (across[place], level), label, style)
            if label == requested:
                _ring(axes, (across[place], level))
    axes.add_collection(LineCollection(ties, colors=colours, linewidths=1.1, zorder=2))


def _ring(axes: Axes, at: tuple[float, float]) -> None:
    """A green ring around the requested box."""
    axes.add_patch(Circle(at, MARK, facecolor="none", edgecolor=ASKED, linewidth=1.6, zorder=3))
