"""Random numbers one by one, drawn in blocks."""

from collections.abc import Callable, Iterator

import numpy as np

Draw = Callable[[], float]
"""The next number, uniform in [0, 1)."""

BLOCK = 128
"""How many numbers are drawn at a time: about what one pallet needs."""


def uniforms(rng: np.random.Generator) -> Draw:
    """Draws from a generator, a block at a time: it advances by whole blocks."""
    return _uniforms(rng).__next__


def _uniforms(rng: np.random.Generator) -> Iterator[float]:
    while True:
        yield from rng.random(BLOCK).tolist()


def dealt(draw: Draw, count: int, parts: int, most: int) -> list[int]:
    """Deals things over parts at random: one to each, every other one to any that is not full.

    Args:
        draw: random numbers.
        count: how many things, at least `parts` and at most `parts * most`.
        parts: how many parts.
        most: how many things a part can hold.

    Returns:
        How many things each part got, `parts` numbers in 1..most that sum to `count`.
    """
    shares = [1] * parts
    for _ in range(count - parts):
        free = [part for part in range(parts) if shares[part] < most]
        shares[free[int(draw() * len(free))]] += 1
    return shares
