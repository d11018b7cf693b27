"""`depal study stability`: the linear program against MuJoCo, and the guard against collapse."""

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass

import numpy as np
from scipy.stats import binomtest

from depal.domain import checked_share
from depal.selection.stability import LEAST, THRESHOLD
from depal.studies.pallets import GENERATORS, generator_named
from depal.studies.stability.states import Compared, compare, draw_state
from depal.studies.stability.unloading import LOOKED_AT, Pair, Taken, draw_job, run_pair
from depal.studies.statistics import Sample, Share
from depal.studies.sweep import Progress, no_progress, sweep

LOOSE = "dropped"
"""The generator whose pallets have gaps and bridges."""

PACKED = tuple(name for name in GENERATORS if name != LOOSE)
"""The generators whose pallets have no gaps."""

STEPS = 10
"""The margin along an unloading is shown for so many tenths of it."""

LOW = 10.0
"""The percentile of the margin that is shown [%]."""

_PIECE = 5


@dataclass(frozen=True, slots=True)
class Agreement:
    """The program against MuJoCo.

    Attributes:
        states: how many.
        unstable: how many fell.
        agree: in how many both say the same.
        missed: of those that fell, called stable.
        alarms: of those that stood, called unstable.
        highest: the greatest margin without side faces of a state that fell [g]; LEAST for none.
    """

    states: int
    unstable: int
    agree: Share
    missed: Share
    alarms: Share
    highest: float

    @classmethod
    def of(cls, compared: Sequence[Compared]) -> "Agreement":
        """Counts."""
        fell = [state for state in compared if state.fell]
        stood = [state for state in compared if not state.fell]
        return cls(
            states=len(compared),
            unstable=len(fell),
            agree=Share(sum(state.agree for state in compared), len(compared)),
            missed=Share(sum(not state.agree for state in fell), len(fell)),
            alarms=Share(sum(not state.agree for state in stood), len(stood)),
            highest=max((state.quick for state in fell), default=LEAST),
        )


@dataclass(frozen=True, slots=True)
class Row:
    """One kind of pallets, with or without the guard.

    Attributes:
        pallets: the generator's name.
        guard: whether the guard was there.
        collapse: of the unloadings, those in which a pile fell.
        actions: boxes stored before the requested one.
        margin: the least margin of a pile on the way, unloading by unloading [g].
        along: (STEPS,) the tenth percentile of the margin in each tenth of the unloading [g].
    """

    pallets: str
    guard: bool
    collapse: Share
    actions: Sample
    margin: Sample
    along: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Paired:
    """The guard's effect on the same pallets and requests.

    Attributes:
        pallets: the generator's name.
        saved: unloadings in which a pile falls only without the guard.
        spoilt: unloadings in which a pile falls only with it.
        p: of the exact test of McNemar, two-sided.
        extra: actions with the guard less those without.
        later: candidates that were put later, an unloading.
        forced: decisions in which no candidate left a firm pile, an unloading.
    """

    pallets: str
    saved: int
    spoilt: int
    p: float
    extra: Sample
    later: float
    forced: float


@dataclass(frozen=True, slots=True)
class Stability:
    """The study's result; times are of piles of about 40 boxes [s], percentiles 50, 95, 100."""

    w: float
    threshold: float
    agreement: Agreement
    rows: tuple[Row, ...]
    paired: tuple[Paired, ...]
    candidate: tuple[float, ...]
    decision: tuple[float, ...]
    decisions: int
    compared: tuple[Compared, ...]


def stability(
    pallets: int = 1_000,
    states: int = 600,
    seed: int = 0,
    w: float = 0.2,
    threshold: float = THRESHOLD,
    executor: Executor | None = None,
    progress: Progress = no_progress,
) -> Stability:
    """Compares states with MuJoCo, and unloadings with and without the guard.

    Args:
        pallets: pairs of unloadings of loose pallets, and as many of full packings, by the four
            generators in turn.
        states: how many states are compared.
        seed: of the sweep; what is drawn is the same for any number of workers.
        w: the weight of Eq. (3).
        threshold: of the guard; loose pallets stand with as much from the start [g].
        executor: who works; None for this process.
        progress: told how far it is.

    Returns:
        The result.

    Raises:
        SettingError: w is not in [0, 1].
    """
    checked_share("w", w)
    pieces: list[_Piece] = [
        _Piece("", seed, first, min(first + _PIECE, states), w, threshold)
        for first in range(0, states, _PIECE)
    ]
    for generator, count in [(LOOSE, pallets), *_packings(pallets)]:
        pieces += [
            _Piece(generator, seed, first, min(first + _PIECE, count), w, threshold)
            for first in range(0, count, _PIECE)
        ]
    compared: list[Compared] = []
    pairs: list[Pair] = []
    for some_states, some_pairs in sweep(_work, pieces, executor, progress):
        compared += some_states
        pairs += some_pairs
    return summed_up(compared, pairs, w, threshold)


def _packings(pallets: int) -> list[tuple[str, int]]:
    """How many packings of each generator."""
    return [(name, len(range(i, pallets, len(PACKED)))) for i, name in enumerate(PACKED)]


@dataclass(frozen=True, slots=True)
class _Piece:
    """States, or jobs of one generator, with the numbers first .. last - 1."""

    generator: str
    seed: int
    first: int
    last: int
    w: float
    threshold: float


def _work(piece: _Piece) -> tuple[list[Compared], list[Pair]]:
    numbers = range(piece.first, piece.last)
    if not piece.generator:
        return [compare(draw_state(piece.seed, number)) for number in numbers], []
    generator_named(piece.generator)
    at_least = piece.threshold if piece.generator == LOOSE else LEAST
    jobs = (draw_job(piece.generator, piece.seed, number, at_least) for number in numbers)
    return [], [run_pair(job, piece.w, piece.threshold) for job in jobs]


def summed_up(
    compared: Sequence[Compared], pairs: Sequence[Pair], w: float, threshold: float
) -> Stability:
    """The result from what was measured."""
    rows: list[Row] = []
    paired: list[Paired] = []
    for generator in dict.fromkeys(pair.generator for pair in pairs):
        found = [pair for pair in pairs if pair.generator == generator]
        rows += [
            _row(generator, [pair.without for pair in found], [p.actions[0] for p in found], False),  # noqa: FBT003
            _row(generator, [pair.guarded for pair in found], [p.actions[1] for p in found], True),  # noqa: FBT003
        ]
        paired.append(_paired(generator, found))
    candidates = [s for pair in pairs for s in pair.guarded.candidate_seconds]
    decisions = [s for pair in pairs for s in pair.guarded.decision_seconds]
    return Stability(
        w=w,
        threshold=threshold,
        agreement=Agreement.of(compared),
        rows=tuple(rows),
        paired=tuple(paired),
        candidate=_percentiles(candidates),
        decision=_percentiles(decisions),
        decisions=len(decisions),
        compared=tuple(compared),
    )


def _percentiles(seconds: Sequence[float]) -> tuple[float, ...]:
    if not seconds:
        return ()
    return tuple(float(value) for value in np.percentile(seconds, [50, 95, 100]))


def _row(generator: str, taken: Sequence[Taken], actions: Sequence[int], guarded: bool) -> Row:  # noqa: FBT001
    return Row(
        pallets=generator,
        guard=guarded,
        collapse=Share(sum(one.fell_at is not None for one in taken), len(taken)),
        actions=Sample.of(actions),
        margin=Sample.of([min(one.margins, default=0.0) for one in taken]),
        along=_along(taken),
    )


def _along(taken: Sequence[Taken]) -> tuple[float, ...]:
    """The margin in each tenth of the unloadings; a pile that fell has LEAST from there on."""
    tenths: list[list[float]] = [[] for _ in range(STEPS)]
    for one in taken:
        steps = len(one.order) - 1
        margins = one.margins + [LEAST] * (steps - len(one.margins))
        for step, margin in enumerate(margins):
            tenths[STEPS * step // steps].append(min(margin, LOOKED_AT))
    return tuple(float(np.percentile(tenth, LOW)) if tenth else np.nan for tenth in tenths)


def _paired(generator: str, pairs: Sequence[Pair]) -> Paired:
    fell = [(p.without.fell_at is not None, p.guarded.fell_at is not None) for p in pairs]
    saved, spoilt = fell.count((True, False)), fell.count((False, True))
    return Paired(
        pallets=generator,
        saved=saved,
        spoilt=spoilt,
        p=mcnemar(saved, spoilt),
        extra=Sample.of([pair.actions[1] - pair.actions[0] for pair in pairs]),
        later=float(np.mean([pair.guarded.later for pair in pairs])),
        forced=float(np.mean([pair.guarded.forced for pair in pairs])),
    )


def mcnemar(first: int, second: int) -> float:
    """The exact two-sided test that two kinds of disagreement are equally likely (McNemar 1947)."""
    return float(binomtest(first, first + second).pvalue) if first + second else 1.0
