"""One measured figure beside its target."""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from statistics import median
from typing import Literal


@dataclass(frozen=True, slots=True)
class Figure:
    """What `depal bench` prints a line of.

    Attributes:
        name: what was measured.
        value: the median of the repetitions.
        unit: of value, target and peer.
        target: what it should reach.
        better: whether lower or higher values are better.
        n: how many repetitions.
        peer: another implementation's value in the same run, or None.
    """

    name: str
    value: float
    unit: str
    target: float
    better: Literal["lower", "higher"]
    n: int
    peer: float | None = None

    @property
    def met(self) -> bool:
        """Whether the value reaches the target."""
        if math.isnan(self.value):
            return False
        return self.value <= self.target if self.better == "lower" else self.value >= self.target


def median_seconds(work: Callable[[], object], repetitions: int) -> float:
    """The median time of a call, after one call that is not counted [s]."""
    work()
    seconds = []
    for _ in range(repetitions):
        start = time.perf_counter()
        work()
        seconds.append(time.perf_counter() - start)
    return median(seconds)
