"""What is watched while the arm moves."""

from collections.abc import Callable
from dataclasses import dataclass, field

from depal.executive.runtime import Context
from depal.ports import LOST, Arm, Gripper, Guard, Safety, Watch

KEPT = 0.5
"""A module whose vacuum falls below this share of what it was has lost its hold."""

PRESSING = 2.0
"""Where something carries so much of the tool it touches it [kg]."""

TOUCHED = 0.6
"""The share of a box's weight that still hangs on the arm when it counts as standing."""


@dataclass(frozen=True, slots=True)
class Watching:
    """A guard of two parts: what the robot's own controller watches, and what only we know.

    Attributes:
        arm: whose flange is weighed.
        gripper: whose vacuum counts.
        watch: by the sensors.
        more: further reasons to stop.
    """

    arm: Arm
    gripper: Gripper
    watch: Watch
    more: tuple[Callable[[], str | None], ...] = field(default=())

    def __call__(self) -> str | None:
        """A reason to stop, or None."""
        sensed = self.watch.reason(self.gripper.vacuum(), self.arm.load)
        return sensed if sensed is not None else self.asked()

    def asked(self) -> str | None:
        """The reasons that no sensor knows."""
        return next((reason for ask in self.more if (reason := ask()) is not None), None)


class Guards:
    """Reasons to stop, asked in every control period."""

    def __init__(self, arm: Arm, gripper: Gripper, safety: Safety) -> None:
        """Reads these sensors."""
        self._arm = arm
        self._gripper = gripper
        self._safety = safety

    def asked_to_stop(self, context: Context) -> Guard:
        """The executive wants this motion to end."""
        return lambda: context.stop_reason

    def holding(self, *more: Callable[[], str | None], until: float | None = None) -> Guard:
        """The vacuum breaks.

        Args:
            more: further reasons to stop.
            until: below this load a box that is set down stands [kg].
        """
        before = self._gripper.vacuum()
        if not any(before.values()):  # it broke while nobody watched: at rest, between motions
            return lambda: LOST
        least = tuple((name, KEPT * value) for name, value in before.items() if value > 0.0)
        return Watching(self._arm, self._gripper, Watch(least, until), more)

    def touching(self, *more: Callable[[], str | None]) -> Guard:
        """An empty tool presses on something.

        Args:
            more: further reasons to stop.
        """
        return Watching(self._arm, self._gripper, Watch(load=-PRESSING), more)

    def setting_down(self, mass: float) -> Guard:
        """The vacuum breaks, or the box that is being set down no longer hangs on the arm."""
        return self.holding(until=TOUCHED * mass)
