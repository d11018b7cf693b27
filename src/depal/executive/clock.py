"""Time, real or simulated: the executive asks a clock, never the machine."""

import asyncio
import selectors
import time
from collections.abc import Coroutine
from dataclasses import dataclass
from typing import Any, Protocol, Self, TypeVar

T = TypeVar("T")


class Clock(Protocol):
    """Seconds that only ever rise, across restarts too."""

    def now(self) -> float:
        """The time [s]."""
        ...


class RealClock:
    """Seconds since 1970, by the monotonic clock from the moment of its making on.

    A change of the machine's wall clock does not move it.
    """

    def __init__(self) -> None:
        """Reads the wall clock once."""
        self._offset = time.time() - time.monotonic()

    def now(self) -> float:
        """The time [s]."""
        return time.monotonic() + self._offset


class LoopClock:
    """The time of the running event loop; with a simulated loop, simulated time."""

    def now(self) -> float:
        """The time [s]."""
        return asyncio.get_running_loop().time()


class _JumpingSelector(selectors.DefaultSelector):
    """A selector that moves the loop's time on instead of waiting."""

    loop: "SimulatedLoop"

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        ready = super().select(0)
        if ready or timeout == 0:
            return ready
        if timeout is None:
            # Nothing is scheduled: only the world outside could go on, so wait for it.
            return super().select(None)
        self.loop.jump(timeout)
        return []


class SimulatedLoop(asyncio.SelectorEventLoop):
    """An event loop whose time jumps to the next timer: a day of waiting takes no time."""

    def __init__(self, start: float = 0.0) -> None:
        """Begins at `start` [s]."""
        self._simulated = start
        selector = _JumpingSelector()
        selector.loop = self
        super().__init__(selector)

    def time(self) -> float:
        """The simulated time [s]."""
        return self._simulated

    def jump(self, seconds: float) -> None:
        """Moves the time on."""
        self._simulated += seconds


def run_simulated(work: Coroutine[Any, Any, T], start: float = 0.0) -> T:
    """Runs a coroutine to its end in simulated time.

    Args:
        work: everything that waits in it waits on the loop's time.
        start: the time at the beginning [s].

    Returns:
        What the coroutine returns.
    """
    with asyncio.Runner(loop_factory=lambda: SimulatedLoop(start)) as runner:
        return runner.run(work)


@dataclass(frozen=True, slots=True)
class Pace:
    """How the time of an event loop follows the machine's monotonic clock.

    Attributes:
        rate: seconds of the loop per second of the machine.
        start: the loop's time at the origin [s].
        origin: of the monotonic clock [s], which all processes of a machine share.
    """

    rate: float = 1.0
    start: float = 0.0
    origin: float = 0.0

    @classmethod
    def from_now(cls, rate: float = 1.0, start: float = 0.0) -> Self:
        """Begins now."""
        return cls(rate, start, time.monotonic())

    def now(self) -> float:
        """The loop's time [s]."""
        return self.start + (time.monotonic() - self.origin) * self.rate


class _PacedSelector(selectors.DefaultSelector):
    """A selector that waits by the machine's time for what is due by the loop's."""

    rate = 1.0

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        return super().select(None if timeout is None else timeout / self.rate)


class PacedLoop(asyncio.SelectorEventLoop):
    """An event loop whose time runs faster or slower than the machine's, and goes on elsewhere.

    Attributes:
        pace: that it follows.
        lag: how far its time is behind its pace [s]: what could not be computed in time. Setting
            it never turns time back; time stands still instead.
    """

    def __init__(self, pace: Pace) -> None:
        """At this pace."""
        self.pace = pace
        self._last = pace.start
        self.lag = 0.0
        selector = _PacedSelector()
        selector.rate = pace.rate
        super().__init__(selector)

    def time(self) -> float:
        """The time [s]."""
        self._last = max(self._last, self.pace.now() - self.lag)
        return self._last


def run_paced(work: Coroutine[Any, Any, T], pace: Pace) -> T:
    """Runs a coroutine to its end in time at a pace.

    Args:
        work: everything that waits in it waits on the loop's time.
        pace: of that time.

    Returns:
        What the coroutine returns.
    """
    with asyncio.Runner(loop_factory=lambda: PacedLoop(pace)) as runner:
        return runner.run(work)
