"""Retrieval as a game of one player: which box next, until every request is served.

The rules of the studies, on geometry alone: everything is known, whatever may be taken can be
grasped, and nothing falls. What an action costs is Table I's count: over an episode the rewards
add up to minus the boxes that were taken before each requested one.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np
import numpy.typing as npt

from depal.domain import BoxId, Detection, Perceived, Request
from depal.errors import SettingError, did_you_mean
from depal.geometry import OrientedBox, prisms_of
from depal.logistics import shipped_deliveries
from depal.selection import EXACT, ScoreRule, Tolerances
from depal.selection.access import BEFORE, OVER, RESTS, masks, standings
from depal.selection.learning import Unloading
from depal.studies.pallets import GENERATORS, RandomPallet, generator_named
from depal.studies.real import STACKED, far_side, perceived_stack

Array = npt.NDArray[np.float64]

REAL = "real"
"""The name of the real deliveries that ship with the package, among those of generators."""


class Blocking(Enum):
    """Which boxes may be taken."""

    PAPER = "paper"
    """Those that nothing lies on and nothing hides: the leaves of G."""
    ACCESS = "access"
    """Those with nothing on them, from above; those with nothing on or before them, from there."""


@dataclass(frozen=True, slots=True)
class Setting:
    """What is played.

    Attributes:
        pallets: names of generators, or `real`; each episode draws one of them.
        requests: how many boxes are wanted, from the start.
        blocking: which boxes may be taken.
    """

    pallets: tuple[str, ...] = tuple(GENERATORS)
    requests: int = 1
    blocking: Blocking = Blocking.PAPER

    def __post_init__(self) -> None:
        """Refuses what cannot be played."""
        known = [*GENERATORS, REAL]
        if not self.pallets:
            raise SettingError("pallets", "no name", exists=did_you_mean("", known))
        for name in self.pallets:
            if name not in known:
                exists = did_you_mean(name, known)
                raise SettingError("pallets", f"unknown name {name!r}", exists=exists)
        if self.requests < 1:
            raise SettingError("requests", f"{self.requests} boxes are wanted", "1 or more")


@dataclass(frozen=True, slots=True)
class Pile:
    """Boxes to play on.

    Attributes:
        kind: the generator's name, or `real`.
        boxes: in the cell frame.
        x_max: the far side of the pallet [m].
        tolerances: how exact their places are.
    """

    kind: str
    boxes: tuple[Perceived, ...]
    x_max: float
    tolerances: Tolerances

    @classmethod
    def of(cls, pallet: RandomPallet, kind: str) -> "Pile":
        """A random pallet."""
        shapes = zip(pallet.low.tolist(), pallet.sizes.tolist(), strict=True)
        boxes = tuple(
            Detection(BoxId(f"b{number}"), OrientedBox.from_corner((x, y, z), (a, b, c)))
            for number, ((x, y, z), (a, b, c)) in enumerate(shapes)
        )
        return cls(kind, boxes, pallet.x_max, EXACT)


@dataclass(frozen=True, slots=True)
class Taken:
    """What an action did.

    Attributes:
        reward: minus the requests that are still open.
        ended: every request is served, or nothing can be taken any more.
        refused: the box could not be taken; nothing has changed.
    """

    reward: float
    ended: bool
    refused: bool


class PalletGame:
    """One episode: a pallet, its requests, and what is left of both."""

    def __init__(self, pile: Pile, priorities: Array, blocking: Blocking = Blocking.PAPER) -> None:
        """A pallet on which nothing has been taken yet.

        Args:
            pile: the boxes.
            priorities: (n,) p of the request for each box, 0 where there is none.
            blocking: which boxes may be taken.
        """
        self.pile = pile
        self.boxes = pile.boxes
        self.priorities = priorities.copy()
        self.present = np.ones(len(pile.boxes), np.bool_)
        requests = [
            Request(priority=float(p), box=box.id)
            for box, p in zip(pile.boxes, priorities.tolist(), strict=True)
            if p > 0
        ]
        self._numbers = {box.id: number for number, box in enumerate(pile.boxes)}
        self._unloading = Unloading(pile.boxes, requests, pile.x_max, pile.tolerances)
        self._ways = _ways(pile) if blocking is Blocking.ACCESS else None

    @classmethod
    def drawn(cls, setting: Setting, rng: np.random.Generator) -> "PalletGame":
        """Draws a pallet and its requests.

        Args:
            setting: what is played.
            rng: the same state gives the same episode.
        """
        pile = _drawn(setting.pallets[int(rng.integers(len(setting.pallets)))], rng)
        count = min(setting.requests, len(pile.boxes))
        priorities = np.zeros(len(pile.boxes))
        wanted = rng.permutation(len(pile.boxes))[:count]
        priorities[wanted] = 1.0 - rng.random(count)
        return cls(pile, priorities, setting.blocking)

    @property
    def waiting(self) -> int:
        """How many requests are open."""
        return int((self.priorities > 0).sum())

    def takeable(self) -> npt.NDArray[np.bool_]:
        """(n,) which boxes may be taken."""
        found = np.zeros(len(self.boxes), np.bool_)
        if self._ways is None:
            free, _ = self._unloading.takeable(0.0)
            found[[self._numbers[box.id] for box in free]] = True
            return found
        left = sum(1 << int(slot) for slot in np.flatnonzero(self.present))
        for slot in np.flatnonzero(self.present).tolist():
            found[slot] = any(not way[slot] & left for way in self._ways)
        return found

    def take(self, number: int) -> Taken:
        """Takes a box, where it can be taken."""
        takeable = self.takeable()
        if not (0 <= number < len(takeable) and takeable[number]):
            return Taken(-float(self.waiting), ended=not takeable.any(), refused=True)
        self._unloading.take(self.boxes[number].id, 0.0)
        self.present[number] = False
        self.priorities[number] = 0.0
        waiting = self.waiting
        ended = not waiting or not self.takeable().any()
        return Taken(-float(waiting), ended=ended, refused=False)

    def by_the_paper(self, w: float) -> int:
        """The box that Algorithm 1 takes next, among those that nothing blocks under G.

        Args:
            w: of Eq. (3).
        """
        weights = ScoreRule(w, self.pile.x_max).weights
        a = np.array([weights.side, weights.depth, weights.height])
        boxes, features = self._unloading.takeable(0.0)
        score = w * features[:, 0] + (1 - w) * (features[:, 1:] @ a)
        return self._numbers[boxes[int(np.argmax(score))].id]


def _drawn(kind: str, rng: np.random.Generator) -> Pile:
    if kind == REAL:
        deliveries = [each for each in shipped_deliveries() if each.stack is not None]
        delivery = deliveries[int(rng.integers(len(deliveries)))]
        return Pile(REAL, perceived_stack(delivery), far_side(delivery), STACKED)
    return Pile.of(generator_named(kind)(rng), kind)


def _ways(pile: Pile) -> tuple[Sequence[int], ...]:
    """Per way, from above and from the front, what is in the way of each box, as bits."""
    used = np.arange(len(pile.boxes))
    prisms = prisms_of(box.shape for box in pile.boxes)
    codes = standings(prisms, used, pile.tolerances.overlap, pile.tolerances.slack)
    return masks(codes & OVER), masks(codes & (BEFORE | RESTS))
