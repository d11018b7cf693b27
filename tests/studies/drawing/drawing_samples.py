"""Numbers to draw: small piles, graphs and tables, and the figure that each of them makes."""

from collections.abc import Callable, Mapping
from functools import cache

import numpy as np
import numpy.typing as npt
from matplotlib.figure import Figure
from matplotlib.text import Text

from depal.studies.drawing import (
    Agreed,
    Along,
    Emptied,
    PileState,
    Reduction,
    ScoredLayout,
    SeenBox,
    Stack,
    TableRow,
    blocking_graph,
    grid_centres,
    priority_field,
    reduction_over_weight,
    scored_front,
    stability_figure,
    table_figure,
    three_piles,
    throughput_figure,
)

Array = npt.NDArray[np.float64]

PAPER_REDUCTIONS = ((0.1, 1.60), (0.3, 3.92), (0.5, 5.00), (0.7, 5.34), (0.9, 5.50))

PAPER_TABLE = (
    TableRow(0.1, 12.74, 9.91, 11.14, 9.89),
    TableRow(0.3, 13.10, 10.02, 9.18, 8.92),
    TableRow(0.5, 12.81, 9.19, 7.81, 7.34),
    TableRow(0.7, 13.03, 9.73, 7.69, 7.45),
    TableRow(0.9, 12.84, 9.47, 7.34, 7.13),
)

OUR_TABLE = (
    TableRow(0.1, 12.75, 9.64, 11.29, 9.26),
    TableRow(0.3, 12.75, 9.64, 9.02, 8.52),
    TableRow(0.5, 12.75, 9.64, 7.98, 8.02),
    TableRow(0.7, 12.75, 9.64, 7.56, 7.75),
    TableRow(0.9, 12.75, 9.64, 7.31, 7.57),
)


def cut_volume(count: int, seed: int) -> tuple[Array, Array]:
    """The pallet's volume in `count` boxes by random cuts: lower and upper corners, (n, 3) [m]."""
    rng = np.random.default_rng(seed)
    boxes = [((1.4, -0.8, 0.0), (2.2, 0.8, 1.0))]
    while len(boxes) < count:
        low, high = boxes.pop(int(rng.integers(len(boxes))))
        axis = max(range(3), key=lambda k: (high[k] - low[k]) * rng.uniform(0.5, 1.0))
        level = low[axis] + rng.uniform(0.4, 0.6) * (high[axis] - low[axis])
        boxes.append((low, (*high[:axis], level, *high[axis + 1 :])))
        boxes.append(((*low[:axis], level, *low[axis + 1 :]), high))
    lower, upper = np.array(boxes).swapaxes(0, 1)
    return lower, upper


def graph_boxes() -> list[SeenBox]:
    """Three boxes in front, two behind, three on top; b4 is the one behind the middle."""
    places = (
        ((1.6, 0.5, 0.2), (0.4, 0.4, 0.4)),
        ((1.6, 0.05, 0.15), (0.4, 0.5, 0.3)),
        ((1.6, -0.45, 0.2), (0.4, 0.5, 0.4)),
        ((2.0, 0.1, 0.25), (0.4, 0.5, 0.5)),
        ((2.0, 0.55, 0.2), (0.4, 0.4, 0.4)),
        ((1.6, 0.05, 0.45), (0.4, 0.4, 0.3)),
        ((1.6, -0.3, 0.55), (0.4, 0.5, 0.3)),
        ((2.0, 0.1, 0.65), (0.4, 0.5, 0.3)),
    )
    return [
        SeenBox(f"b{number}", centre, size, 0.1 * number, 0.1 * number + 0.25 * (number > 5))
        for number, (centre, size) in enumerate(places, start=1)
    ]


GRAPH_EDGES = ((1, 5), (2, 6), (3, 0), (3, 1), (3, 5), (3, 7), (4, 0), (7, 5), (7, 6))
GRAPH_BLOCKERS = (0, 1, 5, 6, 7)


def scored_layout(rows: tuple[int, ...], name: str = "") -> ScoredLayout:
    """Ten boxes in rows from below, b1 in the middle of the lowest, and made-up sequences."""
    places = [
        ((1.55, (count / 2 - column - 0.5) * 0.3, (level + 0.5) * 0.3), column)
        for level, count in enumerate(rows)
        for column in range(count)
    ]
    places.insert(0, places.pop(rows[0] // 2))
    boxes = tuple(
        SeenBox(f"b{number}", centre, (0.3, 0.3, 0.3), 0.1 + number / 50, 0.12 + number / 50)
        for number, (centre, _) in enumerate(places, start=1)
    )
    return ScoredLayout(
        boxes, 0, (9, 8, 7, 6, 5, 4, 3, 2, 1, 0), (9, 8, 7, 6, 5, 4, 3, 0, 2, 1), name
    )


def draw_field() -> Figure:
    """Fig. 4 of coarse cells."""
    centres = grid_centres((1.4, -0.8, 0.0), (2.2, 0.8, 1.0), (4, 8, 5))
    values = np.abs(centres[:, 1]) / 7 + 2 * (2.2 - centres[:, 0]) / 7 + 4 * centres[:, 2] / 7
    return priority_field(centres, values, (0.2, 0.2, 0.2), "cells of 0.2 m")


def draw_graph() -> Figure:
    """Fig. 5 with scores and boxes behind others."""
    return blocking_graph(graph_boxes(), GRAPH_EDGES, 3, GRAPH_BLOCKERS, "w = 0.5")


def draw_reduction() -> Figure:
    """Fig. 8 with both series."""
    points = [
        Reduction(row.weight, mean, mean - 0.2, mean + 0.2)
        for row in OUR_TABLE
        for mean in (row.h_mean - row.hl_mean,)
    ]
    return reduction_over_weight(points, PAPER_REDUCTIONS, "seed 0")


def draw_table() -> Figure:
    """Table I."""
    return table_figure(OUR_TABLE, PAPER_TABLE, 10_000, 50, "seed 0")


def draw_piles() -> Figure:
    """Fig. 9; the requested box is hidden in (a) and (b) and gone in (c)."""
    lower, upper = cut_volume(16, 3)
    centres = (lower + upper) / 2
    asked = int(np.argmax(centres[:, 0] - centres[:, 2]))
    order = [int(index) for index in np.argsort(-centres[:, 2] + centres[:, 0])]
    early = [asked, *(index for index in order if index != asked)]
    stack = Stack(centres, upper - lower, asked, order[:3])
    numbers = (("pillar index", "0.31"), ("actions", "9"))
    return three_piles(
        stack,
        (
            PileState("random configuration", order, numbers),
            PileState("h(x) only", order[6:], numbers),
            PileState("h(x) + l(x)", early[6:], numbers),
        ),
        6,
        "seed 3",
    )


def draw_scores() -> Figure:
    """Fig. 10 with three layouts: a pair and one that needs the whole width."""
    layouts = (((5, 5), "5-5"), ((5, 3, 2), "5-3-2"), ((7, 3), "7-3"))
    return scored_front([scored_layout(rows, name) for rows, name in layouts], "w = 0.2")


def emptied_deliveries(count: int, runs: int) -> list[Emptied]:
    """Made-up deliveries, one with a long name, one in which something went wrong."""
    return [
        Emptied(
            f"dev-{number:03}" if number else "a_long_name$for a delivery",
            20 + number,
            tuple(380.0 + 9 * number + run for run in range(runs)),
            {"arm motion": 6.5, "suction": 0.5, "waiting for people": 0.3 * (number % 3)},
            number != 1,
        )
        for number in range(count)
    ]


SHARES = {
    "arm motion": 0.88,
    "suction": 0.062,
    "reader": 0.0,
    "looking": 0.02,
    "planning": 0.004,
    "waiting for people": 0.034,
    "nothing": 0.0,
}


def draw_throughput() -> Figure:
    """Ten deliveries, each run once."""
    return throughput_figure(emptied_deliveries(10, 1), SHARES, 400.0, "seed 0")


def draw_many_runs() -> Figure:
    """So many deliveries that the rows are dense, each run three times."""
    return throughput_figure(emptied_deliveries(26, 3), SHARES, 400.0, "seeds 0 to 2")


def draw_stability() -> Figure:
    """The margins of made-up unloadings, some of which fall."""
    along = [0.08, 0.07, 0.05, 0.04, -1.0, 0.02, 0.05, 0.07, 0.1, 0.1]
    firm = [0.08, 0.07, 0.06, 0.05, 0.04, 0.04, 0.05, 0.07, 0.1, 0.1]
    agreed = Agreed((414, 5), (1, 180))
    return stability_figure(Along(along, 0.067), Along(firm, 0.022), agreed, 0.03, "seed 0")


FIGURES: Mapping[str, Callable[[], Figure]] = {
    "field": draw_field,
    "graph": draw_graph,
    "reduction": draw_reduction,
    "table": draw_table,
    "piles": draw_piles,
    "scores": draw_scores,
    "throughput": draw_throughput,
    "many runs": draw_many_runs,
    "stability": draw_stability,
}


@cache
def figure_of(name: str) -> Figure:
    """A figure to look at, drawn once."""
    return FIGURES[name]()


def words_of(figure: Figure) -> list[str]:
    """Everything that is written on a figure."""
    return [text.get_text() for text in figure.findobj(Text) if text.get_text().strip()]
