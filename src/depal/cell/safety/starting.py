"""Never a start without good safety inputs."""

import asyncio
from dataclasses import dataclass

from depal.cell.safety.judging import heard, judged
from depal.cell.timekeeping import WAITING, Timekeeper
from depal.domain import Joints
from depal.errors import DeviceError
from depal.executive.clock import Clock
from depal.ports import Arm, Guard, Safety, Trajectory

LOOKING = 0.1
"""While nothing may move the inputs are read so often [s]."""


@dataclass(frozen=True, slots=True)
class CautiousArm:
    """An arm that begins no motion unless the safety inputs are there, fresh and clear.

    It waits for what ends by itself: somebody who leaves the protective field, inputs that are
    heard again. A stop is an error, and whoever is told of it decides how that ends.

    Attributes:
        arm: behind it.
        safety: the inputs; they are only read.
        clock: of the cell.
        times: told how long people were waited for.
    """

    arm: Arm
    safety: Safety
    clock: Clock
    times: Timekeeper

    def joints(self) -> Joints:
        """Where the axes are [rad]."""
        return self.arm.joints()

    def load(self) -> float:
        """What hangs on the flange [kg]."""
        return self.arm.load()

    async def follow(self, trajectory: Trajectory, guard: Guard | None = None) -> str | None:
        """Moves along a trajectory as soon as that is safe.

        Returns:
            As the arm does; the guard's reason too where that came before the motion began.

        Raises:
            DeviceError: as the arm does; a stop is active, or the gate is open.
        """
        reason = await self._clear(guard)
        return await self.arm.follow(trajectory, guard) if reason is None else reason

    async def _clear(self, guard: Guard | None) -> str | None:
        while True:
            judgement = judged(heard(self.safety), self.clock.now())
            if judgement.tripped:
                raise DeviceError(f"the arm cannot move: {judgement.reason}")
            if judgement.may_move:
                return None
            reason = guard() if guard is not None else None
            if reason is not None:
                return reason
            with self.times.during(WAITING):
                await asyncio.sleep(LOOKING)
