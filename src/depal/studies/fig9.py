"""Fig. 9: the pile after 20 steps, by h alone and by s, and how much of it stands in pillars."""

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.domain import checked_share
from depal.selection import EXACT, geometric_rank, link_prisms, position_priority
from depal.selection.links import NONE
from depal.selection.unload import unload
from depal.selection.walks import mark_reachable
from depal.studies import paper
from depal.studies.pallets import RandomPallet, generator_named
from depal.studies.pillars import pillar_index
from depal.studies.statistics import Sample
from depal.studies.sweep import Progress, no_progress, sweep

Slots = npt.NDArray[np.int32]

REQUESTS = (1, 3)
"""How many boxes of a pallet are requested at the same time: the paper's one, and more."""

_PIECE = 50
_MOST_DRAWS = 1000
_BOXES_PER_STEP = 1.5
_EXAMPLES = 200


@dataclass(frozen=True, slots=True)
class Piles:
    """One pallet and the two piles that the modalities leave of it.

    Attributes:
        pallet: all boxes.
        wanted: the slots of the requested boxes, by falling priority.
        left_h: the slots that are left by h alone.
        left_hl: the slots that are left by s.
    """

    pallet: RandomPallet
    wanted: Slots
    left_h: Slots
    left_hl: Slots

    @property
    def everything(self) -> Slots:
        """All slots."""
        return np.arange(len(self.pallet), dtype=np.int32)

    @property
    def blockers(self) -> list[int]:
        """T of the first requested box, in slots."""
        links, _ = link_prisms(self.pallet.prisms, EXACT)
        slots = len(self.pallet)
        marked, stack = np.zeros(slots, np.bool_), np.empty(slots, np.int32)
        found = mark_reachable(links, int(self.wanted[0]), marked, stack)
        return [int(slot) for slot in stack[:found]]

    def pillars(self, left: Slots) -> float:
        """The pillar index of what is left."""
        low, high = self.pallet.low[left], self.pallet.high[left]
        near, far = self.pallet.low.min(axis=0).tolist(), self.pallet.high.max(axis=0).tolist()
        return pillar_index(low, high, (near[0], near[1], far[0], far[1]))


@dataclass(frozen=True, slots=True)
class PillarRow:
    """The pillar index over many pallets.

    Attributes:
        requests: how many boxes were requested at once.
        h: the index by h alone.
        hl: the index by s, after the same number of steps.
        increase: hl - h, pallet by pallet.
    """

    requests: int
    h: Sample
    hl: Sample
    increase: Sample


@dataclass(frozen=True, slots=True)
class Fig9:
    """The study's result: the measurements, and one pallet to look at."""

    steps: int
    w: float
    rows: tuple[PillarRow, ...]
    example: Piles


def fig9(
    pallets: int = 1000,
    seed: int = 0,
    w: float = 0.9,
    steps: int = paper.FIG_9_STEPS,
    executor: Executor | None = None,
    progress: Progress = no_progress,
) -> Fig9:
    """Takes `steps` boxes from random pallets in both modalities and measures the pillars.

    Args:
        pallets: how many random pallets, each with half as many boxes again as `steps`, so
            that a pile is left to look at.
        seed: of the sweep.
        w: the weight of Eq. (3) in the second modality.
        steps: how many boxes are stored.
        executor: who works; None for this process.
        progress: told how far it is.

    Returns:
        The measurements, and the pallet of the picture.

    Raises:
        SettingError: w is not in [0, 1].
    """
    checked_share("w", w)
    pieces = [
        _Piece(seed, count, w, steps, first, min(first + _PIECE, pallets))
        for count in REQUESTS
        for first in range(0, pallets, _PIECE)
    ]
    tables = sweep(_measure, pieces, executor, progress)
    rows = []
    for count in REQUESTS:
        found = [table for piece, table in zip(pieces, tables, strict=True) if piece.count == count]
        h, hl = np.concatenate(found).T
        rows.append(PillarRow(count, Sample.of(h), Sample.of(hl), Sample.of(hl - h)))
    return Fig9(steps, w, tuple(rows), _example(seed, w, steps))


@dataclass(frozen=True, slots=True)
class _Piece:
    seed: int
    count: int
    w: float
    steps: int
    first: int
    last: int


def _measure(piece: _Piece) -> npt.NDArray[np.float64]:
    rows = []
    for index in range(piece.first, piece.last):
        piles = draw_piles(piece.seed, index, piece.count, piece.w, piece.steps)
        rows.append((piles.pillars(piles.left_h), piles.pillars(piles.left_hl)))
    return np.array(rows)


def draw_piles(seed: int, index: int, count: int, w: float, steps: int) -> Piles:
    """The pallet with a number, with `count` requests, and what both modalities leave of it."""
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(index,)))
    generate = generator_named("guillotine")
    pallet = generate(rng)
    for _ in range(_MOST_DRAWS):
        if len(pallet) >= _BOXES_PER_STEP * steps:
            break
        pallet = generate(rng)
    wanted = rng.permutation(len(pallet))[:count].astype(np.int32)
    priorities = -np.sort(-(1.0 - rng.random(count)))
    left_h = _left(pallet, wanted, priorities, 0.0, steps)
    left_hl = _left(pallet, wanted, priorities, w, steps)
    return Piles(pallet, wanted, left_h, left_hl)


def _left(
    pallet: RandomPallet,
    wanted: Slots,
    priorities: npt.NDArray[np.float64],
    w: float,
    steps: int,
) -> Slots:
    links, _ = link_prisms(pallet.prisms, EXACT)
    h = position_priority(pallet.prisms, pallet.x_max)
    order = np.full(steps, NONE, np.int32)
    stored = unload(links, h, geometric_rank(pallet.prisms, h), wanted, priorities, w, NONE, order)
    return np.setdiff1d(np.arange(len(pallet), dtype=np.int32), order[:stored])


def _example(seed: int, w: float, steps: int, among: Sequence[int] = range(_EXAMPLES)) -> Piles:
    """A pallet on which the difference is plain to see: the largest of the first ones.

    Fig. 9 is one picked pallet too; the rows say what is true on average.
    """
    drawn = (draw_piles(seed, index, 1, w, steps) for index in among)
    return max(drawn, key=lambda piles: piles.pillars(piles.left_hl) - piles.pillars(piles.left_h))
