"""Words on a figure: one typeface, few sizes, nothing taken from the user's own settings."""

import re
from dataclasses import dataclass
from typing import Literal

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.transforms import ScaledTranslation

from depal.studies.drawing.palette import GREY, INK, PAPER, Colour

TYPEFACE = "DejaVu Sans"
"""Ships with matplotlib: the same letters on every machine."""

POINTS = 72
"""In an inch."""

HALF_DIGIT = 0.365
"""Half the height of a digit, as a share of the size of the letters."""

INDEXED = re.compile(r"([A-Za-z]+)_?(\d+)")


@dataclass(frozen=True, slots=True)
class Lettering:
    """How words are set.

    Attributes:
        size: of the letters [pt]; figures are 10 inches wide, so 9 pt are 12 pixels of 1,000.
        colour: of the letters.
        bold: whether they are bold.
        across: which part of the words stands at the given point.
        up: which height of the words stands at the given point; "line" is half the height of
            the digits, so that words beside each other and in circles are level.
        layer: what lies above has a greater number.
        halo: whether the letters have a white rim, for words on top of lines.
    """

    size: float = 10.0
    colour: Colour = INK
    bold: bool = False
    across: Literal["left", "center", "right"] = "left"
    up: Literal["line", "center", "top"] = "line"
    layer: float = 20.0
    halo: bool = False


BODY = Lettering()
SMALL = Lettering(size=9.0, colour=GREY)


def write(target: Axes | Figure, at: tuple[float, float], words: str, style: Lettering) -> None:
    """Sets words at a point.

    Args:
        target: axes, whose own coordinates `at` is in, or a figure, where it is in [0, 1].
        at: the point.
        words: plain, or with mathematics between dollar signs.
        style: how they are set.
    """
    transform = target.transFigure if isinstance(target, Figure) else target.transData
    if style.up == "line":
        figure = target if isinstance(target, Figure) else target.figure
        drop = -HALF_DIGIT * style.size / POINTS
        transform = transform + ScaledTranslation(0.0, drop, figure.dpi_scale_trans)
    text = target.text(
        *at,
        words,
        transform=transform,
        size=style.size,
        color=style.colour,
        weight="bold" if style.bold else "normal",
        ha=style.across,
        va="baseline" if style.up == "line" else style.up,
        zorder=style.layer,
        family=TYPEFACE,
        math_fontfamily="dejavusans",
    )
    if style.halo:
        text.set_path_effects([withStroke(linewidth=2.5, foreground=PAPER)])


def typeset(label: str) -> str:
    """A box's label as the paper sets it: "b4" and "b_4" with the number as an index."""
    match = INDEXED.fullmatch(label)
    return rf"${match[1]}_{{{match[2]}}}$" if match else label.replace("$", r"\$")
