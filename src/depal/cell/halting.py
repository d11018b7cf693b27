"""An arm that has stopped where it should not have: nothing moves it until the task is through.

RELIABILITY's M5 to M7: after a safety stop, an error of the arm or a path that it has left the fact
`kr60.stopped` says why, and `restart_arm` of the task files does the rest: a person is asked, the
safety inputs must be good, the arm draws back. Then the action that it was in fails, and the
executive begins it anew.
"""

import asyncio
from contextlib import suppress
from dataclasses import dataclass, field

from depal.cell.workplace import FIRST, Workplace
from depal.domain import Joints
from depal.errors import DeviceError
from depal.executive.engine import Call
from depal.ports import Arm, Guard, Trajectory

RESTART, KR60 = "restart_arm", "kr60"

STOPPED, ABORTED = f"{KR60}.stopped", f"{KR60}.aborted"
"""The facts: why it stopped; whether the safety controller has stopped it."""


class HaltedError(DeviceError):
    """The arm stopped, a person has said start, and it has drawn back: plan anew."""


@dataclass(slots=True)
class HaltingArm:
    """An arm that goes on after a stop only when the task `restart_arm` has let it.

    Attributes:
        arm: behind it.
        work: what the cell believes; bound once it is there.
        error: why it stands; None where it does not.
    """

    arm: Arm
    work: Workplace | None = None
    error: DeviceError | None = None
    _over: asyncio.Event = field(default_factory=asyncio.Event)
    _free: bool = False
    _clearing: "asyncio.Task[object] | None" = None

    def bind(self, work: Workplace) -> None:
        """The cell that it works in."""
        self.work = work

    def joints(self) -> Joints:
        """Where the axes are [rad]."""
        return self.arm.joints()

    def load(self) -> float:
        """What hangs on the flange [kg]."""
        return self.arm.load()

    async def follow(self, trajectory: Trajectory, guard: Guard | None = None) -> str | None:
        """Moves along a trajectory.

        Raises:
            HaltedError: it stopped, and may be moved again, from where it is now.
            DeviceError: it stopped, and may not.
        """
        if self.work is None or asyncio.current_task() is self._clearing:
            return await self.arm.follow(trajectory, guard)
        if self.error is not None:
            await self._freed(self.error)
        try:
            return await self.arm.follow(trajectory, guard)
        except DeviceError as error:
            if self.error is None:
                self._stops(self.work, error)
            await self._freed(error)
            raise

    def _stops(self, work: Workplace, error: DeviceError) -> None:
        self.error, self._free = error, False
        self._over.clear()
        safety = work.ports.safety.state()
        aborted = safety.stopped or safety.gate_open
        work.tell([(STOPPED, str(error)), (ABORTED, aborted)], "arm")
        work.allocate(Call(RESTART, (KR60,), FIRST))

    async def _freed(self, error: DeviceError) -> None:
        """Waits until it may move again, and says so; or that it may not."""
        await self._over.wait()
        if not self._free:
            raise error
        raise HaltedError(str(error)) from error

    def clearing(self, *, begins: bool) -> None:
        """The running task alone may move it: it draws back."""
        self._clearing = asyncio.current_task() if begins else None

    def ends(self, *, free: bool) -> None:
        """The stop is over: it has drawn back, or nobody can help."""
        self.error, self._free = None, free
        self._over.set()


async def moved_away(arm: Arm, *ways: Trajectory | None) -> None:
    """With an empty hand along these, where nothing depends on how far it gets."""
    with suppress(HaltedError):  # it has drawn back by itself
        for way in ways:
            if way is not None:
                await arm.follow(way)
