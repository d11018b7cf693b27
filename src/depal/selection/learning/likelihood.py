"""How well weights explain choices: the conditional logit model.

A box is chosen with a probability that grows with its score, P(b) ~ exp(s(b) / T), at a
temperature T in the score's unit [m]: at T -> 0 the best is always taken, at T -> infinity any
box is as likely. With theta = (w, (1 - w) a) / T the exponent theta . (l, |y|, x_max - x, z) is
linear, so the log-likelihood is concave and has one maximum (McFadden, "Conditional logit
analysis of qualitative choice behavior", 1974).
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.selection.learning.choices import Choices

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Likelihood:
    """The log-likelihood at some theta, with its derivatives.

    Attributes:
        value: the logarithm of the probability of all choices.
        gradient: (columns,).
        information: (columns, columns) minus the second derivatives: Fisher's information.
    """

    value: float
    gradient: Array
    information: Array


def likelihood(choices: Choices, theta: Array) -> Likelihood:
    """The log-likelihood of choices.

    Args:
        choices: with as many features as theta has entries; may be empty.
        theta: (columns,) the weight of each feature, over the temperature.
    """
    columns = len(theta)
    if not len(choices):
        return Likelihood(0.0, np.zeros(columns), np.zeros((columns, columns)))
    chances = probabilities(choices, theta)
    features, starts = choices.features, choices.starts
    weighted = features * chances[:, None]
    means = np.add.reduceat(weighted, starts)
    value = float(np.log(np.maximum(chances[choices.chosen], np.finfo(float).tiny)).sum())
    gradient = features[choices.chosen].sum(axis=0) - means.sum(axis=0)
    information = weighted.T @ features - means.T @ means
    return Likelihood(value, gradient, information)


def probabilities(choices: Choices, theta: Array) -> Array:
    """(n,) how likely each box was to be taken, among those of its choice."""
    utility = choices.features @ theta
    counts = choices.counts
    best = np.maximum.reduceat(utility, choices.starts)
    weight = np.exp(utility - np.repeat(best, counts))
    total = np.add.reduceat(weight, choices.starts)
    return np.asarray(weight / np.repeat(total, counts))
