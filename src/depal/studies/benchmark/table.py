"""The benchmark: every policy on every kind of pallet, on the same pallets and requests."""

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace

import numpy as np
import numpy.typing as npt

from depal.selection.stability import LEAST, THRESHOLD, StandingPile
from depal.studies.benchmark.unloading import Rule, emptied, margins
from depal.studies.case1 import draw_trial
from depal.studies.due import DuePiece, draw_pallet
from depal.studies.due.runs import Pallet
from depal.studies.pallets import generator_named
from depal.studies.stability.physics import let_go
from depal.studies.stability.states import draw_masses
from depal.studies.stability.unloading import LOOKED_AT
from depal.studies.statistics import Sample, Share
from depal.studies.sweep import Progress, no_progress, sweep

Array = npt.NDArray[np.float64]

_PIECE = 5
_MASSES = 13
LOOSE = "dropped"
"""Its pallets have gaps: those that stand with THRESHOLD from the start are taken."""


@dataclass(frozen=True, slots=True)
class BenchmarkRow:
    """One policy on one kind of pallet.

    Attributes:
        pallets: the generator's name.
        policy: its name.
        actions: boxes stored before the one requested box.
        gap: of that above the proven minimum under the policy's own rule.
        lateness: weighted, of three to eight requests with due times [actions].
        collapse: pallets of which something fell in MuJoCo before they were empty.
        margin: the least margin of a pile on the way [g]; above 0.1 counts as 0.1.
        milliseconds: of one decision, guard included [ms].
    """

    pallets: str
    policy: str
    actions: Sample
    gap: Sample
    lateness: Sample
    collapse: Share
    margin: Sample
    milliseconds: Sample


@dataclass(frozen=True, slots=True)
class Trial:
    """One policy on one pallet: `BenchmarkRow`'s numbers, and seconds of each decision."""

    policy: str
    actions: int
    least: int | None
    lateness: float
    fell: bool
    margin: float
    seconds: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class BenchmarkPiece:
    """Pallets first .. last - 1 of one generator."""

    pallets: str
    seed: int
    first: int
    last: int


def benchmark(
    generators: Sequence[str],
    pallets: int,
    seed: int,
    executor: Executor | None = None,
    progress: Progress = no_progress,
) -> list[BenchmarkRow]:
    """The rows of all generators and policies.

    Args:
        generators: their names.
        pallets: how many of each.
        seed: of every random number.
        executor: who works; None for this process.
        progress: told how far it is.

    Raises:
        SettingError: no such generator.
    """
    pieces = []
    for name in generators:
        generator_named(name)
        pieces += [
            BenchmarkPiece(name, seed, first, min(first + _PIECE, pallets))
            for first in range(0, pallets, _PIECE)
        ]
    done = sweep(benchmark_piece, pieces, executor, progress)
    rows = []
    for name in generators:
        trials = [
            trial
            for piece, found in zip(pieces, done, strict=True)
            if piece.pallets == name
            for trial in found
        ]
        rows += [row_of(name, rule.value, trials) for rule in Rule]
    return rows


def benchmark_piece(piece: BenchmarkPiece) -> list[Trial]:
    """Every policy on some pallets."""
    return [trial for index in range(piece.first, piece.last) for trial in _trials(piece, index)]


def _trials(piece: BenchmarkPiece, index: int) -> list[Trial]:
    """Every policy on one pallet; loose ones that stand less firmly than asked are passed over."""
    number = index
    least = THRESHOLD if piece.pallets == LOOSE else LEAST
    while True:
        prisms = draw_trial(generator_named(piece.pallets), piece.seed, number).pallet.prisms
        rng = np.random.default_rng(np.random.SeedSequence(piece.seed, spawn_key=(number, _MASSES)))
        masses = draw_masses(rng, prisms)
        pile = StandingPile(prisms, masses)
        if pile.certificate(at_least=least).margin >= least:
            break
        number += _APART
    drawn = DuePiece(piece.pallets, 0.0, "start", small=False, seed=piece.seed, indices=(number,))
    model = Standing(draw_pallet(drawn, number), prisms, masses, pile)
    return [_trial(model, rule) for rule in Rule]


@dataclass(frozen=True, slots=True)
class Standing:
    """A pallet with its requests, as it stands, and which piles of it have fallen.

    Attributes:
        pallet: ways, graph, scores and requests.
        prisms: (n, 8) the boxes.
        masses: (n,) [kg].
        pile: asked for margins.
        fallen: by the boxes that were gone, what MuJoCo said.
    """

    pallet: Pallet
    prisms: Array
    masses: Array
    pile: StandingPile
    fallen: dict[frozenset[int], bool] = field(default_factory=dict)

    def falls(self, gone: Sequence[int]) -> bool:
        """Whether what is left falls in MuJoCo."""
        key = frozenset(gone)
        if key not in self.fallen:
            left = np.setdiff1d(np.arange(len(self.masses)), gone)
            self.fallen[key] = let_go(self.prisms[left], self.masses[left]).fell
        return self.fallen[key]


def _trial(model: Standing, rule: Rule) -> Trial:
    """Once with all requests, once with the first alone, wanted at once."""
    pallet = model.pallet
    one = replace(pallet, requests=(replace(pallet.requests[0], due=0.0),))
    several, single = emptied(pallet, rule, model.pile), emptied(one, rule, model.pile)
    steps = margins(model.pile, single.order, LOOKED_AT)
    box = one.requests[0].box
    return Trial(
        policy=rule.value,
        actions=single.order.index(box) if box in single.order else len(single.order),
        least=single.least,
        lateness=several.lateness,
        fell=any(model.falls(gone) for gone, margin in steps if margin < LOOKED_AT),
        margin=min((min(margin, LOOKED_AT) for _, margin in steps), default=LOOKED_AT),
        seconds=several.seconds + single.seconds,
    )


def row_of(pallets: str, policy: str, trials: Sequence[Trial]) -> BenchmarkRow:
    """The row of one policy."""
    mine = [trial for trial in trials if trial.policy == policy]
    return BenchmarkRow(
        pallets,
        policy,
        Sample.of([trial.actions for trial in mine]),
        Sample.of([trial.actions - trial.least for trial in mine if trial.least is not None]),
        Sample.of([trial.lateness for trial in mine]),
        Share(sum(trial.fell for trial in mine), len(mine)),
        Sample.of([trial.margin for trial in mine]),
        Sample.of([1e3 * second for trial in mine for second in trial.seconds]),
    )


_APART = 1_000_000
"""Pallets that are drawn instead of others have numbers of their own."""
