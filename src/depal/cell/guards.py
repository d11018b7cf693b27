"""What is watched while the arm moves."""

from collections.abc import Callable

from depal.executive.runtime import Context
from depal.ports import Arm, Gripper, Guard, Safety

LOST = "the vacuum broke: the box is lost"

KEPT = 0.5
"""A module whose vacuum falls below this share of what it was has lost its hold."""


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

    def holding(self, *more: Callable[[], str | None]) -> Guard:
        """The vacuum breaks."""
        before = self._gripper.vacuum()
        if not any(before.values()):  # it broke while nobody watched: at rest, between motions
            return lambda: LOST

        def guard() -> str | None:
            now = self._gripper.vacuum()
            if any(now[name] < KEPT * value for name, value in before.items() if value > 0.0):
                return LOST
            for other in more:
                reason = other()
                if reason is not None:
                    return reason
            return None

        return guard

    def touches_down(self, mass: float) -> Callable[[], str | None]:
        """The box that is being set down no longer hangs on the arm."""
        return lambda: "stands" if self._arm.load() < TOUCHED * mass else None


TOUCHED = 0.6
"""The share of a box's weight that still hangs on the arm when it counts as standing."""
