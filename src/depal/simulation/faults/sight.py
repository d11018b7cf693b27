"""Perception whose camera is dead, frozen or bumped."""

import asyncio
from dataclasses import replace

import numpy as np

from depal.domain import Perceived
from depal.errors import DeviceError
from depal.geometry import OrientedBox, Pose
from depal.ports import Frame, Sight, View
from depal.simulation.faults.catalogue import Phase
from depal.simulation.faults.chances import Chances
from depal.simulation.faults.plan import Struck
from depal.simulation.imaging.camera import SimulatedCamera

EXPOSURE = 0.5
"""After so long without a picture the camera counts as dead [s]."""

DEAD = "no picture came from the camera"


SLIGHT, FAR = 0.002, 0.030
"""A bumped camera places what it sees by so much off [m]."""

NOTICED = 0.005
"""By the markers this much is noticed [m]."""


class FaultySight:
    """P1 and P6 of a sight without pictures.

    P1: it sees nothing, or what it saw before. P6: it sees everything elsewhere; beyond what its
    markers reveal it says so, as cameras do.
    """

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
            self._last = self._bumped(await self._sight.look())
            return self._last
        await asyncio.sleep(EXPOSURE)
        if self._last is None or _dead(self._chances, struck):
            raise DeviceError(DEAD)
        return self._last

    def _bumped(self, view: View) -> View:
        """What is seen from where the camera hangs now.

        Raises:
            DeviceError: its markers are too far off.
        """
        if self._chances.lasts("P6", Phase.LOOK) is None:
            return view
        shift = shift_of(self._chances)
        off = float(np.linalg.norm(shift.translation))
        if off > NOTICED:
            raise DeviceError(
                f"moved: by its markers what the camera sees is {1000 * off:.0f} mm off, "
                f"expected at most {1000 * NOTICED:.0f} mm"
            )
        return replace(view, boxes=tuple(_seen_from(shift, box) for box in view.boxes))


class FaultyCamera:
    """P1 and P6 of a camera: no picture, the one before, or one from elsewhere."""

    def __init__(self, camera: SimulatedCamera, chances: Chances) -> None:
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
            bumped = self._chances.lasts("P6", Phase.LOOK) is not None
            self._camera.bump(shift_of(self._chances) if bumped else None)
            self._last = await self._camera.take()
            return self._last
        await asyncio.sleep(EXPOSURE)
        if self._last is None or _dead(self._chances, struck):
            raise DeviceError(DEAD)
        return self._last


def shift_of(chances: Chances) -> Pose:
    """By how much a bumped camera sees everything elsewhere."""
    random = chances.fixed_dice(9)
    way = random.normal(size=3)
    x, y, z = (way / np.linalg.norm(way) * random.uniform(SLIGHT, FAR)).tolist()
    return Pose((x, y, z))


def _seen_from(shift: Pose, box: Perceived) -> Perceived:
    return replace(box, shape=OrientedBox(shift @ box.shape.pose, box.shape.size))


def _dead(chances: Chances, struck: Struck) -> bool:
    """Whether it is dead; frozen else. Each fault is one of the two as long as it lasts."""
    return bool(chances.dice(3, round(1000 * struck.at)).random() < 0.5)  # noqa: PLR2004 - even
