"""What the arm may not exceed now: the tightest of what runs on it and of who is near."""

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from depal.cell.quantities import SPEED
from depal.cell.rules import Rules
from depal.executive.limits import Limits
from depal.executive.runtime import Context
from depal.executive.schema import Cancel
from depal.ports import Override

TIGHTER = "the tasks now let a held box lean less, or keep out of another zone"
"""Why a motion is broken off that was planned before."""


class Bounds:
    """Limits of running actions: handed to the override of the arm, and to motions under way."""

    def __init__(self, override: Override) -> None:
        """Nothing is limited; the override has not been told so yet."""
        self._override = override
        self._running: dict[int, Callable[[], Limits]] = {}
        self._begun: dict[int, tuple[Context, Rules]] = {}
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

    @property
    def zones(self) -> frozenset[str]:
        """What nothing on the arm may enter now."""
        avoided = (context.avoids() for context, _ in self._begun.values())
        return frozenset().union(*avoided)

    @contextmanager
    def under(self, context: Context) -> Iterator[None]:
        """While an action runs on the arm its limits count."""
        self._running[context.attempt] = context.limits
        self._begun[context.attempt] = context, _rules(context)
        self.refresh()
        try:
            yield
        finally:
            self._running.pop(context.attempt, None)
            self._begun.pop(context.attempt, None)
            self.refresh()

    def hold_below(self, speed: float) -> None:
        """Whatever runs, the arm is no faster than this [m/s]; 0 lets it stand on its path."""
        self._most = speed
        self.refresh()

    def refresh(self) -> None:
        """The facts may be others: the override is told what counts now.

        A motion whose rules have become tighter is broken off at its checkpoint, and planned anew.
        """
        for context, rules in self._begun.values():
            breaks = context.action.cancel is Cancel.AT_CHECKPOINT
            if breaks and context.stop_reason is None and not rules.cover(_rules(context)):
                context.stop_reason = TIGHTER
        speed = min(self._most, self.speed)
        if speed != self._told:
            self._told = speed
            self._override.limit(speed)


def _rules(context: Context) -> Rules:
    """What binds a running action now."""
    return Rules.of(context.limits(), context.avoids())
