"""Fig. 10: the scores of a frontal line of boxes before and after a request."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle

from depal.studies.drawing.front import RULER, Face, SeenBox, around, face_of, rulers
from depal.studies.drawing.lettering import BODY, typeset, write
from depal.studies.drawing.palette import (
    ASKED,
    CASE_EDGE,
    CASES,
    CHANGED,
    GREY,
    INK,
    PAPER,
    Colour,
    blend,
    darker,
)
from depal.studies.drawing.sequence import STRIP, draw_sequences
from depal.studies.drawing.sheet import MARGIN, WIDTH, Area, Sheet, joined, sheet

HEADING = 0.3
"""The height of a layout's name [in]."""

ABOVE = 0.12
"""Between the sequences and the boxes [in]."""

LARGEST = 1.15, 0.8
"""The shortest side of a box at the most, alone and with a panel beside it [in]."""

READABLE = 0.72
"""The shortest side of a box on which its words still fit [in]."""

BETWEEN = 0.35
"""Between two panels [in]."""

RIM = 0.06
"""Around a picture, for the width of its lines [in]."""

BEFORE: Colour = darker(GREY, 0.12)
"""The paper's grey, dark enough on a brown box."""


@dataclass(frozen=True, slots=True)
class ScoredLayout:
    """A frontal line of boxes and the orders in which they are stored.

    Attributes:
        boxes: as the robot sees them, with their scores; labels differ.
        requested: the index of the requested box.
        before: the indices in the storing order without the request.
        after: the indices in the storing order with it.
        name: of the layout, as in "5-5"; may be empty.
    """

    boxes: tuple[SeenBox, ...]
    requested: int
    before: tuple[int, ...]
    after: tuple[int, ...]
    name: str = ""

    @property
    def places(self) -> tuple[int, int]:
        """The requested box's place before and after, counted from 1."""
        return self.before.index(self.requested) + 1, self.after.index(self.requested) + 1


def scored_front(layouts: Sequence[ScoredLayout], note: str = "") -> Figure:
    """Boxes with their scores and places before and after a request; Fig. 10.

    Args:
        layouts: at least one; two stand beside each other where their words fit.
        note: the parameters of the run, for the caption.
    """
    rows = _rows(layouts)
    heights = [max(_height(layouts[index], len(row)) for index in row) for row in rows]
    page = sheet(
        sum(heights) + BETWEEN * (len(heights) - 1),
        _finding(layouts),
        "On each box its score before (grey) and after (black) the request and, in circles, its "
        "place in the sequence before and after. Red: what changes. Green: the requested box.",
        joined("After Fig. 10 and Eq. (3), section III-C", "scores in m of h", note),
    )
    top = page.height
    for row, height in zip(rows, heights, strict=True):
        width = _width(len(row))
        for column, index in enumerate(row):
            left = MARGIN + column * (width + BETWEEN)
            _draw_panel(page, (left, top - height, width, height), layouts[index], len(row))
        top -= height + BETWEEN
    return page.figure


def _rows(layouts: Sequence[ScoredLayout]) -> list[tuple[int, ...]]:
    """Two panels beside each other where they can be read, else one; by index, in order."""
    narrow = [i for i, layout in enumerate(layouts) if _side(layout, 2) >= READABLE]
    if len(narrow) % 2:
        narrow.pop(0)
    rows: list[tuple[int, ...]] = []
    for index in range(len(layouts)):
        if index not in narrow:
            rows.append((index,))
        elif narrow.index(index) % 2:
            rows.append((narrow[narrow.index(index) - 1], index))
    return rows


def _width(panels: int) -> float:
    """The width of a panel beside which there are others [in]."""
    return (WIDTH - 2 * MARGIN - BETWEEN * (panels - 1)) / panels


def _scale(layout: ScoredLayout, panels: int) -> float:
    """How large the boxes are drawn when so many panels stand beside each other [in/m]."""
    faces = [face_of(box) for box in layout.boxes]
    shortest = min(min(face.width, face.height) for face in faces)
    room = _width(panels) - 2 * _room(panels)
    return min(room / around(faces).width, LARGEST[panels - 1] / shortest)


def _side(layout: ScoredLayout, panels: int) -> float:
    """The shortest side of a box as it would be drawn [in]."""
    shortest = min(min(box.size[1:]) for box in layout.boxes)
    return shortest * _scale(layout, panels)


def _room(panels: int) -> float:
    """What is left free at the left and below, for rulers where there is one panel [in]."""
    return RULER if panels == 1 else RIM


def _height(layout: ScoredLayout, panels: int) -> float:
    """What a panel needs [in]."""
    load = around([face_of(box) for box in layout.boxes])
    picture = load.height * _scale(layout, panels) + _room(panels) + RIM
    return picture + ABOVE + STRIP + (HEADING if layout.name else 0.0)


def _finding(layouts: Sequence[ScoredLayout]) -> str:
    """The title: where the requested box goes."""
    labels = {typeset(layout.boxes[layout.requested].label) for layout in layouts}
    asked = labels.pop() if len(labels) == 1 else "the requested box"
    moves = {layout.places for layout in layouts}
    count = "both" if len(layouts) == 2 else f"all {len(layouts)}"  # noqa: PLR2004 - both is two
    lead = f"In {count} layouts the" if len(layouts) > 1 else "The"
    if len(moves) == 1:
        ((old, new),) = moves
        if old == new:
            return f"{lead} request leaves {asked} in place {old}"
        return f"{lead} request moves {asked} from place {old} to place {new}"
    steps = [old - new for old, new in moves]
    return f"{lead} request moves {asked} forward by {min(steps)} to {max(steps)}"


def _draw_panel(page: Sheet, area: Area, layout: ScoredLayout, panels: int) -> None:
    """One layout: its name, the two sequences, and the boxes on the ground of the panel."""
    left, bottom, width, height = area
    labels = [typeset(box.label) for box in layout.boxes]
    top = bottom + height
    if layout.name:
        at = page.point(left, top - 0.1)
        write(page.figure, at, f"layout {layout.name}", replace(BODY, size=11.0, bold=True))
        top -= HEADING
    draw_sequences(
        page,
        (left, top - STRIP, width, STRIP),
        [labels[index] for index in layout.before],
        [labels[index] for index in layout.after],
        labels[layout.requested],
    )
    faces = [face_of(box) for box in layout.boxes]
    load, scale = around(faces), _scale(layout, panels)
    high = top - STRIP - bottom
    middle = (load.left + load.right) / 2
    roof = load.top + (ABOVE + RIM) / scale
    window = (middle - width / scale / 2, middle + width / scale / 2, roof - high / scale, roof)
    axes, _ = page.picture((left, bottom, width, high), window)
    if panels == 1:
        rulers(axes, load, scale)
    fit = _Fit(1.0 / scale, min(_side(layout, panels), LARGEST[0]))
    for index, face in enumerate(faces):
        _draw_box(axes, face, layout, index, fit)


@dataclass(frozen=True, slots=True)
class _Fit:
    """How large the words on the boxes are.

    Attributes:
        inch: one inch of the sheet [m].
        side: the shortest side of any box [in].
    """

    inch: float
    side: float

    def size(self, of_side: float, least: float) -> float:
        """A size of letters [pt], from a share of the shortest side."""
        return max(of_side * self.side, least)


def _draw_box(axes: Axes, face: Face, layout: ScoredLayout, index: int, fit: _Fit) -> None:
    """A box: label, score before and after, place before and after."""
    box, marked = layout.boxes[index], index == layout.requested
    inset = 0.03 * fit.inch if marked else 0.0
    axes.add_patch(
        Rectangle(
            (face.left + inset, face.bottom + inset),
            face.width - 2 * inset,
            face.height - 2 * inset,
            facecolor=blend(CASES[0], PAPER, 0.45),
            edgecolor=ASKED if marked else CASE_EDGE,
            linewidth=3.0 if marked else 0.9,
            joinstyle="round",
            zorder=3 if marked else 2,
        )
    )
    x, y = face.middle
    line = 0.215 * fit.side * fit.inch
    style = replace(BODY, across="center", size=fit.size(12.5, 9.5))
    write(axes, (x, y + 1.25 * line), typeset(box.label), style)
    lines = ((box.before, BEFORE, 0.05), (box.after, INK, -1.1))
    for score, colour, up in lines:
        if score is not None:
            style = replace(style, size=fit.size(10.0, 8.5), colour=colour)
            style = replace(style, bold=colour is INK and box.before != score)
            write(axes, (x, y + up * line), f"{score:.3f}", style)
    old, new = layout.before.index(index) + 1, layout.after.index(index) + 1
    radius = max(0.115 * fit.side, 0.09) * fit.inch
    gap = radius + 0.065 * fit.inch
    level = face.top - gap
    filled = CHANGED if old != new else INK
    for across, place, ground, rim, ink in (
        (face.left + gap, old, PAPER, BEFORE, BEFORE),
        (face.right - gap, new, filled, filled, PAPER),
    ):
        circle = Circle((across, level), radius, facecolor=ground, edgecolor=rim, zorder=5)
        axes.add_patch(circle)
        style = replace(BODY, across="center", size=fit.size(8.5, 7.5), colour=ink)
        write(axes, (across, level), str(place), style)
