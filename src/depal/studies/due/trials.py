"""Random pallets with three to eight requests, each with a priority and a due time."""

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace

import numpy as np

from depal.domain import Approach
from depal.selection import EXACT, geometric_rank, position_priority
from depal.selection.access import free_ways
from depal.studies.case1 import draw_trial
from depal.studies.due.optimum import Wanted, least_lateness
from depal.studies.due.runs import Pallet, by_agenda, by_maximum, by_paper
from depal.studies.pallets import generator_named
from depal.studies.retrieval.trials import paper_graph
from depal.studies.statistics import Sample
from depal.studies.sweep import Progress, no_progress, sweep

REQUESTS = range(3, 9)
"""How many requests a pallet may have."""

SMALL = 10
"""Pallets of so many boxes at the most are compared with the exact optimum."""

HORIZON = 0.5
"""Due times, and random arrivals, are spread over this share of the pallet's boxes, in actions."""

POLICIES = ("paper", "maximum", "agenda")

_PIECE = 25
_DRAW = 11


@dataclass(frozen=True, slots=True)
class DueRow:
    """One policy on one kind of pallet.

    Attributes:
        pallets: the generator's name.
        side_only: the share of boxes that only a side grasp can take.
        arrivals: "start": all known from the start; or "random".
        small: whether only pallets of at most `SMALL` boxes count.
        policy: "paper"; "maximum": access with Eq. (2)'s maximum; "agenda": access with due times.
        lateness: weighted, pallet by pallet [actions].
        saved: lateness of `paper` less that of this policy, pallet by pallet [actions].
        optimum: the exact minimum under the ways of `access`, of small pallets with all requests
            known from the start; None for others.
        never: pallets on which a requested box was never free under some policy; left out.
    """

    pallets: str
    side_only: float
    arrivals: str
    small: bool
    policy: str
    lateness: Sample
    saved: Sample
    optimum: Sample | None
    never: int

    @property
    def above(self) -> float | None:
        """By how much the mean lateness is above the exact minimum, as a share of it."""
        if self.optimum is None:
            return None
        return self.lateness.mean / self.optimum.mean - 1 if self.optimum.mean else 0.0


@dataclass(frozen=True, slots=True)
class DuePiece:
    """Some trials of a study: `pallets`, `side_only`, `arrivals` and `small` as in `DueRow`."""

    pallets: str
    side_only: float
    arrivals: str
    seed: int
    indices: tuple[int, ...]
    small: bool = False


Result = tuple[float | None, ...]
"""The lateness of each policy, then the optimum where it is asked for."""


def draw_requests(boxes: int, seed: int, index: int, arrivals: str) -> tuple[Wanted, ...]:
    """The requests of one pallet, by the study's rule.

    Their number is uniform in `REQUESTS`, their boxes are different ones drawn at random, p is
    uniform in (0, 1], they arrive at the start or uniformly over `HORIZON` of the pallet's boxes,
    and are due uniformly over the same span after their arrival.
    """
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(index, _DRAW)))
    count = min(int(rng.integers(REQUESTS.start, REQUESTS.stop)), boxes)
    span = max(1, round(HORIZON * boxes))
    requests = []
    for box in rng.permutation(boxes)[:count].tolist():
        arrived = int(rng.integers(span)) if arrivals == "random" else 0
        due = arrived + 1 + int(rng.integers(span))
        requests.append(Wanted(box, 1.0 - rng.random(), arrived, float(due)))
    return tuple(requests)


def draw_pallet(piece: DuePiece, index: int) -> Pallet:
    """The pallet of one trial, the same as in case study 1, with its requests."""
    pallet = draw_trial(generator_named(piece.pallets), piece.seed, index).pallet
    prisms = pallet.prisms
    h = position_priority(prisms, pallet.x_max)
    rng = np.random.default_rng(np.random.SeedSequence(piece.seed, spawn_key=(index, _DRAW, 1)))
    sides = rng.random(len(pallet)) < piece.side_only
    both = (Approach.VERTICAL, Approach.HORIZONTAL)
    allowed = [(Approach.HORIZONTAL,) if side else both for side in sides.tolist()]
    return Pallet(
        free_ways(prisms, EXACT, allowed=allowed),
        paper_graph(prisms),
        h.tolist(),
        geometric_rank(prisms, h).tolist(),
        draw_requests(len(pallet), piece.seed, index, piece.arrivals),
    )


def due_piece(piece: DuePiece) -> list[Result]:
    """The lateness on some pallets."""
    results: list[Result] = []
    for index in piece.indices:
        pallet = draw_pallet(piece, index)
        found = [policy(pallet) for policy in (by_paper, by_maximum, by_agenda)]
        if piece.small and piece.arrivals == "start":
            found.append(least_lateness(pallet.ways, pallet.requests))
        results.append(tuple(found))
    return results


def small_pallets(generator: str, seed: int, count: int) -> list[int]:
    """The first trials of a seed whose pallets have at most `SMALL` boxes."""
    generate = generator_named(generator)
    found: list[int] = []
    index = 0
    while len(found) < count:
        if len(draw_trial(generate, seed, index).pallet) <= SMALL:
            found.append(index)
        index += 1
    return found


def due_rows(
    piece: DuePiece, executor: Executor | None = None, progress: Progress = no_progress
) -> list[DueRow]:
    """The rows of one kind of pallet, one a policy.

    Args:
        piece: with all trials.
        executor: who works; None for this process.
        progress: told how far it is.
    """
    parts = [
        replace(piece, indices=piece.indices[first : first + _PIECE])
        for first in range(0, len(piece.indices), _PIECE)
    ]
    results = [each for part in sweep(due_piece, parts, executor, progress) for each in part]
    return rows_of(piece, results)


def rows_of(piece: DuePiece, results: Sequence[Result]) -> list[DueRow]:
    """The rows of what was found, one a policy."""
    done = [each for each in results if None not in each]
    table = np.array(done, float).reshape(len(done), -1)
    exact = len(done) > 0 and table.shape[1] > len(POLICIES)
    return [
        DueRow(
            piece.pallets,
            piece.side_only,
            piece.arrivals,
            piece.small,
            policy,
            Sample.of(table[:, column] if done else ()),
            Sample.of(table[:, 0] - table[:, column] if done else ()),
            Sample.of(table[:, len(POLICIES)]) if exact else None,
            len(results) - len(done),
        )
        for column, policy in enumerate(POLICIES)
    ]
