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


@dataclass(frozen=True, slots=True)
class Share:
    """How often something was so.

    Attributes:
        count: how often.
        of: out of how many.
    """

    count: int = 0
    of: int = 0

    def __add__(self, other: "Share") -> "Share":
        """Both together."""
        return Share(self.count + other.count, self.of + other.of)

    @property
    def value(self) -> float:
        """In [0, 1]; NaN out of none."""
        return self.count / self.of if self.of else math.nan

    @property
    def ci95(self) -> tuple[float, float]:
        """The 95 % interval (Wilson 1927); from 0 to 1 out of none."""
        if not self.of:
            return 0.0, 1.0
        square = _NORMAL_95**2 / self.of
        middle = (self.value + square / 2) / (1 + square)
        spread = self.value * (1 - self.value) / self.of + square / self.of / 4
        reach = _NORMAL_95 * math.sqrt(spread) / (1 + square)
        low = 0.0 if self.count == 0 else middle - reach
        high = 1.0 if self.count == self.of else middle + reach
        return low, high
