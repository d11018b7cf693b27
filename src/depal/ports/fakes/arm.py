"""An arm that is always where its trajectory says."""

import asyncio
from collections.abc import Callable
from dataclasses import dataclass, field

from depal.domain import Joints
from depal.errors import DeviceError
from depal.ports.devices import Guard
from depal.ports.trajectory import Trajectory

NEAR = 0.02  # [rad] from where the axes stand to where a trajectory begins


@dataclass(slots=True)
class FakeArm:
    """Follows trajectories in the loop's time and asks the guard now and then.

    Attributes:
        at: where the axes are [rad].
        hanging: what hangs on the flange [kg].
        period: between two questions to the guard [s].
        refuses: the numbers of the motions that it refuses with a `DeviceError`; the first is 0.
        followed: every motion that it was told, in order.
    """

    at: Joints
    hanging: Callable[[], float] = lambda: 0.0
    period: float = 0.05
    refuses: frozenset[int] = frozenset()
    followed: list[Trajectory] = field(default_factory=list)
    moving: bool = False

    def joints(self) -> Joints:
        """Where the axes are [rad]."""
        return self.at

    def load(self) -> float:
        """What hangs on the flange [kg]."""
        return self.hanging()

    async def follow(self, trajectory: Trajectory, guard: Guard | None = None) -> str | None:
        """Moves; a reason of the guard leaves the arm where it is."""
        self.followed.append(trajectory)
        away = max(abs(a - b) for a, b in zip(trajectory.start, self.at, strict=True))
        if self.moving or away > NEAR or len(self.followed) - 1 in self.refuses:
            raise DeviceError(f"the arm cannot move (busy: {self.moving}, {away:.3f} rad away)")
        self.moving, time = True, 0.0
        try:
            while time < trajectory.duration:
                step = min(self.period, trajectory.duration - time)
                await asyncio.sleep(step)
                time += step
                a, b, c, d, e, f = trajectory.at(time)[0].tolist()
                self.at = (a, b, c, d, e, f)
                if guard is not None and (reason := guard()) is not None:
                    return reason
        finally:
            self.moving = False
        return None
