"""Orders drawn by a known policy, and how well learning recovers it."""

import math
from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace

import numpy as np

from depal.domain import BoxId, Request, checked_share
from depal.errors import SettingError
from depal.selection import PositionWeights, ScoreRule
from depal.selection.learning import (
    Choices,
    Estimate,
    Learned,
    Order,
    Unloading,
    draw_departures,
    learn,
    probabilities,
    steps_of,
)
from depal.studies.pallets import generator_named
from depal.studies.retrieval_game import Pile
from depal.studies.statistics import Share
from depal.studies.sweep import Progress, no_progress, sweep

SHARES = ("w", "side", "depth", "height")
"""What is learned of a policy besides its temperature."""

SECONDS = 8.0
"""Between two boxes of a drawn order [s]."""

LEAST_HELD_OUT = 5
"""Fewer pallets than this are too few to hold some out."""


@dataclass(frozen=True, slots=True)
class Teacher:
    """A policy whose orders are drawn.

    Attributes:
        w: of Eq. (3).
        weights: of h, Eq. (1).
        temperature: T [m]; at 0 the best box is always taken.
        requests: how many boxes of each pallet are wanted, at random times and priorities.
        generators: the kinds of pallets, in turn.
    """

    w: float
    weights: PositionWeights
    temperature: float
    requests: int = 3
    generators: tuple[str, ...] = ("guillotine", "layered", "cubic", "columns", "dropped")

    def __post_init__(self) -> None:
        """Refuses what is no policy."""
        checked_share("w", self.w)
        if not (math.isfinite(self.temperature) and self.temperature >= 0):
            raise SettingError("temperature", f"{self.temperature!r} m", "0 m or more")
        for name in self.generators:
            generator_named(name)

    @property
    def truth(self) -> dict[str, float]:
        """What is to be learned."""
        a = self.weights
        return {"w": self.w, "side": a.side, "depth": a.depth, "height": a.height}


def draw_order(teacher: Teacher, seed: int, index: int) -> Order:
    """The order with a number; it depends on teacher, seed and number alone.

    Requests come at random moments between the start and the middle of the unloading.
    """
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(index,)))
    name = teacher.generators[index % len(teacher.generators)]
    pallet = Pile.of(generator_named(name)(rng), name)
    boxes = pallet.boxes
    wanted = rng.permutation(len(boxes))[: teacher.requests].tolist()
    requests = tuple(
        Request(
            priority=1.0 - rng.random(),
            box=BoxId(f"b{slot}"),
            arrived=round(rng.random() * SECONDS * len(boxes) / 2, 1),
        )
        for slot in wanted
    )
    rule = ScoreRule(teacher.w, pallet.x_max, teacher.weights)
    unloading = Unloading(boxes, requests, pallet.x_max, pallet.tolerances)
    departures = draw_departures(unloading, rule, teacher.temperature, rng, SECONDS)
    return Order(
        f"{name}-{seed}-{index}", boxes, requests, departures, pallet.x_max, pallet.tolerances
    )


def drawn_choices(teacher: Teacher, pallets: int, seed: int) -> Choices:
    """The choices of so many drawn orders."""
    orders = (draw_order(teacher, seed, index) for index in range(pallets))
    return Choices.of(steps_of(order).choices for order in orders)


@dataclass(frozen=True, slots=True)
class Recovery:
    """A teacher learned from its own orders.

    Attributes:
        seed: of the orders.
        learned: what came out.
        errors: per weight |learned - true|.
        relative: per weight the same over the true one.
        held: per weight whether its interval holds the true one.
        followed: how often the teacher took the box with the best score.
    """

    seed: int
    learned: Learned
    errors: dict[str, float]
    relative: dict[str, float]
    held: dict[str, bool]
    followed: Share


def recover(
    teacher: Teacher,
    pallets: int,
    seeds: Sequence[int],
    executor: Executor | None = None,
    progress: Progress = no_progress,
) -> list[Recovery]:
    """Draws orders and learns from them, once a seed.

    Args:
        teacher: the known policy.
        pallets: how many are recorded for each seed.
        seeds: one for each repetition.
        executor: who works; None for this process.
        progress: told how far it is.
    """
    pieces = [_Piece(teacher, pallets, seed) for seed in seeds]
    return sweep(_recover, pieces, executor, progress)


@dataclass(frozen=True, slots=True)
class _Piece:
    teacher: Teacher
    pallets: int
    seed: int


def _recover(piece: _Piece) -> Recovery:
    teacher = piece.teacher
    choices = drawn_choices(teacher, piece.pallets, piece.seed)
    learned = learn(choices)
    errors, relative, held = {}, {}, {}
    for name, true in teacher.truth.items():
        share: Estimate = getattr(learned, name)
        error = abs(share.value - true) if share.known else math.inf
        errors[name], held[name] = error, share.holds(true)
        relative[name] = error / true if true else math.inf if error else 0.0
    a = teacher.weights
    parts = np.array([a.side, a.depth, a.height]) * (1 - teacher.w)
    followed = _best_taken(choices, np.array([teacher.w, *parts]))
    return Recovery(piece.seed, learned, errors, relative, held, followed)


@dataclass(frozen=True, slots=True)
class HeldOut:
    """What was learned from some pallets, tried on others.

    Attributes:
        learned_from: how many pallets.
        pallets: how many it was tried on.
        choices: at those.
        taken: how often the box with the best learned score was the one that was taken.
        by_chance: how often it would have been where each box was as likely.
        log_likelihood: of a choice, on average.
        log_chance: the same where each box was as likely.
    """

    learned_from: int
    pallets: int
    choices: int
    taken: Share
    by_chance: float
    log_likelihood: float
    log_chance: float

    @property
    def explained(self) -> float:
        """The share of the log-likelihood by chance that is gained (McFadden's R2)."""
        return 1 - self.log_likelihood / self.log_chance if self.log_chance else math.nan


def held_out(choices: Choices, seed: int) -> HeldOut | None:
    """Learns from four fifths of the pallets and tries it on the others.

    Args:
        choices: of all pallets.
        seed: of which pallets are held out.

    Returns:
        How well it went; None where there are too few pallets with choices.
    """
    pallets = np.unique(choices.pallets)
    if len(pallets) < LEAST_HELD_OUT:
        return None
    shuffled = np.random.default_rng(seed).permutation(pallets).tolist()
    count = len(shuffled) // LEAST_HELD_OUT
    unseen, known = choices.at(shuffled[:count]), choices.at(shuffled[count:])
    theta = np.array(learn(known).theta)
    chances = probabilities(unseen, theta)[unseen.chosen]
    return HeldOut(
        learned_from=len(shuffled) - count,
        pallets=count,
        choices=len(unseen),
        taken=_best_taken(unseen, theta),
        by_chance=float((1 / unseen.counts).mean()),
        log_likelihood=float(np.log(np.maximum(chances, np.finfo(float).tiny)).mean()),
        log_chance=-float(np.log(unseen.counts).mean()),
    )


def _best_taken(choices: Choices, theta: np.ndarray[tuple[int], np.dtype[np.float64]]) -> Share:
    """How often the box that was taken had the best score, or tied with it."""
    score = choices.features @ theta
    best = np.maximum.reduceat(score, choices.starts)
    near = 1e-9 * max(1.0, float(np.abs(theta).sum()))
    return Share(int((score[choices.chosen] >= best - near).sum()), len(choices))


def bootstrapped(
    choices: Choices,
    learned: Learned,
    resamples: int,
    seed: int,
    progress: Progress = no_progress,
) -> Learned:
    """The same with intervals by a bootstrap over pallets: choices at one pallet go together.

    Args:
        choices: of all pallets.
        learned: from them.
        resamples: how many times pallets are drawn with repetition.
        seed: of the draws.
        progress: told how far it is.
    """
    rng = np.random.default_rng(seed)
    pallets = np.unique(choices.pallets)
    names = (*SHARES, "temperature")
    rows: list[list[float]] = []
    for done in range(resamples):
        progress(done, resamples)
        again = learn(choices.at(rng.choice(pallets, len(pallets)).tolist()))
        rows.append([getattr(again, name).value for name in names])
    intervals = [
        _widened(getattr(learned, name), [row[column] for row in rows])
        for column, name in enumerate(names)
    ]
    w, side, depth, height, temperature = intervals
    return replace(learned, w=w, side=side, depth=depth, height=height, temperature=temperature)


def _widened(estimate: Estimate, values: list[float]) -> Estimate:
    """An estimate with the interval of its resamples; what is unknown stays so."""
    finite = [value for value in values if math.isfinite(value)]
    if not (finite and math.isfinite(estimate.value)):
        return estimate
    low, high = np.quantile(finite, (0.025, 0.975)).tolist()
    return replace(estimate, low=min(low, estimate.value), high=max(high, estimate.value))
