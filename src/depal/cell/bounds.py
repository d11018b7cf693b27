"""What the arm may not exceed now: the tightest of what runs on it and of who is near."""

import math
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Final

from depal.errors import Problem, TaskError
from depal.executive.checking import check_quantities
from depal.executive.limits import Limits
from depal.executive.runtime import Context
from depal.executive.schema import Repository
from depal.ports import Override

SPEED, PAYLOAD = "speed", "payload"

QUANTITIES: Final[Mapping[str, str]] = {SPEED: "m/s", PAYLOAD: "kg"}
"""What tasks may limit, and in which SI unit: the speed of flange and tool, and the mass of a box
that is lifted."""


def refuse_unknown(tasks: Repository) -> None:
    """Tasks may limit only what is kept.

    Raises:
        TaskError: another quantity, or a unit of another one.
    """
    found = list(check_quantities(tasks, QUANTITIES))
    if found:
        raise TaskError(
            "limits", [Problem(one.where, one.what, exists=one.exists) for one in found]
        )


class Bounds:
    """Limits of running actions, handed to the override of the arm."""

    def __init__(self, override: Override) -> None:
        """Nothing is limited; the override has not been told so yet."""
        self._override = override
        self._running: dict[int, Callable[[], Limits]] = {}
        self._most = math.inf
        self._told: float | None = None

    def most(self, quantity: str) -> float:
        """The least limit of what runs on the arm now [SI]; infinite where there is none."""
        return min(
            (limits()[quantity] for limits in self._running.values() if quantity in limits()),
            default=math.inf,
        )

    @property
    def speed(self) -> float:
        """What motions are planned for: the limit of the tasks, whoever stands there now [m/s]."""
        return self.most(SPEED)

    @contextmanager
    def under(self, context: Context) -> Iterator[None]:
        """While an action runs on the arm its limits count."""
        self._running[context.attempt] = context.limits
        self.refresh()
        try:
            yield
        finally:
            self._running.pop(context.attempt, None)
            self.refresh()

    def hold_below(self, speed: float) -> None:
        """Whatever runs, the arm is no faster than this [m/s]; 0 lets it stand on its path."""
        self._most = speed
        self.refresh()

    def refresh(self) -> None:
        """The facts may be others: the override is told what counts now."""
        speed = min(self._most, self.speed)
        if speed != self._told:
            self._told = speed
            self._override.limit(speed)
