"""Perception whose camera is dead or frozen."""

import asyncio

from depal.errors import DeviceError
from depal.ports import Camera, Frame, Sight, View
from depal.simulation.faults.catalogue import Phase
from depal.simulation.faults.chances import Chances
from depal.simulation.faults.plan import Struck

EXPOSURE = 0.5
"""After so long without a picture the camera counts as dead [s]."""

DEAD = "no picture came from the camera"


class FaultySight:
    """P1 of a sight without pictures: it sees nothing, or what it saw before."""

    def __init__(self, sight: Sight, chances: Chances) -> None:
        """A sight whose camera may fail."""
        self._sight, self._chances = sight, chances
        self._last: View | None = None

    async def look(self) -> View:
        """Looks.

        Raises:
            DeviceError: no picture came.
        """
        struck = self._chances.lasts("P1", Phase.LOOK)
        if struck is None:
            self._last = await self._sight.look()
            return self._last
        await asyncio.sleep(EXPOSURE)
        if self._last is None or _dead(self._chances, struck):
            raise DeviceError(DEAD)
        return self._last


class FaultyCamera:
    """P1 of a camera: it gives no picture, or the one that it gave before."""

    def __init__(self, camera: Camera, chances: Chances) -> None:
        """A camera that may fail."""
        self._camera, self._chances = camera, chances
        self._last: Frame | None = None

    async def take(self) -> Frame:
        """Takes one picture.

        Raises:
            DeviceError: no picture came.
        """
        struck = self._chances.lasts("P1", Phase.LOOK)
        if struck is None:
            self._last = await self._camera.take()
            return self._last
        await asyncio.sleep(EXPOSURE)
        if self._last is None or _dead(self._chances, struck):
            raise DeviceError(DEAD)
        return self._last


def _dead(chances: Chances, struck: Struck) -> bool:
    """Whether it is dead; frozen else. Each fault is one of the two as long as it lasts."""
    return bool(chances.dice(3, round(1000 * struck.at)).random() < 0.5)  # noqa: PLR2004 - even
