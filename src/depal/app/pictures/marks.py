"""Where words stand on a picture: inside what they belong to, else beside it with a line to it."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]

STEP, REACH = 0.11, 1.3
"""Places beside an outline are tried in such steps, so far away [in]."""

CLOSE = 0.012
"""Words keep so far from other words [in]."""

BEYOND = 0.85
"""Words stand inside an outline that holds so much of their width and height."""

COVERS, MARKED = 10.0, 0.6
"""How bad it is to cover other words, and the middle of another outline, in inches of distance."""


@dataclass(frozen=True, slots=True)
class Spot:
    """A rectangle for words, in inches from the picture's upper left corner.

    Attributes:
        x: of its middle, to the right.
        y: of its middle, downward.
        width: across.
        height: down.
        inside: whether it lies on what it belongs to; else a line leads there.
    """

    x: float
    y: float
    width: float
    height: float
    inside: bool = True

    def overlap(self, other: "Spot") -> float:
        """The area that two have in common, with what they keep free around them."""
        wide = (self.width + other.width) / 2 + CLOSE - abs(self.x - other.x)
        high = (self.height + other.height) / 2 + CLOSE - abs(self.y - other.y)
        return max(wide, 0.0) * max(high, 0.0)


def spots_for(
    outlines: Sequence[Floats], sizes: Sequence[tuple[float, float]], room: tuple[float, float]
) -> list[Spot]:
    """A place for the words of each outline.

    Words stand in the middle of their outline where they fit; the others look for a place beside
    theirs that covers no other words, the nearest first.

    Args:
        outlines: (4, 2) each [in].
        sizes: of the words, across and down [in].
        room: width and height of the picture [in].
    """
    spots: dict[int, Spot] = {}
    crowded = []
    for index, (outline, size) in enumerate(zip(outlines, sizes, strict=True)):
        x, y = outline.mean(axis=0).tolist()
        spot = Spot(x, y, *size)
        if _holds(outline, spot) and not any(spot.overlap(other) for other in spots.values()):
            spots[index] = spot
        else:
            crowded.append(index)
    middles = np.array([outline.mean(axis=0) for outline in outlines]).reshape(-1, 2)
    for index in crowded:
        taken = list(spots.values())
        spots[index] = _beside(index, middles, sizes[index], taken, room)
    return [spots[index] for index in range(len(outlines))]


def _holds(outline: Floats, spot: Spot) -> bool:
    """Whether words lie within a convex outline, either way round, but for their rims."""
    half = BEYOND * np.array((spot.width, spot.height)) / 2
    corners = np.array((spot.x, spot.y)) + half * [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    edges = np.roll(outline, -1, axis=0) - outline
    away = corners[None] - outline[:, None]
    beside = edges[:, None, 0] * away[..., 1] - edges[:, None, 1] * away[..., 0]
    return bool((beside >= 0).all() or (beside <= 0).all())


def _beside(
    index: int,
    middles: Floats,
    size: tuple[float, float],
    taken: Sequence[Spot],
    room: tuple[float, float],
) -> Spot:
    """The nearest place in the picture that covers the least of other words and middles."""
    half, at = np.array(size) / 2, middles[index]
    count = round(REACH / STEP)
    steps = STEP * np.arange(-count, count + 1)
    tried = at + np.stack(np.meshgrid(steps, steps, indexing="ij"), axis=-1).reshape(-1, 2)
    within = (tried >= half).all(axis=1) & (tried <= np.array(room) - half).all(axis=1)
    tried = tried[within & (np.abs(tried - at) > half).any(axis=1)]
    if not len(tried):
        return Spot(float(at[0]), float(at[1]), *size)
    others = np.delete(middles, index, axis=0)
    hit = (np.abs(others - tried[:, None]) < half).all(axis=2).sum(axis=1)
    places = np.array([(spot.x, spot.y) for spot in taken]).reshape(-1, 2)
    halves = np.array([(spot.width, spot.height) for spot in taken]).reshape(-1, 2) / 2
    common = np.maximum(halves + half + CLOSE - np.abs(places - tried[:, None]), 0.0).prod(axis=2)
    covered = COVERS * (common > 0.0).sum(axis=1) + common.sum(axis=1)
    trouble = covered + MARKED * hit + np.hypot(*(tried - at).T)
    x, y = tried[int(trouble.argmin())].tolist()
    return Spot(x, y, *size, inside=False)
