"""From choices to the weights of Eqs. (1) and (3).

theta = (w, (1 - w) a) / T, so w = theta_0 / sum, a = theta_f / sum_f, T = 1 / sum: what is most
likely for theta is for them. `intervals` says how far they are known.
"""

import math

import numpy as np
import numpy.typing as npt

from depal.selection.learning.choices import PARTS, Choices
from depal.selection.learning.consistent import SAME, STRICT, agreeing
from depal.selection.learning.fit import most_likely
from depal.selection.learning.intervals import (
    COLUMNS,
    RANK,
    Shares,
    by_information,
    by_region,
    coolest,
    is_open,
    one_sided,
)
from depal.selection.learning.learned import Estimate, Finding, Learned, by_chance
from depal.selection.learning.likelihood import likelihood

Array = npt.NDArray[np.float64]

TIES = 0.1
"""A rule that ties in more choices than this share does not explain them."""


def learn(choices: Choices) -> Learned:
    """The policy that makes choices most likely.

    Args:
        choices: with the four features of `PARTS`.

    Returns:
        The weights, and what cannot be known of them.
    """
    open_ways = _untold(choices)
    if len(open_ways) == COLUMNS:
        return _silent(choices)
    theta, _ = most_likely(choices, COLUMNS)
    rule = _noiseless(choices)
    if rule is not None:
        finding = Finding.NOISELESS
        shares, temperature = by_region(choices, rule, open_ways), coolest(choices, theta)
    elif (pushed := _pushed(choices)).any():
        finding = Finding.ONE_SIDED
        shares, temperature = one_sided(choices, pushed, theta, open_ways)
    else:
        finding = Finding.ESTIMATED
        shares, temperature = by_information(choices, theta, open_ways)
    return _summed_up(choices, finding, shares, temperature, theta, open_ways)


def _untold(choices: Choices) -> Array:
    """(k, 4) an orthonormal basis of the directions of theta that change no probability."""
    spread = likelihood(choices, np.zeros(COLUMNS)).information
    values, vectors = np.linalg.eigh(spread)
    floor = max(RANK * float(values.max(initial=0.0)), SAME**2)
    return np.asarray(vectors.T[values <= floor])


def _noiseless(choices: Choices) -> Array | None:
    """The one rule without noise that makes all choices, but for a few ties; None without one."""
    rule = agreeing(choices.losses)
    if rule is None:
        return None
    ties = choices.kept(choices.losses @ rule < STRICT)
    return rule if len(ties) <= TIES * len(choices) else None


def _pushed(choices: Choices) -> npt.NDArray[np.bool_]:
    """(4,) the weights that no choice speaks against, however strong they are.

    Boxes that such a rule always leaves say nothing more, and the rest is asked again (Geyer,
    "Likelihood inference in exponential families and directions of recession", 2009).
    """
    pushed = np.zeros(COLUMNS, np.bool_)
    while (rule := agreeing(choices.losses)) is not None:
        pushed |= rule > SAME
        choices = choices.kept(choices.losses @ rule < STRICT)
    return pushed


def _silent(choices: Choices) -> Learned:
    chance, nothing = by_chance(choices), Estimate.unknown()
    return Learned(
        Finding.SILENT,
        nothing,
        nothing,
        nothing,
        nothing,
        Estimate(math.nan, 0.0, math.inf),
        (0.0, 0.0, 0.0, 0.0),
        chance,
        chance,
        len(choices),
        len(np.unique(choices.pallets)),
        ("no step had two boxes that differ: nothing can be learned",),
    )


def _summed_up(
    choices: Choices,
    finding: Finding,
    shares: Shares,
    temperature: Estimate,
    theta: Array,
    open_ways: Array,
) -> Learned:
    return Learned(
        finding,
        shares["requests"],
        shares["side"],
        shares["depth"],
        shares["height"],
        temperature,
        (float(theta[0]), float(theta[1]), float(theta[2]), float(theta[3])),
        likelihood(choices, theta).value,
        by_chance(choices),
        len(choices),
        len(np.unique(choices.pallets)),
        tuple(_notes(finding, shares, theta, open_ways)),
    )


def _notes(finding: Finding, shares: Shares, theta: Array, open_ways: Array) -> list[str]:
    """What cannot be known, and why."""
    notes = []
    unit = np.eye(COLUMNS)
    silent = [p for row, p in enumerate(PARTS) if is_open(open_ways, unit[row])]
    if "requests" in silent:
        notes.append(
            "w is unknown: no request made a difference between boxes that could be taken; "
            "the temperature is T / (1 - w)"
        )
        silent.remove("requests")
    if silent:
        notes.append(
            f"the boxes never differed enough to tell the weight of {' from '.join(silent)}"
        )
    if finding is Finding.NOISELESS:
        notes.append(
            "every choice is what a rule without noise would do: the temperature is at its lower "
            "bound, and all weights in the intervals explain the choices as well"
        )
    if finding is Finding.ONE_SIDED:
        notes.append(
            "no choice speaks against some weights, however great they are: their intervals, by "
            "the profile likelihood, say all that is known"
        )
    if finding is Finding.ESTIMATED:
        at_zero = [p for row, p in enumerate(PARTS) if theta[row] == 0.0 and shares[p].known]
        notes += [f"the weight of {p} is at its bound of 0" for p in at_zero]
    return notes
