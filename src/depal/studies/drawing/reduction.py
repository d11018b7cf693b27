"""Fig. 8: how many actions a request saves, over the weight w."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from depal.studies.drawing.lettering import BODY, SMALL, TYPEFACE, write
from depal.studies.drawing.palette import GREY, HAIR, LINE, OURS, PAPER, Colour, blend
from depal.studies.drawing.sheet import joined, sheet

PLATEAU = 0.5
"""The weight from which on the paper calls the reduction stable."""

ASIDE = 0.045
"""From a last point to its name, in weights."""

NAMES = 0.16
"""Right of the last weight, for the names of the series."""


@dataclass(frozen=True, slots=True)
class Reduction:
    """What was measured at one weight.

    Attributes:
        weight: w, in [0, 1].
        mean: how many actions fewer it takes until the requested box is stored.
        low: the lower end of the 95 % interval of the mean.
        high: the upper end of it.
    """

    weight: float
    mean: float
    low: float
    high: float


def reduction_over_weight(
    ours: Sequence[Reduction], paper: Sequence[tuple[float, float]], note: str = ""
) -> Figure:
    """The average action reduction over w, ours and the paper's; Fig. 8.

    Args:
        ours: at least one weight.
        paper: the paper's weights and reductions; may be empty.
        note: the parameters of the run, for the caption.
    """
    points = sorted(ours, key=lambda point: point.weight)
    page = sheet(
        4.3,
        _finding(points),
        "How many boxes fewer are stored before the requested one than with h(x) alone, on "
        "average; band: 95 % interval.",
        joined("After Fig. 8 and Table I, section III-B", note),
    )
    left, bottom, width, height = page.whole
    axes = page.chart((left + 0.35, bottom + 0.55, width - 0.35, height - 0.85))
    theirs = sorted(paper)
    marked = [weight for weight, _ in theirs] or [point.weight for point in points]
    weights = marked + [point.weight for point in points]
    values = [value for _, value in theirs] + [end for p in points for end in (p.low, p.high)]
    axes.set_xlim(min(weights) - 0.06, max(weights) + NAMES)
    axes.set_ylim(min(0.0, *values), max(0.1, *values) * 1.18)
    axes.set_xticks(marked, [f"{weight:g}" for weight in marked])
    axes.set_xlabel(
        "weight w of the request in s = w l + (1 \N{MINUS SIGN} w) h",
        color=GREY,
        size=9.5,
        family=TYPEFACE,
    )
    above = page.point(left, height - 0.12)
    write(page.figure, above, "actions saved [boxes]", replace(SMALL, size=9.5))
    _draw_plateau(axes, points)
    _draw_paper(axes, theirs)
    _draw_ours(axes, [point for point in points if point.weight in marked], points)
    _write_values(axes, points, theirs, marked)
    _name(axes, points[-1], theirs)
    return page.figure


def _finding(points: Sequence[Reduction]) -> str:
    """The title: where the reduction begins and where it levels off."""
    first = next((point for point in points if point.weight > 0), points[0])
    plateau = _plateau(points)
    if first.weight >= PLATEAU or plateau is None:
        return f"A request saves {first.mean:.1f} actions at w = {first.weight:g}"
    return (
        f"A request saves {first.mean:.1f} actions at w = {first.weight:g} "
        f"and {plateau:.1f} from w = {PLATEAU:g} on"
    )


def _plateau(points: Sequence[Reduction]) -> float | None:
    """The mean reduction over the weights of the plateau, where there are any."""
    means = [point.mean for point in points if point.weight >= PLATEAU]
    return sum(means) / len(means) if means else None


def _draw_plateau(axes: Axes, points: Sequence[Reduction]) -> None:
    """A pale ground under the weights from which on nothing much changes."""
    level = _plateau(points)
    if level is None:
        return
    end = max(point.weight for point in points) + 0.03
    axes.axvspan(PLATEAU - 0.03, end, color=blend(HAIR, PAPER, 0.45), zorder=0)
    axes.plot((PLATEAU - 0.03, end), (level, level), color=LINE, linewidth=1.0, zorder=1)
    at = (PLATEAU - 0.015, axes.get_ylim()[1] * 0.05)
    words = f"w \N{GREATER-THAN OR EQUAL TO} {PLATEAU:g}: {level:.2f} on average"
    write(axes, at, words, replace(SMALL, size=9.5))


def _draw_paper(axes: Axes, theirs: Sequence[tuple[float, float]]) -> None:
    """The paper's points, hollow, with their values beneath."""
    axes.plot(
        [weight for weight, _ in theirs],
        [value for _, value in theirs],
        color=GREY,
        linewidth=1.2,
        linestyle=(0, (4, 3)),
        marker="D",
        markersize=10,
        markerfacecolor="none",
        markeredgewidth=1.4,
        zorder=6,
    )


def _draw_ours(axes: Axes, dots: Sequence[Reduction], points: Sequence[Reduction]) -> None:
    """Our line with its intervals, and dots at some of its points."""
    weights, means = [p.weight for p in points], [p.mean for p in points]
    axes.fill_between(
        weights, [p.low for p in points], [p.high for p in points], color=OURS, alpha=0.16, lw=0
    )
    axes.plot(weights, means, color=OURS, linewidth=2.2, zorder=5)
    axes.plot(
        [point.weight for point in dots],
        [point.mean for point in dots],
        color=OURS,
        linestyle="none",
        marker="o",
        markersize=6.5,
        zorder=5,
    )


def _write_values(
    axes: Axes,
    points: Sequence[Reduction],
    theirs: Sequence[tuple[float, float]],
    marked: Sequence[float],
) -> None:
    """The values beside the points, the greater of two above; the last ones have names."""
    printed = dict(theirs)
    for point in points[:-1]:
        if point.weight in marked:
            side = 1 if point.mean >= printed.get(point.weight, -math.inf) else -1
            _write_value(axes, (point.weight, point.mean), side, OURS)
    measured = {point.weight: point.mean for point in points}
    for weight, value in theirs[:-1]:
        side = 1 if value > measured.get(weight, math.inf) or weight not in measured else -1
        _write_value(axes, (weight, value), side, GREY)


def _write_value(axes: Axes, at: tuple[float, float], side: int, colour: Colour) -> None:
    """A value beside a point of a rising line: to the left and up (1) or right and down (-1)."""
    (first, last), (low, high) = axes.get_xlim(), axes.get_ylim()
    spot = at[0] - side * 0.011 * (last - first), at[1] + side * 0.05 * (high - low)
    style = replace(BODY, colour=colour, bold=colour == OURS, halo=True)
    style = replace(style, across="right" if side > 0 else "left")
    write(axes, spot, f"{at[1]:.2f}", style)


def _name(axes: Axes, ours: Reduction, theirs: Sequence[tuple[float, float]]) -> None:
    """The names of the two series at their right ends with their last values, kept apart."""
    low, high = axes.get_ylim()
    style = replace(BODY, size=10.5, colour=OURS, bold=True)
    at, level, other = ours.weight, ours.mean, 0.0
    if theirs:
        gap = ours.mean - theirs[-1][1]
        push = max(0.0, 0.085 * (high - low) - abs(gap)) / 2 * (1 if gap >= 0 else -1)
        at, level, other = max(at, theirs[-1][0]), ours.mean + push, theirs[-1][1] - push
        words = f"paper {theirs[-1][1]:.2f}"
        write(axes, (at + ASIDE, other), words, replace(style, colour=GREY, bold=False))
    write(axes, (at + ASIDE, level), f"depal {ours.mean:.2f}", style)
