"""Where the graph goes on the front elevation: rows of depth, vertices, arrows."""

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from depal.studies.drawing.front import Face, SeenBox, Spot, roomiest
from depal.studies.drawing.view import Array

SAME_ROW = 0.05
"""Front sides within this of each other stand in one row [m]."""

BENDS = (0.0, 0.2, -0.2, 0.35, -0.35, 0.5, -0.5)
"""How far an arrow is bent to keep clear of other vertices, as shares of its length."""

Edge = tuple[int, int]
"""From a box to one that lies on it or occludes it, by index."""


@dataclass(frozen=True, slots=True)
class Vertex:
    """A vertex in the picture.

    Attributes:
        spot: its centre [m].
        hidden: whether it lies on top of what hides its box.
    """

    spot: Spot
    hidden: bool


def rows_of_depth(boxes: Sequence[SeenBox]) -> list[int]:
    """The row of each box, 0 for the nearest; front sides that nearly agree share one."""
    rows = [0] * len(boxes)
    row, start = 0, -math.inf
    for index in sorted(range(len(boxes)), key=lambda index: boxes[index].near):
        if boxes[index].near > start + SAME_ROW:
            row, start = row + math.isfinite(start), boxes[index].near
        rows[index] = row
    return rows


def covers_of(faces: Sequence[Face], rows: Sequence[int]) -> list[list[Face]]:
    """For each face those of nearer rows that hide a part of it."""
    return [
        [
            other
            for other, other_row in zip(faces, rows, strict=True)
            if other_row < row and overlap(face, other)
        ]
        for face, row in zip(faces, rows, strict=True)
    ]


def overlap(one: Face, other: Face, slack: float = 1e-6) -> bool:
    """Whether two rectangles share more than their rims; the slack is a length [m]."""
    across = min(one.right, other.right) - max(one.left, other.left)
    up = min(one.top, other.top) - max(one.bottom, other.bottom)
    return min(across, up) > slack


def vertices_of(
    faces: Sequence[Face], covers: Sequence[Sequence[Face]], radius: float
) -> list[Vertex]:
    """A vertex for each face: in what is seen of it, else on top and clear of the others.

    Args:
        faces: of the boxes in the picture.
        covers: for each of them what hides parts of it.
        radius: of a vertex [m].
    """
    spots = [roomiest(face, hiding) for face, hiding in zip(faces, covers, strict=True)]
    placed = {
        index: Vertex(spot, hidden=False)
        for index, (spot, room) in enumerate(spots)
        if room >= radius * 0.95 or not covers[index]
    }
    for index, face in enumerate(faces):
        if index not in placed:
            side = 2 * radius
            taken = [
                Face(vertex.spot[0] - radius, vertex.spot[1] - radius, side, side)
                for vertex in placed.values()
            ]
            placed[index] = Vertex(roomiest(face, taken)[0], hidden=True)
    return [placed[index] for index in range(len(faces))]


def direct(edges: Collection[Edge]) -> list[Edge]:
    """The edges that do not follow from others, in order; all of them where there is a cycle."""
    nexts: dict[int, set[int]] = {}
    for start, end in edges:
        nexts.setdefault(start, set()).add(end)
    beyond = {start: _beyond(start, nexts) for start in nexts}
    if any(start in far for start, far in beyond.items()):
        return sorted(set(edges))
    return sorted(
        {
            (start, end)
            for start, end in edges
            if not any(end in beyond.get(middle, ()) for middle in nexts[start])
        }
    )


def _beyond(start: int, nexts: dict[int, set[int]]) -> set[int]:
    """What can be reached from a vertex in one step or more."""
    found: set[int] = set()
    waiting = [start]
    while waiting:
        new = nexts.get(waiting.pop(), set()) - found
        found |= new
        waiting.extend(new)
    return found


def bend_of(edge: Edge, spots: Sequence[Spot], radius: float) -> float:
    """How far an arrow is bent, as a share of its length, to keep clear of other vertices.

    Args:
        edge: the two vertices that it joins.
        spots: of all vertices [m].
        radius: of a vertex [m].
    """
    others = np.array([spot for index, spot in enumerate(spots) if index not in edge])
    ends = np.array([spots[index] for index in edge])

    def crossed(bend: float) -> int:
        """How many vertices an arrow with this bend runs through."""
        steps = curve(ends[0], ends[1], bend)[:, None] - others.reshape(1, -1, 2)
        return int((np.hypot(steps[..., 0], steps[..., 1]).min(axis=0) < radius * 1.15).sum())

    return min(BENDS, key=crossed)


def curve(start: Array, end: Array, bend: float) -> Array:
    """Points of matplotlib's "arc3" between two points, (25, 2) [m].

    Args:
        start: (2,) [m].
        end: (2,) [m].
        bend: the way of its middle to the side, as a share of its length.
    """
    across, up = end - start
    middle = (start + end) / 2 + bend * np.array((up, -across))
    share = np.linspace(0.0, 1.0, 25)[:, None]
    points: Array = (1 - share) ** 2 * start + 2 * share * (1 - share) * middle + share**2 * end
    return points
