"""Choices that a rule without noise could have made, and all rules that could have made them.

A rule theta agrees with a choice when the box that was taken has the best score, or ties with
it. Where some rule agrees with all choices and strictly prefers some, no finite theta is the
most likely one (Albert and Anderson, "On the existence of maximum likelihood estimates in
logistic regression models", 1984): the likelihood grows as the temperature falls. All of this is
linear in theta, and solved by linear programs over few of the many rows at a time.
"""

import numpy as np
import numpy.typing as npt
from scipy.optimize import linprog

Array = npt.NDArray[np.float64]

SAME = 1e-9
"""Scores closer than this tie [m]."""

STRICT = 1e-6
"""A rule prefers a box strictly when its score is greater by more than this [m]."""

_FIRST, _MORE = 400, 200
_TIGHT = 1e-10


def agreeing(losses: Array) -> Array | None:
    """A rule in the middle of those that agree with all choices, or None.

    Args:
        losses: (n, columns) see `Choices.losses`.

    Returns:
        (columns,) its weights, not negative, their sum 1; None where no rule agrees with all
        choices, or each that does ties in all of them.
    """
    rows = _distinct(losses)
    if not len(rows):
        return None
    columns = rows.shape[1]
    bounds: list[tuple[float, float | None]] = [(0.0, None)] * columns
    # The mean of rules at many ends of the region lies in its middle, where few choices tie.
    costs = [-rows.mean(axis=0), *np.eye(columns), *-np.eye(columns)]
    found = [_solved(cost, rows, np.ones(columns), bounds) for cost in costs]
    rules = [rule for rule in found if rule is not None]
    if not rules:
        return None
    middle = np.asarray(np.mean(rules, axis=0), dtype=float)
    return middle if float((rows @ middle).max()) >= STRICT else None


def extremes(losses: Array, measured: Array, whole: Array) -> tuple[Array, Array] | None:
    """The rules at which a share of weights is smallest and greatest, of all that agree.

    Args:
        losses: (n, columns) see `Choices.losses`.
        measured: (columns,) the share is measured . theta / whole . theta.
        whole: (columns,).

    Returns:
        Two times (columns,), their sums 1; None where no rule with such a share agrees.
    """
    rows = _distinct(losses)
    bounds: list[tuple[float, float | None]] = [(0.0, None)] * len(whole)
    low = _solved(measured, rows, whole, bounds)
    high = _solved(-measured, rows, whole, bounds)
    if low is None or high is None:
        return None
    return low / low.sum(), high / high.sum()


def _solved(
    cost: Array, rows: Array, whole: Array, bounds: list[tuple[float, float | None]]
) -> Array | None:
    """The x with rows . x >= 0 and whole . x = 1 that costs least; None where there is none.

    Few of the rows decide: those that a first answer breaks most are added until none is broken.
    """
    used = np.zeros(len(rows), np.bool_)
    used[:: max(1, len(rows) // _FIRST)] = True
    while True:
        found = linprog(
            cost,
            A_ub=-rows[used],
            b_ub=np.zeros(int(used.sum())),
            A_eq=whole[None],
            b_eq=[1.0],
            bounds=bounds,
            options={"primal_feasibility_tolerance": _TIGHT},
        )
        if not found.success:
            return None
        answer = np.asarray(found.x, dtype=float)
        margins = np.where(used, 0.0, rows @ answer)
        worst = np.argsort(margins)[:_MORE]
        worst = worst[margins[worst] < -_TIGHT]
        if not len(worst):
            return answer
        used[worst] = True


def _distinct(losses: Array) -> Array:
    """The rows that say something, each once."""
    return np.asarray(np.unique(losses[np.abs(losses).max(axis=1, initial=0.0) > SAME], axis=0))
