"""Which boxes to remove first to find one that nobody has seen.

For every place where it may be, the boxes that would have to leave for it are known. A set of
boxes is worth the probability that it is enough, per box: the greedy rule for search with least
expected cost (min-sum set cover; Feige, Lovasz and Tetali 2004). After each removal and look the
belief is another one, and so is the set.
"""

from dataclasses import dataclass

import numpy as np

from depal.selection.access import Mask, Ways, labelled, members
from depal.selection.hidden.belief import Belief, believed
from depal.selection.hidden.placing import Scene
from depal.selection.hidden.volume import Array
from depal.selection.relations import HALF_HEIGHT, X, Y, Z


@dataclass(frozen=True, slots=True)
class Search:
    """What to remove first.

    Attributes:
        boxes: rows of seen boxes that can leave one after the other.
        probability: that the wanted box can be taken after them.
        expected: boxes that leave before it, in the mean over the belief.
    """

    boxes: Mask
    probability: float
    expected: float


def sought(
    scene: Scene, size: tuple[float, float, float], prisms: Array, ways: Ways
) -> Search | None:
    """The set of boxes to remove first.

    Args:
        scene: what is known.
        size: length, width and height of the wanted box, upright [m].
        prisms: (n, 8) in the cell frame; rows of seen boxes are those of `ways`.
        ways: how the seen boxes can be taken, as far as is known.

    Returns:
        The set; None where the box fits nowhere, or nothing can leave for it.
    """
    seen = list(members(ways.present))
    belief = believed(scene, size, prisms[seen])
    needs = needed(scene, belief, prisms, ways)
    if not needs:
        return None
    return best_set(needs)


def needed(scene: Scene, belief: Belief, prisms: Array, ways: Ways) -> list[tuple[Mask, float]]:
    """The sets of boxes that leave for the places of a belief, with their probabilities.

    Places that wait for a box that can never leave are left out.
    """
    if not len(belief.mass):
        return []
    seen = list(members(ways.present))
    leaving = {box: boxes for box, (boxes, _) in labelled(ways).items()}
    over, front = _blocking(scene, belief, prisms[seen])
    rows = np.unique(np.hstack((over, front)), axis=0, return_inverse=True)
    masses = np.bincount(rows[1].ravel(), belief.mass, len(rows[0]))
    found: dict[Mask, float] = {}
    for row, mass in zip(rows[0], masses.tolist(), strict=True):
        options = [
            _union([seen[k] for k in np.flatnonzero(part)], leaving)
            for part in (row[: len(seen)], row[len(seen) :])
        ]
        able = [each for each in options if each is not None]
        if able:
            least = min(able, key=lambda each: (each.bit_count(), each))
            found[least] = found.get(least, 0.0) + mass
    return sorted(found.items())


def best_set(needs: list[tuple[Mask, float]]) -> Search:
    """The set with the greatest probability per box; of equals the smaller one.

    Args:
        needs: sets of boxes with their probabilities; at least one. Empty ones are places that
            could be seen already: they say nothing.
    """
    real = [(boxes, mass) for boxes, mass in needs if boxes] or [(0, 1.0)]
    total = sum(mass for _, mass in needs)
    best, enough = 0, 0.0
    rate = -1.0
    for candidate in sorted(
        {boxes for boxes, _ in real}, key=lambda each: (each.bit_count(), each)
    ):
        held = sum(mass for boxes, mass in real if boxes & ~candidate == 0)
        if held / max(candidate.bit_count(), 1) > rate + _TIE:
            rate, best, enough = held / max(candidate.bit_count(), 1), candidate, held
    expected = sum(mass * boxes.bit_count() for boxes, mass in needs) / max(total, _TIE)
    return Search(best, enough / max(total, _TIE), expected)


_TIE = 1e-12


def _union(boxes: list[int], leaving: dict[int, Mask]) -> Mask | None:
    """All that leaves with some boxes; None where one of them never can."""
    union = 0
    for box in boxes:
        if box not in leaving:
            return None
        union |= leaving[box]
    return union


def _blocking(scene: Scene, belief: Belief, prisms: Array) -> tuple[Array, Array]:
    """(m, k) which seen boxes lie over each place; and which stand before it or rest on it."""
    places = belief.placements
    middle, half = places.centres(scene.region), places.sizes / 2
    slack = scene.region.cell / 2
    cos, sin = np.abs(prisms[:, 6]), np.abs(prisms[:, 7])
    reach_x = cos * prisms[:, 3] + sin * prisms[:, 4]
    reach_y = sin * prisms[:, 3] + cos * prisms[:, 4]
    reaches = (reach_x, reach_y, prisms[:, HALF_HEIGHT])
    shared = [
        np.minimum(middle[:, axis, None] + half[:, axis, None], prisms[:, axis] + reaches[axis])
        - np.maximum(middle[:, axis, None] - half[:, axis, None], prisms[:, axis] - reaches[axis])
        for axis in (X, Y, Z)
    ]
    level = [shared[axis] > slack[axis] for axis in (X, Y, Z)]
    higher = prisms[:, Z] > middle[:, Z, None]
    over = level[X] & level[Y] & higher
    rests = over & (shared[Z] >= -2 * slack[Z])
    before = level[Y] & level[Z] & (prisms[:, X] < middle[:, X, None])
    return over, before | rests
