"""The simulated safety controller."""

from collections.abc import Callable
from dataclasses import dataclass

from depal.ports import SafetyState


@dataclass(frozen=True, slots=True)
class Visit:
    """Somebody walks up to the cell, stands before the arm, and leaves again.

    Attributes:
        came: when they came into the warning field [s].
        lasts: until they have left it [s].
        inside: whether they go on into the protective field, for the middle third of that time.
    """

    came: float
    lasts: float
    inside: bool = True

    def fields_at(self, now: float) -> tuple[bool, bool]:
        """Whether they stand in the warning field, and in the protective field."""
        share = (now - self.came) / self.lasts
        return 0.0 <= share < 1.0, self.inside and 1 / 3 <= share < 2 / 3


class SimulatedSafety:
    """A safety controller with a laser scanner; tests and faults trip it.

    Attributes:
        stopped: an emergency stop or a protective stop is active.
        gate_open: somebody may be inside.
        near: somebody stays in the warning field.
        inside: somebody stays in the protective field.
        visits: those who come and go by themselves.
    """

    def __init__(self, now: Callable[[], float] = lambda: 0.0) -> None:
        """All is well; `now` tells the time [s]."""
        self._now = now
        self.stopped = False
        self.gate_open = False
        self.near = False
        self.inside = False
        self.visits: list[Visit] = []

    def state(self) -> SafetyState:
        """What it says now."""
        near, inside = self.near or self.inside, self.inside
        if self.visits:
            now = self._now()
            for visit in self.visits:
                walks, stands = visit.fields_at(now)
                near, inside = near or walks, inside or stands
        return SafetyState(self.stopped, self.gate_open, near, inside)
