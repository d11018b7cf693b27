"""The sheet that every figure is drawn on: what was found, the picture, where it comes from."""

import re
from dataclasses import dataclass, replace

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from depal.studies.drawing.lettering import BODY, SMALL, TYPEFACE, write
from depal.studies.drawing.palette import GREY, HAIR, LINE, PAPER

WIDTH = 10.0
"""Of every figure [in]."""

MARGIN = 0.4
"""Left and right of everything [in]."""

TITLE_LETTERS = 76
SUBTITLE_LETTERS = 122
CAPTION_LETTERS = 128
"""How much fits on one line of each."""

TITLE_LINE, SUBTITLE_LINE, CAPTION_LINE = 0.29, 0.21, 0.19
"""From one line to the next [in]."""

Area = tuple[float, float, float, float]
"""Left, bottom, width and height [in], from the lower left corner of the sheet's body."""

Window = tuple[float, float, float, float]
"""What a picture shows: left, right, bottom and top in its own coordinates [m]."""


@dataclass(frozen=True, slots=True)
class Sheet:
    """A figure with its words, and the body that is left for the picture.

    Attributes:
        figure: the figure itself.
        bottom: where the body begins above the figure's lower edge [in].
        height: of the body [in].
    """

    figure: Figure
    bottom: float
    height: float

    @property
    def whole(self) -> Area:
        """The whole body between the margins."""
        return MARGIN, 0.0, WIDTH - 2 * MARGIN, self.height

    def picture(self, area: Area, window: Window) -> tuple[Axes, float]:
        """Bare axes to scale, the window as large as it goes in the middle of the area.

        Returns:
            The axes and their scale [in/m].
        """
        left, right, bottom, top = window
        scale = min(area[2] / (right - left), area[3] / (top - bottom))
        half_width, half_height = area[2] / scale / 2, area[3] / scale / 2
        middle, level = (left + right) / 2, (bottom + top) / 2
        axes = self._axes(area)
        axes.set_axis_off()
        axes.set_xlim(middle - half_width, middle + half_width)
        axes.set_ylim(level - half_height, level + half_height)
        return axes, scale

    def chart(self, area: Area) -> Axes:
        """Axes with a quiet frame: a base line, pale horizontal lines, grey numbers."""
        axes = self._axes(area)
        for side in ("left", "right", "top"):
            axes.spines[side].set_visible(False)
        axes.spines["bottom"].set_color(LINE)
        axes.tick_params(colors=LINE, labelcolor=GREY, labelsize=9.5, labelfontfamily=TYPEFACE)
        axes.tick_params(axis="y", length=0)
        axes.grid(visible=True, axis="y", color=HAIR, linewidth=0.8)
        axes.set_axisbelow(True)
        return axes

    def point(self, left: float, bottom: float) -> tuple[float, float]:
        """A point of the body [in] in the figure's own coordinates."""
        return left / WIDTH, (self.bottom + bottom) / float(self.figure.get_figheight())

    def _axes(self, area: Area) -> Axes:
        """Axes over an area of the body."""
        height = float(self.figure.get_figheight())
        left, bottom = self.point(area[0], area[1])
        return self.figure.add_axes((left, bottom, area[2] / WIDTH, area[3] / height))


def sheet(height: float, title: str, subtitle: str, caption: str) -> Sheet:
    """A sheet with its words set.

    Args:
        height: what the body needs [in]; the words come on top of it.
        title: what was found, as a sentence.
        subtitle: how to read the picture.
        caption: the source, and the parameters of the run.
    """
    titles = _lines(title, TITLE_LETTERS)
    subtitles = _lines(subtitle, SUBTITLE_LETTERS)
    captions = _lines(caption, CAPTION_LETTERS)
    header = 0.3 + len(titles) * TITLE_LINE + len(subtitles) * SUBTITLE_LINE + 0.2
    footer = 0.28 + len(captions) * CAPTION_LINE
    total = header + height + footer
    figure = Figure(figsize=(WIDTH, total), facecolor=PAPER)
    FigureCanvasAgg(figure)
    level = total - 0.24
    for style, step, lines in (
        (replace(BODY, size=14.0, bold=True, up="top"), TITLE_LINE, titles),
        (replace(BODY, colour=GREY, up="top"), SUBTITLE_LINE, subtitles),
    ):
        for line in lines:
            write(figure, (MARGIN / WIDTH, level / total), line, style)
            level -= step
        level -= 0.03
    for number, line in enumerate(captions):
        at = MARGIN / WIDTH, (footer - 0.14 - number * CAPTION_LINE) / total
        write(figure, at, line, replace(SMALL, size=8.5, up="top"))
    return Sheet(figure, footer, height)


def _lines(words: str, letters: int) -> list[str]:
    """Words in lines of at most so many letters; the signs of mathematics take no room."""
    lines: list[str] = []
    for word in words.split():
        longer = f"{lines[-1]} {word}" if lines else word
        if lines and len(re.sub(r"[${}_\\]", "", longer)) <= letters:
            lines[-1] = longer
        else:
            lines.append(word)
    return lines


def joined(*parts: str) -> str:
    """A caption from its parts; the empty ones are left out."""
    return " · ".join(part for part in parts if part)
