"""How likely each place of an unseen box is: packings are flush, and hide what is deep.

Every placement has a few features, and its weight is the exponential of their weighted sum (a
conditional logit, McFadden 1974). The weights were fitted to random pallets of five kinds, those
of other seeds than any study's: `python scripts/fit_hidden.py`.
"""

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

import numpy as np

from depal.selection.hidden.placing import Placements, Scene, exposed, layer, placements
from depal.selection.hidden.volume import Array
from depal.selection.relations import HALF_HEIGHT, Z

FEATURES = (
    "front touches",
    "back touches",
    "sides touch",
    "base touches",
    "top touches",
    "front is bare",
    "back is bare",
    "sides are bare",
    "base is bare",
    "top is bare",
    "front is in the open",
    "top is in the open",
    "flush along x",
    "flush along y",
    "flush along z",
    "fits tightly along x",
    "fits tightly along y",
    "fits tightly along z",
    "on the deck",
)
"""What is asked of each placement; each counts once in any pile, and once more in a flush one."""

_TOUCH = 1e-3
_TINY = 1e-300


@dataclass(frozen=True, slots=True, eq=False)
class Belief:
    """Where a box may be, and how likely.

    Attributes:
        placements: m of them.
        mass: (m,) their probabilities; the sum is 1.
    """

    placements: Placements
    mass: Array

    def region_holding(self, share: float) -> Array:
        """The smallest region that holds the box with a probability: the most likely places.

        Returns:
            (m,) how much of each placement belongs to it: all, nothing, or a part of the last.
        """
        return self.region_of(self.mass, share)

    @staticmethod
    def region_of(mass: Array, share: float) -> Array:
        """The same of any probabilities (m,)."""
        order = np.argsort(-mass, kind="stable")
        before = np.cumsum(mass[order]) - mass[order]
        held = np.zeros(len(order))
        held[order] = np.clip((share - before) / np.maximum(mass[order], _TINY), 0.0, 1.0)
        return held


def believed(scene: Scene, size: tuple[float, float, float], prisms: Array) -> Belief:
    """The belief about one unseen box.

    Args:
        scene: what is known.
        size: length, width and height of the upright box [m].
        prisms: (k, 8) of the seen boxes.

    Returns:
        All placements with their probabilities; none where the box fits nowhere.
    """
    found = placements(scene, size)
    if not len(found):
        return Belief(found, np.zeros(0))
    return Belief(found, softmax(features(scene, found, prisms) @ shipped_weights()))


def softmax(scores: Array) -> Array:
    """Exponentials of scores (m,), made to sum to 1."""
    powers = np.exp(scores - scores.max())
    mass: Array = powers / powers.sum()
    return mass


@cache
def shipped_weights() -> Array:
    """(2 features,) the weights in the order of `FEATURES`, then those of flush piles."""
    text = files("depal.selection.hidden").joinpath("weights.json").read_text(encoding="utf-8")
    shipped = json.loads(text)
    return np.array([shipped[part][name] for part in ("any", "flush") for name in FEATURES])


def features(scene: Scene, found: Placements, prisms: Array) -> Array:
    """(m, 2 features) what speaks for and against each placement.

    Args:
        scene: what is known.
        found: the placements.
        prisms: (k, 8) of the seen boxes.
    """
    touches = {side: _touched(scene, found, *side) for side in _SIDES}
    bare = {side: _bared(scene, found, *side) for side in _SIDES}
    flush, tight = zip(*(_flush(scene, found, prisms, axis) for axis in range(3)), strict=True)
    pile = flushness(prisms)
    columns = [
        *(_sides(touches)),
        *(_sides(bare)),
        *exposed(scene.view, found.first, found.spans),
        *flush,
        *tight,
        (found.first[:, 2] == 0).astype(float),
    ]
    return np.column_stack([*columns, *(pile * column for column in columns)])


def flushness(prisms: Array) -> float:
    """How flush a pile is, from the share of its boxes that touch another one sideways.

    Args:
        prisms: (k, 8) of the seen boxes.

    Returns:
        0 where at most half of them do, 1 where all do, in [0, 1].
    """
    if not len(prisms):
        return 0.0
    reach = np.stack([_reach(prisms, 0), _reach(prisms, 1), prisms[:, HALF_HEIGHT]])
    low, high = prisms[:, :3].T - reach, prisms[:, :3].T + reach
    beside = (
        np.minimum(high[:, :, None], high[:, None, :])
        - np.maximum(low[:, :, None], low[:, None, :])
    ) > _TOUCH  # fmt: skip
    meets = np.abs(high[:, :, None] - low[:, None, :]) <= _TOUCH
    along = (meets[0] & beside[1] & beside[2]) | (meets[1] & beside[0] & beside[2])
    share = float((along | along.T).any(axis=1).mean())
    return max(0.0, 2 * share - 1)


_SIDES = tuple((axis, low) for axis in range(3) for low in (True, False))


def _sides(share: dict[tuple[int, bool], Array]) -> list[Array]:
    """Front, back, both sides, base, top."""
    sideways = (share[1, True] + share[1, False]) / 2
    return [share[0, True], share[0, False], sideways, share[2, True], share[2, False]]


def _touched(scene: Scene, found: Placements, axis: int, low: bool) -> Array:  # noqa: FBT001
    """The share of a side that touches a seen box or the end of the region."""
    first, spans = layer(found.first, found.spans, axis, low=low)
    place = first[:, axis]
    outside = (place < 0) | (place >= scene.region.shape[axis])
    share: Array = np.where(outside, 1.0, scene.solid.within(first, spans) / spans.prod(axis=1))
    return share


def _bared(scene: Scene, found: Placements, axis: int, low: bool) -> Array:  # noqa: FBT001
    """The share of a side that is known to have nothing before it."""
    first, spans = layer(found.first, found.spans, axis, low=low)
    share: Array = scene.vacant.within(first, spans) / spans.prod(axis=1)
    return share


def _flush(scene: Scene, found: Placements, prisms: Array, axis: int) -> tuple[Array, Array]:
    """Whether one side, and whether both, can lie in the plane of a face of the surroundings."""
    half = prisms[:, HALF_HEIGHT] if axis == Z else _reach(prisms, axis)
    planes = np.concatenate(
        (
            prisms[:, axis] - half,
            prisms[:, axis] + half,
            [scene.region.low[axis], scene.region.high[axis]],
        )
    )
    planes = np.unique(np.round(planes / _TOUCH) * _TOUCH)
    middle = found.centres(scene.region)[:, axis]
    edge = found.sizes[:, axis]
    slack = scene.region.cell[axis] / 2 + _TOUCH
    # The offsets of the box within its window that bring a side into a plane.
    low, high = (_offsets(planes, middle + sign * edge / 2, slack) for sign in (-1, 1))
    one = (np.isfinite(low).any(axis=1) | np.isfinite(high).any(axis=1)).astype(float)
    gaps = np.abs(low[:, :, None] - high[:, None, :])
    both = (gaps <= 2 * _TOUCH).any(axis=(1, 2)).astype(float)
    return one, both


def _offsets(planes: Array, side: Array, slack: float) -> Array:
    """(m, planes) how far a side is from each plane, NaN beyond a slack."""
    away = planes[None, :] - side[:, None]
    near: Array = np.where(np.abs(away) <= slack, away, np.nan)
    return near


def _reach(prisms: Array, axis: int) -> Array:
    """Half the extent of upright prisms along x or y."""
    cos, sin = np.abs(prisms[:, 6]), np.abs(prisms[:, 7])
    first, second = (cos, sin) if axis == 0 else (sin, cos)
    reach: Array = first * prisms[:, 3] + second * prisms[:, 4]
    return reach
