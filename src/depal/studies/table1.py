"""Table I: the actions needed to satisfy a request, in both modalities, and what must hold."""

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.studies import paper
from depal.studies.case1 import Case1, run_case1
from depal.studies.statistics import Sample
from depal.studies.sweep import Progress, no_progress

FULL_SIZE = 10_000
"""So many pallets settle a mean to about 0.1; the paper's 50 to about 2.7."""

DEFAULT_SEED = 0
MEAN_WITHIN, STD_WITHIN, REDUCTION_WITHIN = 0.5, 1.0, 0.35
PLATEAU_FROM, PLATEAU_LOW, PLATEAU_HIGH = 0.5, 4.8, 5.8
GAP_AT, GAP_WITHIN = 0.9, 0.15
_ERRORS = 3
ENOUGH = 300
"""Fewer pallets say too little of a mean for a check that could fail."""


@dataclass(frozen=True, slots=True)
class Row:
    """One weight of the table.

    Attributes:
        w: the weight.
        h: boxes stored before the requested one, by h alone.
        hl: the same by s.
        reduction: h - hl, pallet by pallet.
        limit: |T(r)| - 1, pallet by pallet.
    """

    w: float
    h: Sample
    hl: Sample
    reduction: Sample
    limit: Sample


@dataclass(frozen=True, slots=True)
class Check:
    """Something that must hold for the table to be right.

    Attributes:
        name: what must hold.
        holds: whether it does.
        measured: the number that decides.
        allowed: what it may be, in words.
    """

    name: str
    holds: bool
    measured: float
    allowed: str


@dataclass(frozen=True, slots=True)
class Table1:
    """The study's result.

    Attributes:
        generator: the name of the pallets' generator.
        pallets: how many were drawn.
        stuck: how many had a cycle of blockers before the requested box, and are left out.
        seed: of the sweep.
        rows: one per weight.
        checks: SELECTION's conditions; those on the paper's numbers for `guillotine` alone.
    """

    generator: str
    pallets: int
    stuck: int
    seed: int
    rows: tuple[Row, ...]
    checks: tuple[Check, ...]


def table1(
    pallets: int = FULL_SIZE,
    seed: int = DEFAULT_SEED,
    generator: str = "guillotine",
    weights: Sequence[float] = paper.WEIGHTS,
    executor: Executor | None = None,
    progress: Progress = no_progress,
) -> Table1:
    """Runs case study 1 and fills the table.

    Args:
        pallets: how many random pallets; the same for all weights and both modalities.
        seed: of the sweep.
        generator: the name of the pallets' generator.
        weights: the weights of the rows, rising.
        executor: who works; None for this process.
        progress: told how far it is.

    Returns:
        The table and its checks.
    """
    case = run_case1(generator, weights, pallets, seed, executor, progress)
    used = ~case.stuck
    rows = tuple(
        Row(
            w=w,
            h=Sample.of(case.h[used]),
            hl=Sample.of(case.hl[used, column]),
            reduction=Sample.of(case.h[used] - case.hl[used, column]),
            limit=Sample.of(case.limit[used]),
        )
        for column, w in enumerate(weights)
    )
    checks = [*_invariants(case)]
    if generator == "guillotine" and used.sum() >= ENOUGH:
        checks += _against_expectation(case, rows)
        exact = pallets >= FULL_SIZE and seed == DEFAULT_SEED
        checks += _against_paper(rows, errors=0 if exact else _ERRORS)
    return Table1(generator, pallets, int((~used).sum()), seed, rows, tuple(checks))


def _invariants(case: Case1) -> list[Check]:
    """What must hold on every single pallet."""
    used = ~case.stuck
    rises = np.max(np.diff(case.hl[used], axis=1), axis=1, initial=0)
    undercut = (case.hl[used] < case.limit[used, None]).any(axis=1)
    unequal = np.not_equal(case.twin[used], case.twin_of[used])
    return [
        _never("equal beta gives equal runs", unequal),
        _never("no count rises when w rises", rises > 0),
        _never("no count is below |T(r)| - 1", undercut),
    ]


def _never(name: str, broken: npt.ArrayLike) -> Check:
    count = int(np.count_nonzero(broken))
    return Check(name, count == 0, count, f"broken on 0 of {np.size(broken)} pallets")


def _against_expectation(case: Case1, rows: Sequence[Row]) -> list[Check]:
    """What the guillotine pallets' own statistics say."""
    used = ~case.stuck
    expected = (float(case.boxes[used].mean()) - 1) / 2
    # Given n the count is about uniform on 0 .. n - 1: its error is the whole sample's.
    off = rows[0].h.mean - expected
    checks = [
        Check(
            "the h-only mean is (E(n) - 1) / 2",
            abs(off) <= _ERRORS * rows[0].h.error,
            off,
            f"0 within {_ERRORS * rows[0].h.error:.3f} (3 standard errors)",
        )
    ]
    plateau = [row for row in rows if row.w >= PLATEAU_FROM]
    if plateau:
        mean = sum(row.reduction.mean for row in plateau) / len(plateau)
        slack = _ERRORS * max(row.reduction.error for row in plateau)
        slack = slack if rows[0].h.n < FULL_SIZE else 0.0
        checks.append(
            Check(
                f"the mean reduction over w >= {PLATEAU_FROM}",
                PLATEAU_LOW - slack <= mean <= PLATEAU_HIGH + slack,
                mean,
                f"{PLATEAU_LOW - slack:.2f} .. {PLATEAU_HIGH + slack:.2f}",
            )
        )
    if GAP_AT in case.weights:
        gap = Sample.of((case.hl[:, case.weights.index(GAP_AT)] - case.limit)[used])
        within = GAP_WITHIN + (_ERRORS * gap.error if gap.n < FULL_SIZE else 0.0)
        checks.append(
            Check(
                f"the gap to |T(r)| - 1 at w = {GAP_AT}",
                gap.mean <= within,
                gap.mean,
                f"<= {within:.2f}",
            )
        )
    return checks


def _against_paper(rows: Sequence[Row], errors: int) -> list[Check]:
    """The paper's table within SELECTION's tolerances, plus so many standard errors."""
    checks = []
    for row in rows:
        printed = paper.TABLE_1.get(row.w)
        if printed is None:
            continue
        n = row.h.n
        pairs = (
            ("h mean", row.h.mean - printed.h_mean, MEAN_WITHIN, row.h.error),
            ("h std", row.h.std - printed.h_std, STD_WITHIN, row.h.std / (2 * n) ** 0.5),
            ("h+l mean", row.hl.mean - printed.hl_mean, MEAN_WITHIN, row.hl.error),
            ("h+l std", row.hl.std - printed.hl_std, STD_WITHIN, row.hl.std / (2 * n) ** 0.5),
            (
                "reduction",
                row.reduction.mean - printed.reduction,
                REDUCTION_WITHIN,
                row.reduction.error,
            ),
        )
        for name, off, within, error in pairs:
            allowed = within + errors * error
            checks.append(
                Check(
                    f"w = {row.w}: {name} beside the paper's",
                    abs(off) <= allowed,
                    off,
                    f"0 within {allowed:.2f}",
                )
            )
    return checks
