"""Learned weights with their intervals, beside the paper's."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from matplotlib.figure import Figure

from depal.studies.drawing.lettering import BODY, SMALL, write
from depal.studies.drawing.palette import GREY, HAIR, OURS
from depal.studies.drawing.sheet import joined, sheet

ROW = 0.5
"""The height of a weight's line [in]."""

NAMES, NUMBERS = 2.3, 2.2
"""Left and right of the lines [in]."""


@dataclass(frozen=True, slots=True)
class DrawnWeight:
    """One line of the picture.

    Attributes:
        name: of the weight.
        value: the most likely one; None where it is unknown.
        low: the lower end of its 95 % interval.
        high: the upper end.
        reference: another policy's weight to stand beside it, or None.
    """

    name: str
    value: float | None
    low: float
    high: float
    reference: float | None = None


def weights_figure(
    weights: Sequence[DrawnWeight], title: str, reference: str = "", note: str = ""
) -> Figure:
    """Weights as points with their intervals.

    Args:
        weights: from the top to the bottom.
        title: what was found.
        reference: what the hollow points are; empty where there are none.
        note: the parameters, for the caption.
    """
    hollow = f"; hollow: {reference}" if reference else ""
    page = sheet(
        ROW * len(weights) + 0.5,
        title,
        f"Point: most likely; bar: 95 % interval{hollow}. A weight that is unknown has a grey bar.",
        joined("s = w l + (1 - w) h, Eqs. (1) to (3)", note),
    )
    left, bottom, width, height = page.whole
    axes = page.chart((left + NAMES, bottom + 0.4, width - NAMES - NUMBERS, height - 0.45))
    axes.set_xlim(-0.02, 1.02)
    axes.set_ylim(-0.6, len(weights) - 0.4)
    axes.set_yticks([])
    axes.grid(visible=False, axis="y")
    for tick in (0.0, 0.25, 0.5, 0.75, 1.0):
        axes.axvline(tick, color=HAIR, linewidth=0.8, zorder=0)
    for number, weight in enumerate(weights):
        level = len(weights) - 1 - number
        known = weight.value is not None
        colour = OURS if known else HAIR
        axes.plot((weight.low, weight.high), (level, level), color=colour, linewidth=4, alpha=0.5)
        if weight.value is not None:
            axes.plot((weight.value,), (level,), "o", color=OURS, markersize=7, zorder=5)
        if weight.reference is not None:
            axes.plot(
                (weight.reference,), (level,), "o", color=GREY, fillstyle="none",
                markersize=11, zorder=4,
            )  # fmt: skip
        write(axes, (-0.06, level), weight.name, replace(BODY, across="right"))
        said = "unknown" if weight.value is None else f"{weight.value:.3f}"
        write(axes, (1.05, level), f"{said}  [{weight.low:.3f}, {weight.high:.3f}]", SMALL)
    return page.figure
