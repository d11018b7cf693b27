"""Eqs. (1) and (3): the priority of a position, and how it is mixed with that of requests."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.domain import checked_share
from depal.errors import SettingError
from depal.geometry import kernel

Array = npt.NDArray[np.float64]

STEP = 1e-12
"""Scores and coordinates closer than this are equal, so that no order hangs on rounding [m]."""

_SUM_SLACK = 1e-9


@dataclass(frozen=True, slots=True)
class PositionWeights:
    """The three weights of Eq. (1): none negative, their sum 1.

    Attributes:
        side: of the distance from the pallet's middle plane, |y|.
        depth: of the nearness to the robot, x_max - x.
        height: of the height, z.
    """

    side: float
    depth: float
    height: float

    def __post_init__(self) -> None:
        """Refuses weights that are no weights."""
        values = (self.side, self.depth, self.height)
        for name, value in zip(("side", "depth", "height"), values, strict=True):
            if not (math.isfinite(value) and value >= 0):
                raise SettingError(f"weight {name} of h", f"{value!r}", "0 or more")
        if abs(sum(values) - 1) > _SUM_SLACK:
            raise SettingError("weights of h", f"their sum is {sum(values):.6g}", "1")


PAPER_WEIGHTS = PositionWeights(side=1 / 7, depth=2 / 7, height=4 / 7)
"""The weights of Eq. (1)."""


@dataclass(frozen=True, slots=True)
class ScoreRule:
    """What a score depends on besides the boxes and the requests.

    Attributes:
        w: the share of the requests in s(b), in [0, 1].
        x_max: the far side of the pallet in the cell frame [m].
        weights: those of h(b).
    """

    w: float
    x_max: float
    weights: PositionWeights = PAPER_WEIGHTS

    def __post_init__(self) -> None:
        """Refuses a share or a length that is none."""
        checked_share("w", self.w)
        if not math.isfinite(self.x_max):
            raise SettingError("x_max", f"{self.x_max!r}", "the x of the pallet's far side in m")


def position_priority(
    centres: Array, x_max: float, weights: PositionWeights = PAPER_WEIGHTS
) -> Array:
    """Eq. (1): h(b) = |y| / 7 + 2 (x_max - x) / 7 + 4 z / 7.

    Args:
        centres: (n, 3 or more) x, y, z of the centres of mass in the cell frame [m].
        x_max: the far side of the pallet [m].
        weights: others than the paper's, where wanted.

    Returns:
        (n,) h [m].
    """
    priority: Array = (
        weights.side * np.abs(centres[:, 1])
        + weights.depth * (x_max - centres[:, 0])
        + weights.height * centres[:, 2]
    )
    return priority


@kernel
def mixed_score(position: Array, request: Array, w: float) -> Array:
    """Eq. (3): s(b) = w l(b) + (1 - w) h(b), for arrays (n,) of h and l."""
    return w * request + (1.0 - w) * position


@kernel
def stepped(score: Array) -> Array:
    """Lengths or scores in whole steps of STEP, as floats that compare exactly."""
    return np.rint(score / STEP)


def geometric_rank(prisms: Array, h: Array | None = None) -> npt.NDArray[np.int64]:
    """Where each box stands in the order that settles ties: a total order by geometry alone.

    Greater h first, where h is given; then higher, then nearer to the robot, then nearer to a
    side, then left before right. No two boxes share a centre, so names and the order of the
    input cannot change it.

    Args:
        prisms: (n, 8).
        h: (n,) Eq. (1); so that a score that leaves no room for it, as at w = 1, still does.

    Returns:
        (n,) 0 for the first.
    """
    order = np.lexsort(_ties(prisms) if h is None else [*_ties(prisms), -stepped(h)])
    rank = np.empty(len(prisms), np.int64)
    rank[order] = np.arange(len(prisms))
    return rank


def queue_order(prisms: Array, h: Array, s: Array) -> npt.NDArray[np.intp]:
    """Line 12 of Algorithm 1: the rows by falling score, ties as `geometric_rank` settles them.

    Args:
        prisms: (n, 8).
        h: (n,) Eq. (1).
        s: (n,) Eq. (3).

    Returns:
        (n,) the rows, best first.
    """
    return np.lexsort([*_ties(prisms), -stepped(h), -stepped(s)])


def _ties(prisms: Array) -> list[Array]:
    """The keys that settle ties, the last one first."""
    x, y, z = stepped(prisms[:, :3].T)
    return [-y, -np.abs(y), x, -z]
