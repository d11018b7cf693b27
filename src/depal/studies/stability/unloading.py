"""A pallet unloaded by Algorithm 1 with and without the guard, and the piles on the way."""

import time
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from depal.selection import EXACT, geometric_rank, link_prisms, position_priority
from depal.selection.links import remove
from depal.selection.score import mixed_score, stepped
from depal.selection.stability import Certificate, StandingPile, guard
from depal.selection.walks import propagate
from depal.studies.pallets import GENERATORS
from depal.studies.stability.physics import TOUCHING, let_go
from depal.studies.stability.states import draw_masses

Array = npt.NDArray[np.float64]

LOOKED_AT = 0.1
"""Piles are let go in MuJoCo where the margin found without side faces is below this; others stand
[g]."""

DRAWS = 200
"""So often a pallet is drawn anew that stands less firmly than the study asks for."""

MANY = range(36, 45)
"""Times are reported for piles of about 40 boxes."""


@dataclass(frozen=True, slots=True)
class Job:
    """One pallet and its request.

    Attributes:
        generator: of the pallet.
        prisms: (n, 8) the boxes.
        masses: (n,) [kg].
        x_max: of Eq. (1) [m].
        requested: the row of the requested box.
        priority: p of the request, in (0, 1).
    """

    generator: str
    prisms: Array
    masses: Array
    x_max: float
    requested: int
    priority: float


@dataclass(slots=True)
class Taken:
    """One way to take a pallet apart.

    Attributes:
        order: rows, in the order in which they are stored.
        margins: of the pile that each removal leaves [g]; above LOOKED_AT lower bounds.
        fell_at: after how many removals the pile fell in MuJoCo, None where it stood to the end.
        forced: in how many decisions every candidate left less than the threshold.
        later: how many candidates were put later.
        candidate_seconds: the guard's time for each candidate of a pile of about 40 boxes [s].
        decision_seconds: and for each decision [s].
    """

    order: list[int] = field(default_factory=list)
    margins: list[float] = field(default_factory=list)
    fell_at: int | None = None
    forced: int = 0
    later: int = 0
    candidate_seconds: list[float] = field(default_factory=list)
    decision_seconds: list[float] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class Pair:
    """The same job without and with the guard.

    Attributes:
        boxes: of the pallet.
        without: what Algorithm 1 does.
        guarded: what it does under the guard.
        actions: boxes stored before the requested one, without and with the guard.
        let_go: how many piles MuJoCo was asked about.
    """

    generator: str
    boxes: int
    without: Taken
    guarded: Taken
    actions: tuple[int, int]
    let_go: int


def draw_job(generator: str, seed: int, index: int, at_least: float) -> Job:
    """The job with a number; a pallet that stands with less than a margin [g] is drawn anew."""
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(index, 7)))
    for _ in range(DRAWS):
        pallet = GENERATORS[generator](rng)
        prisms = pallet.prisms
        masses = draw_masses(rng, prisms)
        requested, priority = int(rng.integers(len(prisms))), 1.0 - float(rng.random())
        pile = StandingPile(prisms, masses, rule=TOUCHING)
        if pile.certificate(at_least=at_least).margin >= at_least:
            break
    return Job(generator, prisms, masses, pallet.x_max, requested, priority)


def run_pair(job: Job, w: float, threshold: float) -> Pair:
    """Takes one pallet apart twice, and lets go of every pile that might fall."""
    pile = StandingPile(job.prisms, job.masses, rule=TOUCHING)
    asked: dict[frozenset[int], bool] = {}
    without, guarded = take_apart(job, pile, w), take_apart(job, pile, w, threshold)
    for taken in (without, guarded):
        _judge(job, pile, taken, asked)
    actions = tuple(_before(taken.order, job.requested) for taken in (without, guarded))
    return Pair(
        job.generator, len(job.masses), without, guarded, (actions[0], actions[1]), len(asked)
    )


def _before(order: list[int], row: int) -> int:
    """How many boxes go before one; all of them where it never does."""
    return order.index(row) if row in order else len(order)


def take_apart(job: Job, pile: StandingPile, w: float, threshold: float | None = None) -> Taken:
    """Stores box after box by Algorithm 1, every leaf of G being graspable.

    Args:
        job: the pallet and its request.
        pile: its margins.
        w: the weight of Eq. (3).
        threshold: of the guard [g]; None for no guard.

    Returns:
        The order; margins are not yet in it.
    """
    links, _ = link_prisms(job.prisms, EXACT)
    h = position_priority(job.prisms, job.x_max)
    rank = geometric_rank(job.prisms, h)
    taken = Taken()
    while len(taken.order) < len(h):
        waits = job.requested not in taken.order
        wanted = np.array([job.requested] if waits else [], np.int32)
        inherited = propagate(links, wanted, np.full(len(wanted), job.priority))
        steps = stepped(mixed_score(h, inherited, w))
        free = np.flatnonzero(links.blockers == 0)
        if not len(free):
            break
        ordered = free[np.lexsort((rank[free], -steps[free]))].tolist()
        row = ordered[0] if threshold is None else _guarded(ordered, pile, taken, threshold)
        remove(links, row)
        taken.order.append(row)
    return taken


def _guarded(ordered: list[int], pile: StandingPile, taken: Taken, threshold: float) -> int:
    """The guard's choice; its time is kept where the pile is large."""
    seconds: list[float] = []
    result = guard(ordered, _timed(pile, taken.order, threshold, seconds), threshold)
    if len(pile) - len(taken.order) in MANY:
        taken.candidate_seconds += seconds
        taken.decision_seconds.append(sum(seconds))
    taken.forced += result.forced
    taken.later += len(result.passed_over)
    return ordered[0] if result.chosen is None else result.chosen


def _timed(
    pile: StandingPile, gone: list[int], threshold: float, seconds: list[float]
) -> Callable[[int], Certificate]:
    def certify(row: int) -> Certificate:
        start = time.perf_counter()
        certificate = pile.certificate((*gone, row), threshold)
        seconds.append(time.perf_counter() - start)
        return certificate

    return certify


def _judge(job: Job, pile: StandingPile, taken: Taken, asked: dict[frozenset[int], bool]) -> None:
    """Fills in the margins, up to the first pile that falls in MuJoCo."""
    for count in range(1, len(taken.order)):
        gone = taken.order[:count]
        margin = pile.certificate(gone, LOOKED_AT).margin
        taken.margins.append(margin)
        if margin >= LOOKED_AT and pile.quick_bound(gone) >= LOOKED_AT:
            continue
        key = frozenset(gone)
        if key not in asked:
            left = np.setdiff1d(np.arange(len(job.masses)), gone)
            asked[key] = let_go(job.prisms[left], job.masses[left]).fell
        if asked[key]:
            taken.fell_at = count
            return
