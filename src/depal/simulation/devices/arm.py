"""The simulated arm."""

import asyncio
import math

import numpy as np

from depal.domain import Joints
from depal.errors import DeviceError
from depal.executive.clock import Clock
from depal.ports import Guard, Trajectory, Watch
from depal.simulation.devices.safety import SimulatedSafety
from depal.simulation.servo import Motion
from depal.simulation.world import World

PERIOD = 0.008
"""The control period [s]."""

OVER = 1.05
"""Rates at the samples of a trajectory may be this much above the limits of the axes."""

BEYOND = 1e-3
"""And positions this far outside [rad]."""

NEAR = 0.02
"""A trajectory must begin this near to where the axes stand [rad]."""


class SimulatedArm:
    """An arm that follows trajectories in the simulated world."""

    def __init__(self, world: World, clock: Clock, safety: SimulatedSafety) -> None:
        """The arm of this world."""
        self._world, self._clock, self._safety = world, clock, safety
        self._busy, self._most = False, math.inf

    def joints(self) -> Joints:
        """Where the axes are [rad]."""
        self._world.advance(self._clock.now())
        return self._world.joints()

    def load(self) -> float:
        """The weight that hangs on the flange beyond the tool's own, as a mass [kg]."""
        self._world.advance(self._clock.now())
        return self._world.load()

    def limit(self, speed: float) -> None:
        """Flange and tool are no faster than this from now on [m/s]; behind `Override`."""
        self._most = speed
        self._world.advance(self._clock.now())
        self._keep_pace()

    def _keep_pace(self) -> Motion:
        """The override; and with somebody in the protective field the arm stands, whoever says."""
        return self._world.pace(0.0 if self._safety.state().inside else self._most)

    async def follow(
        self, trajectory: Trajectory, guard: Guard | None = None, watch: Watch | None = None
    ) -> str | None:
        """Moves along a trajectory that begins where the arm stands.

        Args:
            trajectory: the motion.
            guard: asked in every control period; a reason brings the arm to rest on its path.
            watch: what the arm looks out for by itself, however late this loop is.

        Returns:
            None once the arm rests at the end, else the reason why it stopped before.

        Raises:
            DeviceError: the arm is moving already, a safety stop is active, or the trajectory
                begins elsewhere or asks for more than the axes can do.
        """
        self._world.advance(self._clock.now())
        self._check(trajectory)
        self._keep_pace()
        self._busy = True
        motion = self._world.begin(trajectory, watch)
        try:
            reason = await self._watch(motion, guard)
            if reason is not None:
                await self._rest()
        except asyncio.CancelledError:
            self._world.advance(self._clock.now())
            self._world.stop()
            raise
        finally:
            self._busy = False
        if self._safety.state().tripped:
            raise DeviceError(f"the arm stopped on its path: {reason}")
        return reason

    def _check(self, trajectory: Trajectory) -> None:
        if self._busy:
            raise DeviceError("the arm was told to move while it moves")
        if self._safety.state().tripped:
            raise DeviceError("the arm cannot move: a safety stop is active")
        wanted, _ = self._world.wanted()
        away = np.abs(np.array(trajectory.start) - wanted)
        if away.max() > NEAR:
            axis = int(away.argmax())
            raise DeviceError(
                f"the trajectory begins {away[axis]:.3f} rad from where axis {axis + 1} stands; "
                f"expected at most {NEAR} rad"
            )

        self._check_limits(trajectory)

    def _check_limits(self, trajectory: Trajectory) -> None:
        if not (
            np.isfinite(trajectory.positions).all() and np.isfinite(trajectory.velocities).all()
        ):
            raise DeviceError("the trajectory has numbers that are not finite")
        limits = self._world.layout.robot.limits
        rates = np.abs(trajectory.velocities) / np.array(limits.speed)
        if rates.max() > OVER:
            axis = int(rates.max(axis=0).argmax())
            raise DeviceError(
                f"the trajectory turns axis {axis + 1} at {rates.max():.2f} times its greatest rate"
            )
        above = trajectory.positions - np.array(limits.upper)
        outside = np.maximum(above, np.array(limits.lower) - trajectory.positions)
        if outside.max() > BEYOND:
            axis = int(outside.max(axis=0).argmax())
            raise DeviceError(
                f"the trajectory turns axis {axis + 1} {outside.max():.3f} rad beyond its limits"
            )

    async def _watch(self, motion: Motion, guard: Guard | None) -> str | None:
        """Waits for the end of a motion, period by period; the reason to stop before it.

        A motion that stands still on its path because nobody may move goes on by itself.
        """
        start, periods = self._clock.now(), 0
        end = self._world.ending(motion)
        while self._clock.now() < end - 1e-9 or not motion.whole:
            periods += 1
            due = start + periods * PERIOD
            await _until(self._clock, min(due, end) if motion.whole else due)
            self._world.advance(self._clock.now())
            motion = self._keep_pace()
            end = self._world.ending(motion)
            reason = "a safety stop is active" if self._safety.state().tripped else None
            reason = reason or self._world.seen
            if reason is None and guard is not None:
                reason = guard()
            if reason is not None:
                return reason
        self._world.advance(end)  # others may have seen that time has come before us
        return self._world.seen

    async def _rest(self) -> None:
        stopping = self._world.stop()
        await _until(self._clock, self._world.ending(stopping))
        self._world.advance(self._clock.now())


async def _until(clock: Clock, time: float) -> None:
    await asyncio.sleep(max(time - clock.now(), 0.0))
