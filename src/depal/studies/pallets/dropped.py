"""Boxes dropped on one another: gaps, bridges and overhangs.

The pile is built in cells of 2 cm, edges and heights as well as places: a box can rest on two
others only when their tops are level, which heights drawn freely never are.
"""

import bisect
import math
from operator import itemgetter

import numpy as np

from depal.errors import SettingError
from depal.studies.pallets.draws import Draw, uniforms
from depal.studies.pallets.lattice import ticks_below
from depal.studies.pallets.pallet import RandomPallet
from depal.studies.pallets.volume import SIZE, SMALLEST, X_MAX, drawn_count, volume_of

CELL = 0.02
"""The edge of a cell [m]."""

FILL = 0.62
"""The boxes as drawn, before any is made smaller, have about this share of the volume."""

UNEVENNESS = 0.25
"""An edge is uniform within this share of the mean edge: near to a cube."""

DROPS = 16
"""So many drops in a row, and a box that found no place is made smaller."""

ROUNDS = 100
"""So many times a box is made smaller before it is given up."""

Edges = tuple[int, int, int]
"""Along x, y, z, in cells."""

Placed = tuple[int, int, int, int, int, int]
"""Low x, y, z and high x, y, z of a box, in cells, from the volume's lowest corner."""

ROOM: Edges = (round(SIZE[0] / CELL), round(SIZE[1] / CELL), round(SIZE[2] / CELL))
"""The volume."""


def dropped(rng: np.random.Generator) -> RandomPallet:
    """A pallet of near-cubic boxes, each dropped where chance has it onto what lies below.

    A drop is kept when the box stays within the volume, its centre is over the deck or over a
    box that carries it, and at least half of its base is carried. Near-cubic boxes of 62 % of
    the volume do not come to rest in it at random: after 16 drops in vain a box loses 2 cm of
    every edge and is tried on. So the number of boxes is as drawn, and the fill is less: .43
    in the mean. The boxes come in the order in which they fell: what carries a box precedes it.
    """
    draw = uniforms(rng)
    boxes = pile(draw, drawn_edges(draw, drawn_count(draw)))
    corner, step = volume_of()[:3], ticks_below(CELL)
    cuboids = [[corner[axis % 3] + cells * step for axis, cells in enumerate(box)] for box in boxes]
    return RandomPallet.of_cuboids(cuboids, X_MAX)


def drawn_edges(draw: Draw, count: int) -> list[Edges]:
    """Near-cubic boxes, scaled together to 62 % of the volume, then rounded to cells."""
    shares = [1 + UNEVENNESS * (2 * draw() - 1) for _ in range(3 * count)]
    shapes = list(zip(shares[::3], shares[1::3], shares[2::3], strict=True))
    drawn = math.fsum(math.prod(shape) for shape in shapes)
    # Cube roots differ in the last digit from machine to machine; a rounded one does not.
    scale = round((FILL * math.prod(ROOM) / drawn) ** (1 / 3), 6)
    return [(round(x * scale), round(y * scale), round(z * scale)) for x, y, z in shapes]


def pile(draw: Draw, boxes: list[Edges]) -> list[Placed]:
    """Drops boxes into the volume, one after the other.

    Args:
        draw: random numbers.
        boxes: their edges as drawn; each must fit into the empty volume.

    Returns:
        Where each box lies, in their order, as large as drawn or smaller.

    Raises:
        SettingError: a box found no place at any size.
    """
    placed: list[Placed] = []
    by_top: list[Placed] = []
    for edges in boxes:
        box = _settled(draw, edges, by_top)
        if box is None:
            what = f"of {len(boxes)} boxes only {len(placed)} found a place"
            raise SettingError("boxes", what, "fewer or smaller ones")
        placed.append(box)
        bisect.insort(by_top, box, key=itemgetter(5))
    return placed


def _settled(draw: Draw, edges: Edges, by_top: list[Placed]) -> Placed | None:
    """Where a box comes to rest, made smaller as often as it takes; None when that was no use."""
    smallest = math.ceil(SMALLEST / CELL)
    length, width, height = edges
    for _ in range(ROUNDS):
        places_x, places_y = ROOM[0] - length + 1, ROOM[1] - width + 1
        for _ in range(DROPS):
            x, y = int(draw() * places_x), int(draw() * places_y)
            box = _rest((x, y, 0, x + length, y + width, height), by_top)
            if box is not None:
                return box
        length, width, height = (max(smallest, edge - 1) for edge in (length, width, height))
    return None


def _rest(falling: Placed, by_top: list[Placed]) -> Placed | None:
    """Where a box that falls from above stops, or None when it cannot stay there.

    Args:
        falling: the box as it would stand on the deck.
        by_top: what it may fall on, the highest last.
    """
    x, y, _, far_x, far_y, height = falling
    z = 0
    below: list[Placed] = []
    for box in reversed(by_top):
        low_x, low_y, _, high_x, high_y, top = box
        if top < z:
            break
        if x < high_x and low_x < far_x and y < high_y and low_y < far_y:
            if top + height > ROOM[2]:
                return None
            z = top
            below.append(box)
    if below and not _carry(below, falling):
        return None
    return (x, y, z, far_x, far_y, z + height)


def _carry(below: list[Placed], box: Placed) -> bool:
    """Whether boxes of one height hold another's centre and at least half of its base."""
    x, y, _, far_x, far_y, _ = box
    middle_x, middle_y = x + far_x, y + far_y  # doubled, to stay whole
    if not any(
        2 * low_x < middle_x < 2 * high_x and 2 * low_y < middle_y < 2 * high_y
        for low_x, low_y, _, high_x, high_y, _ in below
    ):
        return False
    carried = sum(
        (min(far_x, high_x) - max(x, low_x)) * (min(far_y, high_y) - max(y, low_y))
        for low_x, low_y, _, high_x, high_y, _ in below
    )
    return 2 * carried >= (far_x - x) * (far_y - y)
