"""What every figure says, and that it can be read."""

import itertools

import pytest
from drawing_samples import (
    FIGURES,
    figure_of,
    words_of,
)
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import Bbox


def written(figure: Figure) -> list[tuple[str, Bbox]]:
    """Every text with the room that its letters take [pixel]."""
    canvas = figure.canvas
    assert isinstance(canvas, FigureCanvasAgg)
    canvas.draw()
    ticks = [
        (tick, sorted(axis.get_view_interval()))
        for axes in figure.axes
        for axis in (axes.xaxis, axes.yaxis)
        for tick in axis.get_major_ticks()
    ]
    outside = {
        label
        for tick, (low, high) in ticks
        for label in (tick.label1, tick.label2)
        if not low - 1e-9 <= tick.get_loc() <= high + 1e-9
    }
    bare = {
        text
        for axes in figure.axes
        if not axes.axison
        for axis in (axes.xaxis, axes.yaxis)
        for text in axis.findobj(Text)
    }
    found = []
    for text in figure.findobj(Text):
        if text.get_text().strip() and text.get_visible() and text not in outside | bare:
            room = text.get_window_extent(canvas.get_renderer())
            # The room of a line has space for accents and descenders; letters take less.
            tall = room.height * 0.25
            found.append(
                (
                    text.get_text(),
                    Bbox.from_extents(room.x0, room.y0 + tall, room.x1, room.y1 - tall),
                )
            )
    return found


@pytest.mark.parametrize("name", FIGURES)
def test_no_two_labels_overlap(name: str) -> None:
    """Every word can be read."""
    labels = written(figure_of(name))
    clashes = [
        (first, second)
        for (first, room), (second, other) in itertools.combinations(labels, 2)
        if room.x0 < other.x1 and other.x0 < room.x1 and room.y0 < other.y1 and other.y0 < room.y1
    ]
    assert clashes == []


@pytest.mark.parametrize("name", FIGURES)
def test_every_label_lies_on_the_sheet(name: str) -> None:
    """Nothing is cut off at the rim."""
    figure = figure_of(name)
    width, height = figure.bbox.width, figure.bbox.height
    for label, room in written(figure):
        assert 0 <= room.x0 < room.x1 <= width, label
        assert 0 <= room.y0 < room.y1 <= height, label


@pytest.mark.parametrize("name", FIGURES)
def test_every_letter_is_large_enough_at_a_thousand_pixels(name: str) -> None:
    """7.5 pt on a sheet of 10 inches are 10 pixels of 1,000."""
    figure = figure_of(name)
    assert figure.get_figwidth() == 10.0
    assert min(text.get_fontsize() for text in figure.findobj(Text) if text.get_text()) >= 7.5


@pytest.mark.parametrize(
    ("name", "said"),
    [
        (
            "field",
            {
                "First the top front at the sides, last the bottom back in the centre",
                "h(b) [m]",
                "y  1.6 m",
                "x  0.8 m",
                "z  1.0 m",
                "robot at the origin,\n1.4 m before the front",
                "After Fig. 4 and Eq. (1), section II-C · cells of 0.2 m",
            },
        ),
        (
            "graph",
            {
                "A request for $b_{4}$ raises the scores of the 5 boxes that block it",
                *(f"$b_{{{number}}}$" for number in range(1, 9)),
                "0.10",
                "0.80 → 1.05",
                (
                    "After Fig. 5 and Eq. (2), section II-C · "
                    "arrows that follow from others are left out · w = 0.5"
                ),
            },
        ),
        (
            "reduction",
            {
                "A request saves 1.5 actions at w = 0.1 and 5.1 from w = 0.5 on",
                "1.46",
                "1.60",
                "depal 5.44",
                "paper 5.50",
                "w ≥ 0.5: 5.13 on average",
                "actions saved [boxes]",
                "After Fig. 8 and Table I, section III-B · seed 0",
            },
        ),
        (
            "table",
            {
                "Knowing the request cuts 12.8 actions to 7.3 at w = 0.9",
                "w = 0.1",
                "avg",
                "std",
                "h(x) only",
                "h(x) + l(x)",
                "11.14",
                "11.29",
                "actions [boxes]",
                "After Table I, section III-B · depal: 10,000 pallets a cell · paper: 50 · seed 0",
            },
        ),
        (
            "piles",
            {
                "After 6 steps s(x) has stored the requested box, h(x) alone has not",
                "(a) random configuration",
                "(b) h(x) only",
                "(c) h(x) + l(x)",
                "16",
                "10",
                "boxes left",
                "pillar index",
                "actions",
                "After Fig. 9, section III-B · seed 3",
            },
        ),
        (
            "scores",
            {
                "In all 3 layouts the request moves $b_{1}$ from place 10 to place 8",
                "layout 5-5",
                "layout 7-3",
                "before",
                "after",
                "$b_{10}$",
                "0.120",
                "0.140",
                "After Fig. 10 and Eq. (3), section III-C · scores in m of h · w = 0.2",
            },
        ),
        (
            "throughput",
            {
                "10 deliveries: 420 boxes/h in the median, arm motion 88 % of the time",
                "line: target of the median, 400",
                r"a_long_name\$…",
                "dev-001",
                "389",
                "boxes/h",
                "s a box",
                "reader 0 %",
                "planning 0.4 %",
                "Physics, motion planning and suction in the simulated cell · seed 0",
            },
        ),
    ],
)
def test_a_figure_says_what_was_found_and_where_it_comes_from(name: str, said: set[str]) -> None:
    """Title, labels, units and caption."""
    assert said <= set(words_of(figure_of(name)))
