"""Where a few words fit beside a vertex without covering anything."""

from collections.abc import Sequence
from dataclasses import dataclass

from depal.studies.drawing.front import Face
from depal.studies.drawing.graph_layout import Vertex, overlap
from depal.studies.drawing.view import Array


@dataclass(frozen=True, slots=True, eq=False)
class Obstacles:
    """What words should keep clear of.

    Attributes:
        spots: the centres of all vertices, (n, 2) [m].
        radius: of a vertex [m].
        lines: points along the arrows, (m, 2) [m].
        taken: words that have their place already.
    """

    spots: Array
    radius: float
    lines: Array
    taken: Sequence[Face]

    def trouble(self, place: Face, home: Face, covers: Sequence[Face]) -> float:
        """How much is in the way in a place; 0 where there is nothing.

        Args:
            place: where the words would stand.
            home: the box that they belong to.
            covers: what hides parts of that box.
        """
        touched = int((place.clearance(self.spots) > -self.radius).sum())
        written = sum(overlap(place, words) for words in self.taken)
        covered = any(overlap(place, cover) for cover in covers)
        crossed = bool((place.clearance(self.lines) > 0.0).any())
        strayed = not home.holds(place)
        return 4.0 * (touched + written) + 2.0 * covered + crossed + 0.5 * strayed


def free_place(
    home: Face,
    vertex: Vertex,
    size: tuple[float, float],
    covers: Sequence[Face],
    obstacles: Obstacles,
) -> tuple[Face, float]:
    """The place for a box's words: in a corner of the box, else beside its vertex.

    Args:
        home: the box in the picture.
        vertex: its vertex; where it lies on top of other boxes, the words stay beside it.
        size: of the words, across and up [m].
        covers: what hides parts of the box.
        obstacles: what else there is.

    Returns:
        The place, and the trouble that is left there.
    """
    places = _beside(vertex, size, obstacles.radius)
    if vertex.hidden:
        covers = ()
    else:
        places = _corners(home, size) + places
    troubles = [obstacles.trouble(place, home, covers) for place in places]
    least = min(troubles)
    return places[troubles.index(least)], least


def _corners(home: Face, size: tuple[float, float]) -> list[Face]:
    """The four corners of a box, the upper right one first."""
    width, height = size
    rim = height * 0.45
    across = home.right - rim - width, home.left + rim
    up = home.top - rim - height, home.bottom + rim
    return [Face(left, bottom, width, height) for bottom in up for left in across]


def _beside(vertex: Vertex, size: tuple[float, float], radius: float) -> list[Face]:
    """Right of, left of, above and below a vertex."""
    (x, y), (width, height) = vertex.spot, size
    away = radius + height * 0.3
    return [
        Face(x + away, y - height / 2, width, height),
        Face(x - away - width, y - height / 2, width, height),
        Face(x - width / 2, y + away, width, height),
        Face(x - width / 2, y - away - height, width, height),
    ]
