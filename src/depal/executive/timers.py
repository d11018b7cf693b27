"""What waits for time, soonest first."""

import heapq
from collections.abc import Callable, Iterator
from typing import Generic, TypeVar

T = TypeVar("T")

ROOM = 64
"""So many timers there may be before the stale ones are swept out."""


class Timers(Generic[T]):
    """A queue of things that wait for a moment.

    A timer is never taken back: one that has lost its meaning is dropped when it comes up.
    """

    def __init__(self, is_stale: Callable[[float, T], bool]) -> None:
        """Nothing waits.

        Args:
            is_stale: whether a timer, by its moment [s] and its thing, has lost its meaning.
        """
        self._is_stale = is_stale
        self._queue: list[tuple[float, int, T]] = []
        self._count = 0
        self._room = ROOM

    def set(self, at: float, what: T) -> None:
        """Something waits until `at` [s]."""
        self._count += 1
        heapq.heappush(self._queue, (at, self._count, what))
        if len(self._queue) > self._room:
            # Stale timers would keep what they waited for alive.
            self._queue = [entry for entry in self._queue if not self._is_stale(entry[0], entry[2])]
            heapq.heapify(self._queue)
            self._room = max(ROOM, 2 * len(self._queue))

    def next(self) -> float | None:
        """The moment of the soonest [s], None where nothing waits."""
        queue = self._queue
        while queue and self._is_stale(queue[0][0], queue[0][2]):
            heapq.heappop(queue)
        return queue[0][0] if queue else None

    def any_due(self, now: float) -> bool:
        """Whether a moment has come."""
        if not self._queue or self._queue[0][0] > now:
            return False
        soonest = self.next()
        return soonest is not None and soonest <= now

    def due(self, now: float) -> Iterator[T]:
        """Takes out everything whose moment has come, soonest first."""
        while self._queue and self._queue[0][0] <= now:
            at, _, what = heapq.heappop(self._queue)
            if not self._is_stale(at, what):
                yield what
