"""Fig. 9: a random pile, and what is left of it after some steps of either modality."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from depal.studies.drawing.lettering import BODY, SMALL, write
from depal.studies.drawing.palette import ASKED, CASES, IN_THE_WAY, darker
from depal.studies.drawing.sheet import MARGIN, WIDTH, Sheet, joined, sheet
from depal.studies.drawing.sight import seen_share
from depal.studies.drawing.solids import (
    Paint,
    draw_solids,
    outline,
    pallet,
    solids,
    together,
)
from depal.studies.drawing.view import FROM_THE_ROBOT, Array

VIEW = FROM_THE_ROBOT

PICTURE = 2.75
"""The height of a pile's picture [in]."""

NUMBERS = 0.95
"""The height of the words and numbers beneath it [in]."""

RIM = 0.03
"""Around a picture, for the width of its lines [m]."""

PLACES = "abc"
"""What the paper calls the three piles."""

PLAIN = 0.3
"""The share of the requested box that has to be seen where it is not outlined."""

GAP = 0.25
"""Between two piles [in]."""


@dataclass(frozen=True, slots=True, eq=False)
class Stack:
    """The boxes of a random configuration.

    Attributes:
        centres: (n, 3) [m]; the robot is at the origin and looks along +x.
        sizes: full edge lengths, (n, 3) [m].
        requested: the index of the requested box.
        blockers: the indices of its T(b_r); the requested box may be among them or not.
    """

    centres: npt.ArrayLike
    sizes: npt.ArrayLike
    requested: int
    blockers: Collection[int]


@dataclass(frozen=True, slots=True)
class PileState:
    """One of the three piles.

    Attributes:
        heading: what it is, as in "h(x) only after 20 steps".
        left: the indices of the boxes that still stand.
        numbers: what was measured, as (name, value) pairs, as in ("pillar index", "0.31").
    """

    heading: str
    left: Collection[int]
    numbers: tuple[tuple[str, str], ...] = ()


def three_piles(
    stack: Stack, states: tuple[PileState, PileState, PileState], steps: int, note: str = ""
) -> Figure:
    """A random configuration, and what h(x) only and h(x) + l(x) leave of it; Fig. 9.

    Args:
        stack: the boxes of the configuration.
        states: (a) the configuration, (b) with h(x) only, (c) with h(x) + l(x).
        steps: how many boxes were stored in (b) and in (c).
        note: the parameters of the run, for the caption.
    """
    page = sheet(
        PICTURE + NUMBERS,
        _finding(stack.requested, states, steps),
        "Green: the requested box. Pale green: what has to leave before it. Dashed: where it "
        "stands hidden, or stood.",
        joined("After Fig. 9, section III-B", note),
    )
    width = (WIDTH - 2 * MARGIN - 2 * GAP) / 3
    for number, state in enumerate(states):
        start = MARGIN + number * (width + GAP)
        _draw_pile(page, start, width, stack, state)
        _write_numbers(page, start, width, state, f"({PLACES[number]}) {state.heading}")
    return page.figure


def _finding(requested: int, states: Sequence[PileState], steps: int) -> str:
    """The title: who has reached the requested box."""
    position, both = (requested in state.left for state in states[1:])
    lead = f"After {steps} steps" if steps != 1 else "After one step"
    if position and not both:
        return f"{lead} s(x) has stored the requested box, h(x) alone has not"
    if both and not position:
        return f"{lead} h(x) alone has stored the requested box, s(x) has not"
    return f"{lead} the requested box {'still stands' if both else 'is stored'} either way"


def _draw_pile(page: Sheet, start: float, width: float, stack: Stack, state: PileState) -> None:
    """The boxes that still stand, on their pallet; every pile to the same scale."""
    whole = solids(stack.centres, stack.sizes, ())
    low, high = whole.lower.min(axis=0), whole.upper.max(axis=0)
    base = pallet(low, high)
    reach = np.stack((np.minimum(low, base.lower.min(axis=0)), high))
    seen = VIEW.flat(np.stack(np.meshgrid(*reach.T), axis=-1).reshape(-1, 3))
    (first, floor), (last, roof) = seen.min(axis=0) - RIM, seen.max(axis=0) + RIM
    axes, _ = page.picture((start, NUMBERS, width, PICTURE), (first, last, floor, roof))
    left = sorted(state.left)
    paints = [_paint(index, stack) for index in left]
    standing = solids(whole.centres[left], whole.sizes[left], paints)
    draw_solids(axes, VIEW, together(base, standing))
    requested = stack.requested
    if requested in left:
        place = left.index(requested)
        if seen_share(place, standing.lower, standing.upper, VIEW.towards) > PLAIN:
            return
    lines = outline(VIEW, whole.centres[requested], whole.sizes[requested])
    _draw_ghost(axes, lines)


def _paint(index: int, stack: Stack) -> Paint:
    """The colour of a box: what the request makes of it, else one of the browns."""
    if index == stack.requested:
        return Paint(ASKED, darker(ASKED, 0.5), 1.0)
    if index in stack.blockers:
        return Paint(IN_THE_WAY, darker(ASKED, 0.25))
    return Paint(CASES[index % len(CASES)])


def _draw_ghost(axes: Axes, lines: Sequence[Array]) -> None:
    """The edges of a box that is hidden or gone."""
    axes.add_collection(
        LineCollection(
            list(lines),
            colors=[darker(ASKED, 0.3)],
            linewidths=1.3,
            linestyles=[(0, (3, 2))],
            zorder=6,
        ),
        autolim=False,
    )


def _write_numbers(page: Sheet, start: float, width: float, state: PileState, name: str) -> None:
    """What a pile is, and what was measured on it, beneath its picture."""
    middle = start + width / 2
    style = replace(BODY, across="center")
    write(page.figure, page.point(middle, NUMBERS - 0.15), name, replace(style, bold=True))
    numbers = (("boxes left", str(len(state.left))), *state.numbers)
    step = width / len(numbers)
    for place, (what, value) in enumerate(numbers):
        across = start + (place + 0.5) * step
        write(page.figure, page.point(across, 0.4), value, replace(style, size=14.0))
        write(page.figure, page.point(across, 0.12), what, replace(SMALL, across="center"))
