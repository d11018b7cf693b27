"""Retrieval: boxes stored before the requested one, by both policies, with the proven minimum."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from depal.studies.drawing.lettering import BODY, SMALL, TYPEFACE, write
from depal.studies.drawing.palette import GREY, HAIR, INK, LINE, OURS, PAPER, Colour, blend
from depal.studies.drawing.sheet import joined, sheet

ROW = 0.42
"""The height of a kind of pallets [in]."""

NAMES = 3.3
"""The width of their names [in]."""

HEAD, FOOT = 0.35, 0.5
"""Above and below the rows [in]."""

BAR = 0.3
"""The height of a bar, as a share of its row."""

COLOURS: dict[str, Colour] = {"paper": LINE, "access": OURS}


@dataclass(frozen=True, slots=True)
class Bar:
    """One policy on one kind of pallets.

    Attributes:
        pallets: the generator's name, or "real".
        side_only: the share of boxes that only a side grasp can take.
        clearance: whether the tool's clearance and the arm's reach count.
        policy: "paper" or "access".
        actions: boxes stored before the requested one, in the mean.
        limit: the mean of the proven minimum.
    """

    pallets: str
    side_only: float
    clearance: bool
    policy: str
    actions: float
    limit: float

    @property
    def kind(self) -> str:
        """Of pallets, for the eye."""
        words = f"{self.pallets}, {self.side_only:.0%} side-only" if self.side_only else ""
        words = words or self.pallets
        return f"{words}, in the cell" if self.clearance else words


def retrieval_figure(bars: Sequence[Bar], note: str = "") -> Figure:
    """The actions of both policies as bars, a stroke where the proven minimum is.

    Args:
        bars: at least one; those of one kind follow one another.
        note: the parameters of the run, for the caption.
    """
    kinds = list(dict.fromkeys(bar.kind for bar in bars))
    rows = ROW * len(kinds)
    page = sheet(
        HEAD + rows + FOOT,
        _finding(bars),
        "Boxes stored before the requested one, in the mean; stroke: the proven minimum under the "
        "policy's own rule.",
        joined("Beyond section II-C: blocking by grasp direction", note),
    )
    left, _, width, _ = page.whole
    axes = page.chart((left + NAMES, FOOT, width - NAMES, rows))
    _lay_out(axes, len(kinds), 1.12 * max([0.1, *(bar.actions for bar in bars)]))
    for bar in bars:
        _draw(axes, bar, kinds.index(bar.kind))
    for number, kind in enumerate(kinds):
        level = FOOT + ROW * (len(kinds) - number - 0.5)
        style = replace(BODY, size=9.5, across="right")
        write(page.figure, page.point(left + NAMES - 0.15, level), kind, style)
    for number, (policy, colour) in enumerate(COLOURS.items()):
        at = page.point(left + NAMES + 1.1 * number, FOOT + rows + 0.18)
        style = replace(SMALL, colour=blend(colour, INK, 0.35), bold=True)
        write(page.figure, at, policy, style)
    return page.figure


def _finding(bars: Sequence[Bar]) -> str:
    """The title: the first kind, in both policies."""
    first = {bar.policy: bar for bar in bars if bar.kind == bars[0].kind}
    said = [f"{first[name].actions:.1f} by {name}" for name in COLOURS if name in first]
    return f"Boxes before a requested one ({bars[0].kind}): {', '.join(said)}"


def _lay_out(axes: Axes, rows: int, last: float) -> None:
    axes.grid(visible=False)
    axes.grid(visible=True, axis="x", color=HAIR, linewidth=0.8)
    axes.set_ylim(rows - 0.5, -0.5)
    axes.set_yticks([])
    axes.set_xlim(0.0, last)
    axes.spines["left"].set_visible(True)
    axes.spines["left"].set_color(LINE)
    axes.set_xlabel("boxes", color=GREY, size=9.5, family=TYPEFACE)


def _draw(axes: Axes, bar: Bar, row: int) -> None:
    level = row + (BAR / 1.8 if bar.policy == "access" else -BAR / 1.8)
    axes.barh(level, bar.actions, BAR, color=blend(COLOURS[bar.policy], PAPER, 0.25), zorder=3)
    axes.plot([bar.limit] * 2, [level - BAR / 2, level + BAR / 2], color=INK, zorder=5)
    at = max(bar.actions, bar.limit) + 0.008 * axes.get_xlim()[1]
    write(axes, (at, level), f"{bar.actions:.2f}", replace(BODY, size=8.5, halo=True))
