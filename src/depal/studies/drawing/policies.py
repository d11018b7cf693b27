"""Several policies on several kinds of pallets: bars, with a stroke where the minimum is."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from matplotlib.figure import Figure

from depal.studies.drawing.lettering import BODY, SMALL, TYPEFACE, write
from depal.studies.drawing.palette import GREY, HAIR, INK, LINE, OURS, PAPER, blend
from depal.studies.drawing.sheet import joined, sheet

ROW = 0.62
"""The height of a kind of pallets [in]."""

NAMES = 3.0
"""The width of their names [in]."""

HEAD, FOOT = 0.35, 0.55
"""Above and below the rows [in]."""

SHARE = 0.8
"""Of a row's height that its bars take."""


@dataclass(frozen=True, slots=True)
class Measured:
    """One policy on one kind of pallets.

    Attributes:
        kind: of pallets.
        policy: its name.
        value: the mean.
        limit: the mean of the least that there is; None where nobody knows it.
    """

    kind: str
    policy: str
    value: float
    limit: float | None


def policies_figure(
    bars: Sequence[Measured], title: str, subtitle: str, source: str, unit: str
) -> Figure:
    """The means of all policies, kind by kind.

    Args:
        bars: at least one.
        title: the finding.
        subtitle: what is drawn.
        source: where it comes from, for the caption.
        unit: of the axis.
    """
    kinds = list(dict.fromkeys(bar.kind for bar in bars))
    names = list(dict.fromkeys(bar.policy for bar in bars))
    rows = ROW * len(kinds)
    page = sheet(HEAD + rows + FOOT, title, subtitle, joined(source))
    left, _, width, _ = page.whole
    axes = page.chart((left + NAMES, FOOT, width - NAMES, rows))
    axes.grid(visible=False)
    axes.grid(visible=True, axis="x", color=HAIR, linewidth=0.8)
    axes.set_ylim(len(kinds) - 0.5, -0.5)
    axes.set_yticks([])
    axes.set_xlim(0.0, 1.12 * max([0.1, *(bar.value for bar in bars)]))
    axes.spines["left"].set_visible(True)
    axes.spines["left"].set_color(LINE)
    axes.set_xlabel(unit, color=GREY, size=9.5, family=TYPEFACE)
    # From grey, the paper's, to our colour, the last one's.
    colours = [blend(LINE, OURS, k / max(len(names) - 1, 1)) for k in range(len(names))]
    height = SHARE / len(names)
    for bar in bars:
        number = names.index(bar.policy)
        level = kinds.index(bar.kind) + height * (number - (len(names) - 1) / 2)
        shade = blend(colours[number], PAPER, 0.2)
        axes.barh(level, bar.value, 0.9 * height, color=shade, zorder=3)
        if bar.limit is not None:
            reach = [level - height / 2, level + height / 2]
            axes.plot([bar.limit] * 2, reach, color=INK, zorder=5)
        at = max(bar.value, bar.limit or 0.0) + 0.008 * axes.get_xlim()[1]
        write(axes, (at, level), f"{bar.value:.2f}", replace(BODY, size=8, halo=True))
    for number, kind in enumerate(kinds):
        at_name = page.point(left + NAMES - 0.15, FOOT + ROW * (len(kinds) - number - 0.5))
        write(page.figure, at_name, kind, replace(BODY, size=9.5, across="right"))
    for number, name in enumerate(names):
        at_key = page.point(left + NAMES + 1.3 * number, FOOT + rows + 0.18)
        style = replace(SMALL, colour=blend(colours[number], INK, 0.35), bold=True)
        write(page.figure, at_key, name, style)
    return page.figure
