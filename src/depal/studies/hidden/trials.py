"""Random pallets with a request for a box that the first look does not show."""

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass

import numpy as np

from depal.selection import EXACT, geometric_rank, position_priority
from depal.selection.access import fewest_removals, free_ways
from depal.studies.case1 import draw_trial
from depal.studies.hidden.looking import Looks
from depal.studies.hidden.runs import Hidden, by_access, by_paper, held_by_region
from depal.studies.pallets import generator_named
from depal.studies.retrieval.runs import Scores
from depal.studies.retrieval.trials import paper_graph
from depal.studies.statistics import Sample
from depal.studies.sweep import Progress, no_progress, sweep

POLICIES = ("paper", "waits", "searches")

_PIECE = 10
_DRAW = 13


@dataclass(frozen=True, slots=True)
class HiddenRow:
    """One policy on one kind of pallet.

    Attributes:
        pallets: the generator's name, or "all".
        policy: "paper"; "waits": access until the box is seen by h; "searches": access by belief.
        actions: boxes stored before the requested one.
        saved: actions of `paper` less those of this policy, pallet by pallet.
        limit: the fewest removals of one who knows where the box is, under the ways of access.
        region: how often the 80 % region of the belief after the first look holds the box.
        size: the volume of that region as a share of all places that the box could have.
        never: pallets on which the box was never free under some policy; left out of the means.
    """

    pallets: str
    policy: str
    actions: Sample
    saved: Sample
    limit: Sample
    region: Sample
    size: Sample
    never: int


@dataclass(frozen=True, slots=True)
class HiddenPiece:
    """Trials first .. last - 1 of one generator."""

    pallets: str
    seed: int
    first: int
    last: int


@dataclass(frozen=True, slots=True)
class HiddenResult:
    """One pallet.

    Attributes:
        actions: of each policy; None where the box was never free.
        limit: the fewest removals; None where there is no order.
        held: the part of the true place that is in the region, in [0, 1].
        size: the region's share of all places.
    """

    actions: tuple[int | None, ...]
    limit: int | None
    held: float
    size: float


def draw_hidden(generator: str, seed: int, index: int) -> Hidden | None:
    """The pallet of one trial, the same as in case study 1; a box not seen at first is requested.

    Returns:
        The trial; None where the first look shows every box.
    """
    trial = draw_trial(generator_named(generator), seed, index)
    prisms = trial.pallet.prisms
    seen = Looks.first(prisms).seen
    unseen = [box for box in range(len(prisms)) if not seen >> box & 1]
    if not unseen:
        return None
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(index, _DRAW)))
    h = position_priority(prisms, trial.pallet.x_max)
    return Hidden(
        prisms,
        unseen[int(rng.integers(len(unseen)))],
        Scores(h.tolist(), geometric_rank(prisms, h).tolist(), trial.priority),
        paper_graph(prisms),
        free_ways(prisms, EXACT),
    )


def hidden_piece(piece: HiddenPiece) -> list[HiddenResult]:
    """What some pallets took; those without an unseen box are passed over."""
    trials = (draw_hidden(piece.pallets, piece.seed, k) for k in range(piece.first, piece.last))
    return [hidden_trial(trial) for trial in trials if trial is not None]


def hidden_trial(trial: Hidden) -> HiddenResult:
    """What one pallet took under each policy."""
    plan = fewest_removals(trial.ways, 1 << trial.requested)
    held, region, places = held_by_region(trial)
    return HiddenResult(
        (by_paper(trial), by_access(trial, searches=False), by_access(trial, searches=True)),
        None if plan is None else plan.actions,
        held,
        region / max(places, 1.0),
    )


def hidden_rows(
    generators: Sequence[str],
    pallets: int,
    seed: int,
    executor: Executor | None = None,
    progress: Progress = no_progress,
) -> list[HiddenRow]:
    """Per generator one row for each policy; then those of all together.

    Args:
        generators: their names.
        pallets: how many of each are drawn; those without an unseen box count for nothing.
        seed: of the study.
        executor: who works; None for this process.
        progress: told how far it is.
    """
    pieces = [
        HiddenPiece(name, seed, first, min(first + _PIECE, pallets))
        for name in generators
        for first in range(0, pallets, _PIECE)
    ]
    parts = sweep(hidden_piece, pieces, executor, progress)
    of: dict[str, list[HiddenResult]] = {name: [] for name in generators}
    for piece, part in zip(pieces, parts, strict=True):
        of[piece.pallets] += part
    rows = [row for name, results in of.items() for row in _rows(name, results)]
    if len(of) > 1:
        rows += _rows("all", [each for results in of.values() for each in results])
    return rows


def _rows(name: str, results: Sequence[HiddenResult]) -> list[HiddenRow]:
    done = [each for each in results if each.limit is not None and None not in each.actions]
    table = np.array([each.actions for each in done], float).reshape(len(done), len(POLICIES))
    return [
        HiddenRow(
            name,
            policy,
            Sample.of(table[:, column]),
            Sample.of(table[:, 0] - table[:, column]),
            Sample.of([each.limit for each in done if each.limit is not None]),
            Sample.of([each.held for each in results]),
            Sample.of([each.size for each in results]),
            len(results) - len(done),
        )
        for column, policy in enumerate(POLICIES)
    ]
