"""Means with their uncertainty."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

_NORMAL_95 = 1.959964


@dataclass(frozen=True, slots=True)
class Sample:
    """A mean and what is known about it.

    Attributes:
        mean: of the sample.
        std: population standard deviation.
        n: the sample's size.
    """

    mean: float
    std: float
    n: int

    @classmethod
    def of(cls, values: npt.ArrayLike) -> "Sample":
        """The summary of a sequence of numbers, (n,); an empty one has mean and deviation NaN."""
        array = np.asarray(values, dtype=float)
        if not len(array):
            return cls(math.nan, math.nan, 0)
        return cls(float(array.mean()), float(array.std()), len(array))

    @property
    def error(self) -> float:
        """The standard error of the mean; NaN where one value or none says nothing of it."""
        return self.std / math.sqrt(self.n) if self.n > 1 else math.nan

    @property
    def ci95(self) -> tuple[float, float]:
        """The 95 % interval of the mean, by the normal approximation."""
        reach = _NORMAL_95 * self.error
        return self.mean - reach, self.mean + reach
