"""Faults: the share of runs that ended as they should, fault by fault."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from matplotlib.figure import Figure

from depal.studies.drawing.lettering import SMALL, write
from depal.studies.drawing.palette import ASKED, GREY, OURS
from depal.studies.drawing.sheet import sheet

HEIGHT = 3.2
"""Of the picture [in]."""

WIDE = 0.26
"""Of one bar, where one fault is one."""

COLOURS = (OURS, ASKED, GREY)


def faults_figure(names: Sequence[str], shares: Mapping[str, Sequence[float]]) -> Figure:
    """Bars, fault by fault.

    Args:
        names: the faults' ids.
        shares: at most three rows of shares in [0, 1], by what they mean; one number a fault.
    """
    worst = min((min(row, default=1.0) for row in list(shares.values())[:2]), default=1.0)
    page = sheet(
        HEIGHT,
        f"Of every fault at least {100 * worst:.0f} % of runs end as the catalogue says",
        ", ".join(shares),
        "Three boxes in the simulated cell, one fault in each run",
    )
    left, bottom, width, height = page.whole
    axes = page.chart((left + 0.45, bottom + 0.35, width - 0.5, height - 0.7))
    at = np.arange(len(names))
    for row, ((_, values), colour) in enumerate(zip(shares.items(), COLOURS, strict=False)):
        axes.bar(at + (row - 1) * WIDE, values, WIDE * 0.9, color=colour)
    axes.set_xticks(at, names)
    axes.set_ylim(0.0, 1.0)
    for row, (what, colour) in enumerate(zip(shares, COLOURS, strict=False)):
        place = page.point(left + 0.45 + 2.2 * row, height - 0.15)
        write(page.figure, place, what, replace(SMALL, colour=colour))
    return page.figure
