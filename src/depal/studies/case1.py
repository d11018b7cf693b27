"""Case study 1: random pallets, one random request each, counted with and without it.

Per trial one pallet is drawn, one of its boxes is requested with a random priority, and the
boxes that are stored before it are counted: once by h alone and once by s for every weight,
always on the same pallet (common random numbers).
"""

from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.selection import EXACT, geometric_rank, link_prisms, position_priority
from depal.selection.links import NONE, Links
from depal.selection.unload import unload
from depal.selection.walks import mark_reachable
from depal.studies.pallets import RandomPallet, generator_named
from depal.studies.sweep import Progress, no_progress, sweep

Array = npt.NDArray[np.float64]
Counts = npt.NDArray[np.int64]

STUCK = -1
"""The count of a trial in which a cycle of blockers kept the requested box from being stored."""

_PIECE = 250
_TWIN_WEIGHT = 0.5


@dataclass(frozen=True, slots=True)
class Trial:
    """One pallet and its request.

    Attributes:
        pallet: the boxes.
        requested: the slot of the requested box.
        priority: p of the request, in (0, 1).
    """

    pallet: RandomPallet
    requested: int
    priority: float


@dataclass(frozen=True, slots=True)
class Case1:
    """The counts of a sweep, one row a trial.

    Attributes:
        weights: the weights of the columns of `hl`.
        boxes: (trials,) how many boxes the pallet had.
        h: (trials,) boxes stored before the requested one by h alone; STUCK where never.
        hl: (trials, weights) the same by s.
        limit: (trials,) |T(r)| - 1, which no order can undercut.
        twin: (trials,) the count at another weight and a priority of equal beta = w p / (1 - w);
            equal to the first of the two weights that share it.
        twin_of: (trials,) the count that `twin` must equal.
    """

    weights: tuple[float, ...]
    boxes: Counts
    h: Counts
    hl: Counts
    limit: Counts
    twin: Counts
    twin_of: Counts

    @property
    def stuck(self) -> npt.NDArray[np.bool_]:
        """(trials,) where some run never came to the requested box."""
        return np.asarray(np.logical_or(self.h == STUCK, (self.hl == STUCK).any(axis=1)))


def draw_trial(
    generate: Callable[[np.random.Generator], RandomPallet], seed: int, index: int
) -> Trial:
    """The trial with a number; it depends on the seed and the number alone."""
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(index,)))
    pallet = generate(rng)
    return Trial(pallet, int(rng.integers(len(pallet))), 1.0 - rng.random())


def run_case1(
    generator: str,
    weights: Sequence[float],
    pallets: int,
    seed: int,
    executor: Executor | None = None,
    progress: Progress = no_progress,
) -> Case1:
    """Counts the boxes stored before the requested one over many random pallets.

    Args:
        generator: the name of the pallets' generator.
        weights: the weights w of Eq. (3).
        pallets: how many trials.
        seed: of the sweep; trial i is the same for any number of pallets and workers.
        executor: who works; None for this process.
        progress: told how far it is.

    Returns:
        The counts.

    Raises:
        SettingError: no such generator.
    """
    generator_named(generator)
    pieces = [
        _Piece(generator, tuple(weights), seed, first, min(first + _PIECE, pallets))
        for first in range(0, pallets, _PIECE)
    ]
    tables = sweep(_count_piece, pieces, executor, progress)
    columns = len(weights) + 5
    table = np.concatenate(tables) if tables else np.empty((0, columns), np.int64)
    return Case1(
        weights=tuple(weights),
        boxes=table[:, 0],
        h=table[:, 1],
        limit=table[:, 2],
        twin=table[:, 3],
        twin_of=table[:, 4],
        hl=table[:, 5:],
    )


@dataclass(frozen=True, slots=True)
class _Piece:
    """Trials first .. last - 1 of a sweep."""

    generator: str
    weights: tuple[float, ...]
    seed: int
    first: int
    last: int


def _count_piece(piece: _Piece) -> Counts:
    generate = generator_named(piece.generator)
    rows = [
        count_trial(draw_trial(generate, piece.seed, index), piece.weights)
        for index in range(piece.first, piece.last)
    ]
    return np.array(rows, np.int64)


def count_trial(trial: Trial, weights: Sequence[float]) -> list[int]:
    """One row of the sweep: boxes, h, limit, twin, twin_of, then a count per weight."""
    pallet = trial.pallet
    prisms = pallet.prisms
    links, _ = link_prisms(prisms, EXACT)
    h = position_priority(prisms, pallet.x_max)
    rank = geometric_rank(prisms, h)

    def count(w: float, priority: float) -> int:
        return count_before(links, h, rank, trial.requested, priority, w)

    # Equal beta at w = 0.5 and another weight with another priority: identical runs.
    beta = trial.priority
    other = (1 + beta) / 2
    return [
        len(pallet),
        count(0.0, trial.priority),
        limit_of(links, trial.requested),
        count(other, beta * (1 - other) / other),
        count(_TWIN_WEIGHT, beta),
        *(count(w, trial.priority) for w in weights),
    ]


def count_before(
    links: Links, h: Array, rank: Counts, requested: int, priority: float, w: float
) -> int:
    """How many boxes are stored before the requested one, or STUCK.

    Args:
        links: the graph; left as it is.
        h: (n,) Eq. (1).
        rank: (n,) the order that settles ties.
        requested: the slot of the requested box.
        priority: p of the request.
        w: the weight of Eq. (3).

    Returns:
        The count.
    """
    order = np.full(len(h), NONE, np.int32)
    run = links.copy()
    wanted = np.array([requested], np.int32)
    stored = unload(run, h, rank, wanted, np.array([priority]), w, requested, order)
    return stored if run.slots[requested, 0] == 0 else STUCK


def limit_of(links: Links, requested: int) -> int:
    """|T(r)| - 1: the boxes that must leave before the requested one under G."""
    slots = len(links.slots)
    marked, stack = np.zeros(slots, np.bool_), np.empty(slots, np.int32)
    return int(mark_reachable(links, requested, marked, stack)) - 1
