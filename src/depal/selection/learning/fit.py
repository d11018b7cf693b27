"""The weights that explain choices best: Newton's method with weights that are not negative.

The projected method of Bertsekas ("Projected Newton methods for optimization problems with
simple constraints", 1982): weights at zero that would become negative rest, the others take a
Newton step along which the likelihood must rise. It ends by counting, never by a clock.
"""

import numpy as np
import numpy.typing as npt

from depal.selection.learning.choices import Choices
from depal.selection.learning.likelihood import Likelihood, likelihood

Array = npt.NDArray[np.float64]

STEPS, HALVINGS = 60, 40
"""Newton steps, and halvings of one step, at the most."""

GAIN = 1e-10
"""A step that would raise the log-likelihood by less than this is the last one."""

DAMPING = 1e-9
"""Of the information's trace: keeps a step finite along what the choices do not tell."""


def most_likely(choices: Choices, columns: int) -> tuple[Array, Likelihood]:
    """The theta >= 0 that makes the choices most likely.

    Where no finite theta does, as where choices have no noise, theta is large and the
    log-likelihood as near to its limit as counts.

    Args:
        choices: with that many features.
        columns: how many.

    Returns:
        (columns,) theta, and the log-likelihood there.
    """
    theta = np.zeros(columns)
    now = likelihood(choices, theta)
    for _ in range(STEPS):
        step = _newton_step(now, theta)
        higher = climbed(choices, theta, now, step) if float(step @ now.gradient) > GAIN else None
        if higher is None:
            break
        theta, now = higher
    return theta, now


def climbed(
    choices: Choices, theta: Array, now: Likelihood, step: Array
) -> tuple[Array, Likelihood] | None:
    """Where the likelihood is higher along a step, or None where nowhere.

    Args:
        choices: whose likelihood it is.
        theta: (columns,) where the step begins.
        now: the likelihood there.
        step: (columns,) halved until the likelihood rises; what becomes negative is 0.
    """
    for halvings in range(HALVINGS):
        tried = np.maximum(theta + step / 2**halvings, 0.0)
        there = likelihood(choices, tried)
        if there.value > now.value:
            return tried, there
    return None


def _newton_step(now: Likelihood, theta: Array) -> Array:
    """(columns,) where the weights should go; zero for those that rest at zero."""
    free = (theta > 0) | (now.gradient > 0)
    while True:
        step = np.zeros(len(theta))
        information = now.information[np.ix_(free, free)]
        damped = information + (DAMPING * np.trace(information) + GAIN) * np.eye(len(information))
        step[free] = np.linalg.solve(damped, now.gradient[free])
        leaving = (theta == 0) & (step < 0)
        if not leaving.any():
            return step
        free &= ~leaving
