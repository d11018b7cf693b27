"""What figures say of other numbers: single boxes, empty pallets, one weight, no paper."""

from dataclasses import replace

import numpy as np
import pytest
from drawing_samples import (
    GRAPH_BLOCKERS,
    GRAPH_EDGES,
    OUR_TABLE,
    PAPER_REDUCTIONS,
    cut_volume,
    graph_boxes,
    scored_layout,
    words_of,
)
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrowPatch
from matplotlib.text import Text

import depal.studies.drawing
from depal.studies.drawing import (
    PileState,
    Reduction,
    ScoredLayout,
    SeenBox,
    Stack,
    blocking_graph,
    grid_centres,
    priority_field,
    reduction_over_weight,
    scored_front,
    table_figure,
    three_piles,
)
from depal.studies.drawing.palette import ASKED, CASE_FAR, CASES, CHANGED, IN_THE_WAY, URGENCY
from depal.studies.drawing.sheet import sheet


def title_of(figure: Figure) -> str:
    """The first line of the sheet."""
    return figure.texts[0].get_text()


def test_the_public_names_are_these() -> None:
    """What other packages may rely on."""
    assert depal.studies.drawing.__all__ == [
        "Agreed",
        "Along",
        "Emptied",
        "PileState",
        "Reduction",
        "ScoredLayout",
        "SeenBox",
        "Stack",
        "TableRow",
        "blocking_graph",
        "grid_centres",
        "priority_field",
        "reduction_over_weight",
        "save_figure",
        "scored_front",
        "stability_figure",
        "table_figure",
        "three_piles",
        "throughput_figure",
    ]


def test_long_titles_run_over_two_lines_and_indices_take_no_room() -> None:
    """A line is as long as it looks."""
    lines = sheet(1.0, "$b_{10}$ " * 30, "", "").figure.texts
    assert [len(line.get_text().split()) for line in lines] == [19, 11]


def test_a_grid_fills_its_volume() -> None:
    """Half a cell from every side, x slowest."""
    centres = grid_centres((0, 0, 0), (1, 2, 3), (1, 2, 3))
    assert centres.tolist() == [[0.5, y, z] for y in (0.5, 1.5) for z in (0.5, 1.5, 2.5)]


def test_red_is_the_greatest_value_and_blue_the_least() -> None:
    """Only cells that can be seen are painted; the extremes carry the ends of the scale."""
    centres = grid_centres((1, -1, 0), (2, 1, 1), (3, 4, 3))
    figure = priority_field(centres, centres[:, 2], (1 / 3, 0.5, 1 / 3))
    painted = next(c for c in figure.axes[0].collections if isinstance(c, PathCollection))
    colours = {tuple(np.round(colour[:3], 4)) for colour in painted.get_facecolor()}
    for end in (0.0, 1.0):
        assert tuple(np.round(URGENCY(end)[:3], 4)) in colours


def test_a_field_without_slope_is_drawn_too() -> None:
    """All cells alike: one colour, and no division by nothing."""
    centres = grid_centres((1, -1, 0), (2, 1, 1), (2, 2, 2))
    assert "h(b) [m]" in words_of(priority_field(centres, np.ones(8), (0.5, 1.0, 0.5)))


@pytest.mark.parametrize(
    ("boxes", "blockers", "title"),
    [
        (1, (), "Nothing blocks the requested $b_{1}$"),
        (2, (0, 1), "A request for $b_{1}$ raises the score of the one box that blocks it"),
    ],
)
def test_the_graphs_title_counts_the_blockers(
    boxes: int, blockers: tuple[int, ...], title: str
) -> None:
    """The requested box is none of them, whether it is listed or not."""
    figure = blocking_graph(graph_boxes()[:boxes], [], 0, blockers)
    assert title_of(figure) == title


def test_arrows_and_vertices_of_the_subgraph_are_green() -> None:
    """And no others."""
    figure = blocking_graph(graph_boxes(), GRAPH_EDGES, 3, GRAPH_BLOCKERS)
    axes = figure.axes[0]
    arrows = [patch for patch in axes.patches if isinstance(patch, FancyArrowPatch)]
    green = [arrow for arrow in arrows if to_rgb(arrow.get_edgecolor()) == ASKED]
    faces = [to_rgb(p.get_facecolor()) for p in axes.patches if isinstance(p, Circle)]
    assert (len(arrows), len(green)) == (8, 6)
    assert [faces.count(colour) for colour in (ASKED, IN_THE_WAY)] == [1, 5]


def test_arrows_that_follow_from_others_are_left_out_and_it_is_said() -> None:
    """b1 under b2 under b3: the arrow from b1 to b3 adds nothing."""
    boxes = [SeenBox(f"b{n}", (1.5, 0.0, 0.2 * n), (0.3, 0.4, 0.2)) for n in (1, 2, 3)]
    full = blocking_graph(boxes, [(0, 1), (1, 2), (0, 2)], 0, [1, 2])
    lean = blocking_graph(boxes, [(0, 1), (1, 2)], 0, [1, 2])
    assert any("left out" in word for word in words_of(full))
    assert not any("left out" in word for word in words_of(lean))


def test_boxes_behind_others_are_lighter() -> None:
    """The row of depth shows in the brown."""
    axes = blocking_graph(graph_boxes(), [], 3, []).axes[0]
    colours = {to_rgb(patch.get_facecolor()) for patch in axes.patches}
    assert {CASES[0], CASE_FAR} <= colours


def test_a_reduction_at_one_weight_has_no_plateau_to_speak_of() -> None:
    """The title says the one number."""
    only = [Reduction(0.3, 3.8, 3.7, 3.9)]
    assert title_of(reduction_over_weight(only, [])) == "A request saves 3.8 actions at w = 0.3"


def test_a_sweep_of_weights_is_labelled_where_the_paper_has_points() -> None:
    """Elsewhere the line speaks."""
    points = [Reduction(w / 20, 5.0 + w, 4.9 + w, 5.1 + w) for w in range(21)]
    words = words_of(reduction_over_weight(points, PAPER_REDUCTIONS))
    assert {"7.00", "23.00", "depal 25.00", "paper 5.50"} <= set(words)
    assert "8.00" not in words


def test_without_the_papers_points_only_ours_are_drawn() -> None:
    """And named at the right end."""
    points = [Reduction(w, 10 * w, 10 * w - 1, 10 * w + 1) for w in (0.2, 0.4, 0.6)]
    words = words_of(reduction_over_weight(points, []))
    assert "depal 6.00" in words
    assert not any(word.startswith("paper") for word in words)


def test_a_table_leaves_blank_what_the_paper_does_not_have() -> None:
    """Our row alone, and no dots of the paper's beside it."""
    words = words_of(table_figure([replace(OUR_TABLE[0], weight=0.25)], OUR_TABLE, 200))
    assert "w = 0.25" in words
    assert "w = 0.1" not in words
    assert words.count("avg") == 1


def test_a_table_in_which_nothing_was_gained_says_so() -> None:
    """The title follows the numbers."""
    row = replace(OUR_TABLE[0], hl_mean=13.0)
    title = title_of(table_figure([row], [], 50))
    assert title == "Knowing the request saves nothing: 12.8 actions become 13.0 at w = 0.1"


@pytest.mark.parametrize(
    ("by_h", "by_s", "title"),
    [
        ([0, 1], [1, 2], "After 2 steps s(x) has stored the requested box, h(x) alone has not"),
        ([1, 2], [0, 1], "After 2 steps h(x) alone has stored the requested box, s(x) has not"),
        ([0, 1], [0, 1], "After 2 steps the requested box still stands either way"),
        ([], [], "After 2 steps the requested box is stored either way"),
    ],
)
def test_the_title_of_the_piles_says_who_reached_the_requested_box(
    by_h: list[int], by_s: list[int], title: str
) -> None:
    """All four ways it can end; an empty pallet is drawn too."""
    lower, upper = cut_volume(4, 1)
    stack = Stack((lower + upper) / 2, upper - lower, 0, ())
    states = (PileState("all", range(4)), PileState("h", by_h), PileState("s", by_s))
    figure = three_piles(stack, states, 2)
    assert title_of(figure) == title
    assert {"4", str(len(by_h)), str(len(by_s))} <= set(words_of(figure))


def test_the_requested_box_is_outlined_where_it_is_hidden_or_gone() -> None:
    """Not where it is plain to see."""
    centres, sizes = [(1.5, 0, 1.0), (2.5, 0, 0.5)], [(1, 3, 2), (1, 1, 1)]
    states = (PileState("all", (0, 1)), PileState("seen", (1,)), PileState("gone", (0,)))
    figure = three_piles(Stack(centres, sizes, 1, (0,)), states, 1)
    outlined = [
        sum(isinstance(artist, LineCollection) for artist in axes.collections)
        for axes in figure.axes
    ]
    assert outlined == [1, 0, 1]


@pytest.mark.parametrize(
    ("after", "title"),
    [
        (((1, 0, 2),), "The request moves $b_{1}$ from place 3 to place 2"),
        (((1, 2, 0),), "The request leaves $b_{1}$ in place 3"),
        (((1, 0, 2), (0, 1, 2)), "In both layouts the request moves $b_{1}$ forward by 1 to 2"),
    ],
)
def test_the_title_of_the_scores_says_where_the_requested_box_goes(
    after: tuple[tuple[int, ...], ...], title: str
) -> None:
    """From its places before and after."""
    boxes = tuple(SeenBox(f"b{n + 1}", (1.5, -0.3 * n, 0.1), (0.3, 0.3, 0.3)) for n in range(3))
    layouts = [ScoredLayout(boxes, 0, (1, 2, 0), order) for order in after]
    assert title_of(scored_front(layouts)) == title


@pytest.mark.parametrize(
    ("rows", "panels"),
    [
        ([(5, 5)], 1),
        ([(5, 5), (5, 3, 2)], 1),
        ([(5, 5), (7, 3)], 2),
        ([(5, 5), (7, 3), (5, 4, 1)], 2),
        ([(5, 5), (5, 4, 1), (5, 3, 2)], 2),
    ],
)
def test_layouts_stand_in_pairs_where_their_words_fit(
    rows: list[tuple[int, ...]], panels: int
) -> None:
    """Counted by the levels at which their names stand."""
    names = [f"n{number}" for number in range(len(rows))]
    layouts = [scored_layout(row, name) for row, name in zip(rows, names, strict=True)]
    figure = scored_front(layouts)
    levels = {text.get_position()[1] for text in figure.texts if text.get_text()[:6] == "layout"}
    assert len(levels) == panels


def test_only_what_changes_its_place_is_red() -> None:
    """Three boxes change places: in both sequences and in the circles after the request."""
    figure = scored_front([scored_layout((5, 5))])
    red = [text for text in figure.findobj(Text) if text.get_color() == CHANGED]
    circles = [
        patch
        for axes in figure.axes
        for patch in axes.patches
        if isinstance(patch, Circle) and to_rgb(patch.get_facecolor()) == CHANGED
    ]
    assert sorted(text.get_text() for text in red) == [f"$b_{{{n}}}$" for n in (1, 1, 2, 2, 3, 3)]
    assert len(circles) == 3
