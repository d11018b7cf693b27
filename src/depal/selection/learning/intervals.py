"""Intervals of weights: by Fisher's information, by the profile likelihood, by a region.

The interval of a share of weights is that of the normal approximation: its gradient by theta,
through the inverse of Fisher's information (the delta method). Where a weight is known from one
side only, it is that of the profile likelihood: all values at which the most likely other weights
lose less than half the 95 % quantile of chi-square with one degree of freedom. Choices without
noise bound a region of rules; there the interval is what the region spans.
"""

import math

import numpy as np
import numpy.typing as npt

from depal.selection.learning.choices import PARTS, Choices
from depal.selection.learning.consistent import extremes
from depal.selection.learning.fit import most_likely
from depal.selection.learning.learned import Estimate
from depal.selection.learning.likelihood import likelihood

Array = npt.NDArray[np.float64]

COLUMNS = len(PARTS)
ALL, OF_H = np.ones(COLUMNS), np.array([0.0, 1.0, 1.0, 1.0])

NORMAL_95 = 1.959964
PROFILE_95 = NORMAL_95**2 / 2

RANK = 1e-9
"""What is smaller than this share of the greatest eigenvalue is no information."""

_BISECTIONS = 24

Shares = dict[str, Estimate]


def _measures() -> dict[str, tuple[Array, Array]]:
    """Each weight as measured . theta / whole . theta."""
    unit = np.eye(COLUMNS)
    return {part: (unit[row], ALL if row == 0 else OF_H) for row, part in enumerate(PARTS)}


def is_open(open_ways: Array, measured: Array) -> bool:
    """Whether a sum of weights changes along a direction that nothing is known of."""
    return bool(len(open_ways) and np.abs(open_ways @ measured).max() > math.sqrt(RANK))


def by_information(choices: Choices, theta: Array, open_ways: Array) -> tuple[Shares, Estimate]:
    """Intervals by Fisher's information and the delta method."""
    information = likelihood(choices, theta).information
    spread = np.asarray(np.linalg.pinv(information, rcond=RANK, hermitian=True), dtype=float)
    shares: Shares = {}
    for part, (measured, whole) in _measures().items():
        total = float(whole @ theta)
        if total <= 0 or is_open(open_ways, measured) or is_open(open_ways, whole):
            shares[part] = Estimate.unknown()
            continue
        value = float(measured @ theta) / total
        gradient = (measured - value * whole) / total
        reach = NORMAL_95 * _deviation(gradient, spread)
        shares[part] = Estimate(value, max(0.0, value - reach), min(1.0, value + reach))
    return shares, _temperature(theta, spread, shares["requests"].known)


def _deviation(gradient: Array, spread: Array) -> float:
    """The standard deviation of a sum whose weights have this covariance."""
    return math.sqrt(max(0.0, float(gradient @ spread @ gradient)))


def _temperature(theta: Array, spread: Array, w_known: bool) -> Estimate:  # noqa: FBT001
    """T, or T / (1 - w) where w is unknown; its interval by that of 1 / T."""
    whole = ALL if w_known else OF_H
    total = float(whole @ theta)
    if total <= 0:
        return Estimate(math.inf, 0.0, math.inf)
    reach = NORMAL_95 * _deviation(whole, spread)
    high = 1 / (total - reach) if total > reach else math.inf
    return Estimate(1 / total, 1 / (total + reach), high)


def one_sided(
    choices: Choices, pushed: npt.NDArray[np.bool_], theta: Array, open_ways: Array
) -> tuple[Shares, Estimate]:
    """Profile intervals, as far as the likelihood has no peak; theta is far out on its ridge."""
    best = likelihood(choices, theta).value
    shares, temperature = by_information(choices, theta, open_ways)
    for part, (measured, whole) in _measures().items():
        if shares[part].known and pushed[whole > 0].any():
            value = float(measured @ theta / (whole @ theta))
            shares[part] = _profile(choices, measured, whole, value, best)
    return shares, Estimate(temperature.value, 0.0, temperature.high)


def _profile(
    choices: Choices, measured: Array, whole: Array, value: float, best: float
) -> Estimate:
    """All values of a share at which the other weights lose little."""

    def lost(share: float) -> float:
        return best - _at_share(choices, measured, whole, share)

    ends = []
    for end in (0.0, 1.0):
        outside, inside = end, value
        if lost(end) <= PROFILE_95:
            ends.append(end)
            continue
        for _ in range(_BISECTIONS):
            middle = (outside + inside) / 2
            if lost(middle) > PROFILE_95:
                outside = middle
            else:
                inside = middle
        ends.append(inside)
    return Estimate(value, min(ends), max(ends))


def _at_share(choices: Choices, measured: Array, whole: Array, share: float) -> float:
    """The greatest log-likelihood with measured . theta = share * whole . theta."""
    row = int(np.argmax(measured))
    others = whole - measured
    # theta_row follows from the others: share / (1 - share) of their sum.
    mix = np.delete(np.eye(COLUMNS), row, axis=0)
    if share < 1.0:
        mix[:, row] = share / (1.0 - share) * np.delete(others, row)
    else:
        mix = mix[np.delete(others, row) == 0]
        mix = np.vstack((mix, measured))
    scale = np.abs(mix).max(axis=1, keepdims=True)
    return most_likely(choices.seen_as(mix / scale), len(mix))[1].value


def by_region(choices: Choices, rule: Array, open_ways: Array) -> Shares:
    """The weights of all rules that agree with every choice, and of one in their middle."""
    losses = choices.losses
    ends = {
        part: extremes(losses, measured, whole)
        for part, (measured, whole) in _measures().items()
        if not (is_open(open_ways, measured) or is_open(open_ways, whole))
    }
    corners = [rule] + [corner for pair in ends.values() if pair is not None for corner in pair]
    middle = np.mean(corners, axis=0)
    shares: Shares = {}
    for part, (measured, whole) in _measures().items():
        pair = ends.get(part)
        if pair is None or not whole @ middle > 0:
            shares[part] = Estimate.unknown()
            continue
        low, value, high = (
            float(measured @ theta) / float(whole @ theta) for theta in (pair[0], middle, pair[1])
        )
        shares[part] = Estimate(value, low, high)
    return shares


def coolest(choices: Choices, theta: Array) -> Estimate:
    """The temperatures at which choices without noise are still likely: 0 up to the estimate."""
    low, high = 0.0, float(theta.sum())
    for _ in range(2 * _BISECTIONS):
        middle = (low + high) / 2
        if likelihood(choices, theta / theta.sum() * middle).value > -PROFILE_95:
            high = middle
        else:
            low = middle
    return Estimate(0.0, 0.0, 1 / high)
