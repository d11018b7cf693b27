"""Independent parts, computed side by side in threads: kernels and filters let go of the lock."""

from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

T = TypeVar("T")
R = TypeVar("R")

ABREAST = 2
"""So many parts at once: a look has two cameras and two rasters, and a small machine two cores."""


def abreast(function: Callable[[T], R], parts: Iterable[T]) -> list[R]:
    """A function of each part, in the order of the parts, whichever is ready first.

    The threads live no longer than the call, so that a process may be forked at any other time.

    Args:
        function: pure, so that the result is that of one part after the other.
        parts: of a whole, such as the cameras of a look.
    """
    every = list(parts)
    if len(every) < ABREAST:
        return [function(part) for part in every]
    with ThreadPoolExecutor(ABREAST) as threads:
        return list(threads.map(function, every))
