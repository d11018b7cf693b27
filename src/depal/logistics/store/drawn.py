"""Requests drawn at random, for studies."""

import numpy as np

from depal.domain import Delivery, Request

SECONDS_PER_BOX = 8.0
"""How long a box takes at 450 boxes an hour [s]."""


def random_requests(
    delivery: Delivery, count: int = 3, seed: int = 0, *, horizon: float | None = None
) -> tuple[Request, ...]:
    """Product requests at random times with random priorities, each with a case of its own.

    Args:
        delivery: whose products are wanted.
        count: how many; not more than there are cases.
        seed: chooses all of it.
        horizon: they come from 0 to this time [s]; None for half the time that the delivery
            takes.

    Returns:
        The requests in the order in which they come.
    """
    rng = np.random.default_rng([seed, len(delivery.boxes)])
    boxes = delivery.boxes
    end = 0.5 * SECONDS_PER_BOX * len(boxes) if horizon is None else horizon
    wanted = rng.choice(len(boxes), size=min(count, len(boxes)), replace=False)
    times = np.sort(rng.uniform(0.0, end, size=len(wanted))).round(1)
    priorities = rng.uniform(0.05, 1.0, size=len(wanted)).round(2)
    return tuple(
        Request(priority=priority, gtin=boxes[number].product.gtin, arrived=time)
        for number, time, priority in zip(
            wanted.tolist(), times.tolist(), priorities.tolist(), strict=True
        )
    )
