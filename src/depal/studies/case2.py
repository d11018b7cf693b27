"""Case study 2 on geometry alone: ten cases in one frontal line (section III-C, Fig. 10).

Rows of boxes stand on one another, faces aligned, each row centred on the pallet. b1 is the
middle box of the lowest row. Boxes are named row by row from below, left to right as the robot
sees them (+y first), b1 first of all.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.domain import BoxId, Detection, Request
from depal.errors import SettingError, did_you_mean
from depal.geometry import OrientedBox
from depal.selection import EXACT, BlockingGraph, ScoreRule, leaf_alone, select
from depal.studies import paper
from depal.studies.sweep import Progress, no_progress

X_NEAR, X_MAX = 1.4, 2.2
"""The pallet's near and far side in the cell frame [m]."""

DEPTH = 0.3
"""Of every box [m]."""

JITTER = 0.02
"""Standard deviation of the jitter: the width of each box, the height of each row [m]."""

_SMALLEST = 0.05

REQUESTED = BoxId("b1")


@dataclass(frozen=True, slots=True)
class Layout:
    """How many boxes stand in each row, from below, and their mean width and height [m]."""

    rows: tuple[int, ...]
    pitch: float

    @property
    def name(self) -> str:
        """As SELECTION.md writes it: "5-5"."""
        return "-".join(map(str, self.rows))


LAYOUTS: Mapping[str, Layout] = {
    layout.name: layout
    for layout in (
        Layout((5, 5), 0.30),
        Layout((3, 3, 2, 2), 0.25),
        Layout((5, 3, 2), 0.30),
        Layout((5, 4, 1), 0.30),
        Layout((7, 3), 0.30),
    )
}
"""The layouts in which Fig. 10 comes out as printed."""


def layout_named(name: str) -> Layout:
    """The layout of that name.

    Raises:
        SettingError: there is none.
    """
    if name not in LAYOUTS:
        raise SettingError("layout", f"unknown layout {name!r}", exists=did_you_mean(name, LAYOUTS))
    return LAYOUTS[name]


@dataclass(frozen=True, slots=True)
class Sequence10:
    """The same ten boxes with and without the request.

    Attributes:
        boxes: as perceived.
        before: the names in the order of storing, without the request.
        after: the same with the request.
        h: the score of each box in the first selection without the request, by name.
        s: the same with the request.
    """

    boxes: tuple[Detection, ...]
    before: tuple[BoxId, ...]
    after: tuple[BoxId, ...]
    h: Mapping[BoxId, float]
    s: Mapping[BoxId, float]

    @property
    def rank_without(self) -> int:
        """Which box b1 is without the request, counted from 1."""
        return self.before.index(REQUESTED) + 1

    @property
    def rank_with(self) -> int:
        """Which box b1 is with the request, counted from 1."""
        return self.after.index(REQUESTED) + 1


@dataclass(frozen=True, slots=True)
class LayoutResult:
    """One layout.

    Attributes:
        layout: which.
        nominal: its run without jitter.
        robust: the share of jittered draws in which b1 is 10th without and 8th with.
        draws: how many were drawn.
    """

    layout: Layout
    nominal: Sequence10
    robust: float
    draws: int


def case2(
    layouts: Sequence[str] = tuple(LAYOUTS),
    draws: int = 1000,
    seed: int = 0,
    w: float = paper.CASE_2_WEIGHT,
    priority: float = paper.CASE_2_PRIORITY,
    progress: Progress = no_progress,
) -> tuple[LayoutResult, ...]:
    """Runs case study 2 over layouts.

    Args:
        layouts: names out of LAYOUTS.
        draws: jittered draws per layout.
        seed: of the jitter.
        w: the weight of Eq. (3).
        priority: p(b1).
        progress: told how far it is.

    Returns:
        One result per layout.

    Raises:
        SettingError: an unknown layout, or w or the priority out of [0, 1].
    """
    results = []
    total = len(layouts) * draws
    for number, name in enumerate(layouts):
        layout = layout_named(name)
        rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(number,)))
        as_printed = 0
        for draw in range(draws):
            progress(number * draws + draw, total)
            run = run_both(jittered(layout, rng), w, priority)
            as_printed += (run.rank_without, run.rank_with) == (
                paper.CASE_2_RANK_WITHOUT,
                paper.CASE_2_RANK_WITH,
            )
        nominal = run_both(boxes_of(layout), w, priority)
        results.append(LayoutResult(layout, nominal, as_printed / max(draws, 1), draws))
    progress(total, total)
    return tuple(results)


def boxes_of(layout: Layout) -> tuple[Detection, ...]:
    """The layout without jitter, b1 first."""
    widths = [np.full(count, layout.pitch) for count in layout.rows]
    return _stacked(widths, [layout.pitch] * len(layout.rows))


def jittered(layout: Layout, rng: np.random.Generator) -> tuple[Detection, ...]:
    """The layout with Gaussian jitter on each box's width and each row's height."""
    widths = [
        np.maximum(rng.normal(layout.pitch, JITTER, count), _SMALLEST) for count in layout.rows
    ]
    heights = np.maximum(rng.normal(layout.pitch, JITTER, len(layout.rows)), _SMALLEST)
    return _stacked(widths, heights.tolist())


def _stacked(
    widths: Sequence[npt.NDArray[np.float64]], heights: Sequence[float]
) -> tuple[Detection, ...]:
    shapes: list[OrientedBox] = []
    bottom = 0.0
    for row, height in zip(widths, heights, strict=True):
        left = row.sum() / 2
        for width in row.tolist():
            corner = (X_NEAR, left - width, bottom)
            shapes.append(OrientedBox.from_corner(corner, (DEPTH, width, height)))
            left -= width
        bottom += height
    middle = len(widths[0]) // 2
    shapes.insert(0, shapes.pop(middle))
    return tuple(
        Detection(BoxId(f"b{number}"), shape) for number, shape in enumerate(shapes, start=1)
    )


def run_both(boxes: Sequence[Detection], w: float, priority: float) -> Sequence10:
    """Unloads the boxes twice, without and with the request for b1."""
    rule = ScoreRule(w=w, x_max=X_MAX)
    request = Request(priority=priority, box=REQUESTED)
    before, plain = _unload(boxes, rule, ())
    after, pulled = _unload(boxes, rule, (request,))
    return Sequence10(tuple(boxes), before, after, plain, pulled)


def _unload(
    boxes: Sequence[Detection], rule: ScoreRule, requests: Sequence[Request]
) -> tuple[tuple[BoxId, ...], Mapping[BoxId, float]]:
    graph = BlockingGraph(boxes, EXACT)
    order: list[BoxId] = []
    scores: Mapping[BoxId, float] = {}
    while True:
        decision = select(graph, requests, rule, leaf_alone)
        if not order:
            scores = {verdict.box.id: verdict.s for verdict in decision.verdicts}
        if decision.target is None:
            return tuple(order), scores
        graph.remove(decision.target.id)
        order.append(decision.target.id)
