"""One measured figure beside its target."""

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from statistics import median
from typing import Literal


@dataclass(frozen=True, slots=True)
class Peer:
    """Another implementation's value in the same run.

    Attributes:
        name: of the implementation.
        value: in the figure's unit.
    """

    name: str
    value: float


@dataclass(frozen=True, slots=True)
class Figure:
    """What `depal bench` prints a line of.

    Attributes:
        name: what was measured.
        value: the median of the repetitions.
        unit: of value, target and peers.
        target: what it should reach; nan where it only stands beside its peers.
        better: whether lower or higher values are better.
        n: how many repetitions.
        peers: others at the same work, where they are installed.
    """

    name: str
    value: float
    unit: str
    target: float
    better: Literal["lower", "higher"]
    n: int
    peers: tuple[Peer, ...] = ()

    @property
    def peer(self) -> float | None:
        """The first peer's value; None where there is none."""
        return self.peers[0].value if self.peers else None

    @property
    def met(self) -> bool:
        """Whether the value reaches the target, where there is one."""
        if math.isnan(self.value):
            return False
        if math.isnan(self.target):
            return True
        return self.value <= self.target if self.better == "lower" else self.value >= self.target


def peers_of(seconds: Mapping[str, float | None], scale: float) -> tuple[Peer, ...]:
    """The peers that are installed.

    Args:
        seconds: by name; None where one is not installed.
        scale: the figure's units in a second.
    """
    return tuple(Peer(name, scale * s) for name, s in seconds.items() if s is not None)


def median_seconds(work: Callable[[], object], repetitions: int) -> float:
    """The median time of a call, after one call that is not counted [s]."""
    work()
    seconds = []
    for _ in range(repetitions):
        start = time.perf_counter()
        work()
        seconds.append(time.perf_counter() - start)
    return median(seconds)
