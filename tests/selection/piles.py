"""Piles to select from, and the definitions of section II-C written out slowly."""

import math

import numpy as np
from hypothesis import strategies as st

from depal.domain import BoxId, Detection, Perceived
from depal.geometry import OrientedBox, prisms_of
from depal.selection.relations import CLASH, relate

X_MAX = 2.2


def box(name: str, low: tuple[float, float, float], size: tuple[float, float, float]) -> Detection:
    """An axis-aligned box from its corner."""
    return Detection(BoxId(name), OrientedBox.from_corner(low, size))


def cut(seed: int, count: int) -> list[Detection]:
    """A volume of 0.8 x 1.6 x 1.0 m cut at random near the middle of random boxes."""
    rng = np.random.default_rng(seed)
    boxes = [((1.4, -0.8, 0.0), (2.2, 0.8, 1.0))]
    while len(boxes) < count:
        number, axis = int(rng.integers(len(boxes))), int(rng.integers(3))
        low, high = boxes[number]
        at = low[axis] + rng.uniform(0.45, 0.55) * (high[axis] - low[axis])
        below, above = list(high), list(low)
        below[axis] = above[axis] = at
        boxes[number] = (low, (below[0], below[1], below[2]))
        boxes.append(((above[0], above[1], above[2]), high))
    return [
        box(f"b{number}", low, (high[0] - low[0], high[1] - low[1], high[2] - low[2]))
        for number, (low, high) in enumerate(boxes)
    ]


@st.composite
def cut_piles(draw: st.DrawFn, most: int = 30) -> list[Detection]:
    """Gap-free piles."""
    return cut(draw(st.integers(0, 2**32 - 1)), draw(st.integers(1, most)))


@st.composite
def loose_piles(draw: st.DrawFn, most: int = 12) -> list[Detection]:
    """Boxes anywhere, turned by any yaw and tilted a little, no centre inside another box.

    They may reach into each other, as boxes of a bad picture do.
    """
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    found: list[Detection] = []
    for number in range(draw(st.integers(1, most))):
        x, y, z, a, b, c = rng.uniform(0.1, 0.5, 6).tolist()
        yaw = float(rng.choice([0.0, rng.uniform(-0.1, 0.1), rng.uniform(-3, 3)]))
        shape = OrientedBox.upright((1.4 + 2 * x, 4 * y - 1.2, 2 * z), (a, b, c), yaw)
        candidate = Detection(BoxId(f"b{number}"), shape)
        prisms = prisms_of([other.shape for other in [*found, candidate]])
        last = len(found)
        if all(relate(prisms, i, last, 0.01, 0.02) != CLASH for i in range(last)):
            found.append(candidate)
    return found


def slow_edges(boxes: list[Detection], slack: float = 1e-6) -> dict[BoxId, set[BoxId]]:
    """G of axis-aligned boxes, from its definition: name to the names of its blockers."""
    edges: dict[BoxId, set[BoxId]] = {b.id: set() for b in boxes}
    for one in boxes:
        low1, high1 = one.shape.corners.min(axis=0), one.shape.corners.max(axis=0)
        for two in boxes:
            if one is two:
                continue
            low2, high2 = two.shape.corners.min(axis=0), two.shape.corners.max(axis=0)
            shared = np.minimum(high1, high2) - np.maximum(low1, low2) > slack
            above = low2[2] >= high1[2] - slack
            before = high2[0] <= low1[0] + slack
            if (shared[0] and shared[1] and above) or (shared[1] and shared[2] and before):
                edges[one.id].add(two.id)
    return edges


def slow_reach(edges: dict[BoxId, set[BoxId]], start: BoxId) -> set[BoxId]:
    """T(b)."""
    reached, todo = {start}, [start]
    while todo:
        for blocker in edges[todo.pop()] - reached:
            reached.add(blocker)
            todo.append(blocker)
    return reached


def slow_h(perceived: Perceived) -> float:
    """Eq. (1)."""
    x, y, z = perceived.shape.centre
    return math.fsum((abs(y) / 7, 2 * (X_MAX - x) / 7, 4 * z / 7))


def cycle_of_four() -> list[Detection]:
    """D stands behind a, a behind b; c lies on b and d on c: supported, and nothing is free."""
    return [
        box("a", (1.8, 0.0, 0.4), (0.2, 0.2, 0.2)),
        box("b", (1.6, 0.0, 0.18), (0.2, 0.4, 0.24)),
        box("c", (1.7, 0.2, 0.42), (0.4, 0.2, 0.08)),
        box("d", (2.08, 0.0, 0.5), (0.12, 0.4, 0.2)),
    ]
