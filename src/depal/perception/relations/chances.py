"""The probability that one box stands on another or hides it, from poses with covariance.

The relations are those of the selection (section II-C): b2 lies on b1 when their footprints
overlap and b2 is higher; b2 occludes b1 when they overlap as seen along x and b2 is nearer. Each
is a conjunction of inequalities between lengths; the errors of two boxes add up in each, and are
taken as normal and as independent from inequality to inequality.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.special import ndtr

from depal.geometry import prisms_of
from depal.perception.faces import Relation, SeenBox
from depal.perception.relations.margins import (
    BEFORE,
    BESIDE,
    CLASH,
    FLAT,
    GROUND,
    PARTED,
    RISE,
    TALL,
    margins,
)

Array = npt.NDArray[np.float64]

EXACT = 1e-5
"""No pose is better known than this [m]."""

LIKELY = 0.5
"""A relation holds when it is more probable than not."""

_X, _Y, _Z, _YAW = 0, 1, 2, 5


@dataclass(frozen=True, slots=True)
class Slack:
    """How wrong poses may be before a relation is missed or made up.

    Attributes:
        overlap: boxes that overlap by no more than this do not block each other [m].
        reach: by how much a box may seem to reach into the one that it stands on or hides [m].
    """

    overlap: float = 0.0075
    reach: float = 0.02


@dataclass(frozen=True, slots=True, eq=False)
class Chances:
    """Of all ordered pairs.

    Attributes:
        on_top: (n, n) that the row's box stands on the column's.
        occludes: (n, n) that the row's box hides the column's.
    """

    on_top: Array
    occludes: Array


def chances_of(boxes: Sequence[SeenBox], slack: Slack | None = None) -> Chances:
    """The probabilities of both relations between all boxes."""
    given = slack or Slack()
    n = len(boxes)
    if n == 0:
        return Chances(np.zeros((0, 0)), np.zeros((0, 0)))
    prisms = prisms_of(box.shape for box in boxes)
    held = margins(prisms, given.reach)
    along, across, up = _spreads(boxes, prisms)
    ground = np.minimum(along, across)

    def chance(column: int, spread: Array, least: float = 0.0) -> Array:
        return np.asarray(ndtr((held[:, :, column] - least) / spread))

    beside = chance(BESIDE, across, given.overlap)
    on_top = beside * chance(GROUND, ground, given.overlap)
    on_top *= chance(RISE, up) * chance(FLAT, up)
    occludes = beside * chance(TALL, up, given.overlap)
    occludes *= chance(BEFORE, along) * chance(PARTED, along)
    occludes[held[:, :, CLASH] > 0.0] = 0.0
    return Chances(on_top, occludes)


def relations_of(
    boxes: Sequence[SeenBox], slack: Slack | None = None, least: float = LIKELY
) -> tuple[tuple[Relation, ...], tuple[Relation, ...]]:
    """Which box stands on which, and which hides which.

    Args:
        boxes: with poses and covariances.
        slack: how wrong poses may be.
        least: relations that are less probable are left out.

    Returns:
        On top, occludes; by the indices of the boxes, in their order.
    """
    chances = chances_of(boxes, slack)
    return _listed(chances.on_top, least), _listed(chances.occludes, least)


def _spreads(boxes: Sequence[SeenBox], prisms: Array) -> tuple[Array, Array, Array]:
    """Standard deviations of what two boxes share along x, across it, and upwards, (n, n) [m]."""
    variances = np.array([np.diag(box.covariance) for box in boxes])
    reach = prisms[:, 3:5].max(axis=1)  # a turn moves a side by as much as it is long
    turned = variances[:, _YAW] * reach**2
    found = []
    for axis, extra in ((_X, turned), (_Y, turned), (_Z, np.zeros(len(boxes)))):
        own = variances[:, axis] + extra
        found.append(np.sqrt(own[:, None] + own[None, :] + EXACT**2))
    return found[0], found[1], found[2]


def _listed(chances: Array, least: float) -> tuple[Relation, ...]:
    uppers, lowers = np.nonzero(chances > least)
    return tuple(
        Relation(int(upper), int(lower), float(chances[upper, lower]))
        for upper, lower in zip(uppers, lowers, strict=True)
    )
