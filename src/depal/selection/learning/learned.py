"""What choices tell of a policy: w, the weights of h, the temperature, each with an interval."""

from dataclasses import dataclass
from enum import Enum

import numpy as np
import numpy.typing as npt

from depal.selection.learning.choices import Choices
from depal.selection.score import PositionWeights

Array = npt.NDArray[np.float64]


class Finding(Enum):
    """What kind of answer the choices give."""

    ESTIMATED = "estimated"
    NOISELESS = "the choices have no noise: a region of weights, not a point"
    ONE_SIDED = "some weights are known from one side only"
    SILENT = "the choices tell nothing of the weights"


@dataclass(frozen=True, slots=True)
class Estimate:
    """A number and its 95 % interval.

    Attributes:
        value: the most likely one; NaN where nothing is known of it.
        low: the lower end.
        high: the upper end.
    """

    value: float
    low: float
    high: float

    @classmethod
    def unknown(cls) -> "Estimate":
        """A share of which nothing is known."""
        return cls(float("nan"), 0.0, 1.0)

    @property
    def known(self) -> bool:
        """Whether anything is known of it."""
        return not np.isnan(self.value)

    def holds(self, value: float) -> bool:
        """Whether a value lies in the interval."""
        return self.low <= value <= self.high


@dataclass(frozen=True, slots=True)
class Learned:
    """What was learned.

    Attributes:
        finding: what kind of answer it is.
        w: the share of the requests in s(b), Eq. (3).
        side: the weight of |y| in h, Eq. (1).
        depth: the weight of x_max - x.
        height: the weight of z; the three add up to 1.
        temperature: T [m]; where w is unknown T / (1 - w).
        theta: (4,) the most likely (w, (1 - w) a) / T [1/m].
        log_likelihood: of the choices at theta.
        by_chance: the same where every box that could be taken was as likely.
        choices: how many there are.
        pallets: how many pallets they were made at.
        notes: what cannot be known from these choices, in words.
    """

    finding: Finding
    w: Estimate
    side: Estimate
    depth: Estimate
    height: Estimate
    temperature: Estimate
    theta: tuple[float, float, float, float]
    log_likelihood: float
    by_chance: float
    choices: int
    pallets: int
    notes: tuple[str, ...]

    @property
    def weights(self) -> PositionWeights | None:
        """The weights of h, for a ScoreRule; None where one of them is unknown."""
        parts = [self.side.value, self.depth.value, self.height.value]
        total = sum(parts)
        if not total > 0:
            return None
        side, depth, height = (part / total for part in parts)
        return PositionWeights(side, depth, height)


def by_chance(choices: Choices) -> float:
    """The log-likelihood of choices that weigh nothing."""
    return -float(np.log(choices.counts).sum())
