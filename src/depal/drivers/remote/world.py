"""A world in another process: its devices, what stands in it, and its end."""

import asyncio
from collections.abc import Sequence
from contextlib import suppress

from depal.domain import BoxId, CellLayout, Delivery
from depal.drivers.remote.devices import (
    RemoteArm,
    RemoteBays,
    RemoteCamera,
    RemoteDeeds,
    RemoteGripper,
    RemoteOverride,
    RemoteReader,
    RemoteReferee,
    RemoteSafety,
    RemoteSight,
)
from depal.drivers.remote.line import Line
from depal.errors import DeviceError
from depal.executive.clock import Pace
from depal.ports import Arm, BarcodeReader, Bays, Camera, Gripper, Override, Safety, Sight
from depal.ports.wire import messages as m

ENDING = 10.0
"""A world that has not ended by then does something long; it will end after it [s of wall time]."""


class RemoteWorld:
    """What a controller works in.

    Attributes:
        arm: behind `Arm`.
        gripper: behind `Gripper`.
        bays: behind `Bays`.
        safety: behind `Safety`.
        override: behind `Override`.
        reader: behind `BarcodeReader`.
        cameras: each behind `Camera`, in the order of the layout; none while nothing is built.
        truth_sight: behind `Sight`, for comparisons.
        deeds: of a person.
        referee: for reports and tests only.
    """

    def __init__(self, line: Line, welcome: m.Welcome, cameras: int) -> None:
        """Over an open line.

        Args:
            line: to the process.
            welcome: what it has told.
            cameras: how many the cell has that stands there.
        """
        self._line = line
        self._tasks: set[asyncio.Task[None]] = set()
        self.pace = Pace(welcome.pace, welcome.start, welcome.origin)
        self.built = welcome.built
        self.arm: Arm = RemoteArm(line)
        self.gripper: Gripper = RemoteGripper(line)
        self.bays: Bays = RemoteBays(line)
        self.safety: Safety = RemoteSafety(line)
        self.override: Override = RemoteOverride(line)
        self.reader: BarcodeReader = RemoteReader(line)
        self.truth_sight: Sight = RemoteSight(line)
        self.deeds = RemoteDeeds(line)
        self.referee = RemoteReferee(line)
        self.cameras: Sequence[Camera] = [RemoteCamera(line, k) for k in range(cameras)]
        line.beat(self.pace.rate)

    async def build(
        self, layout: CellLayout, delivery: Delivery, *, seed: int, severity: str, number: int
    ) -> None:
        """A full pallet and empty trolleys come into the cell.

        Raises:
            DeviceError: this pallet cannot be built.
        """
        call = m.Build(layout, delivery, seed, severity, number)
        await self._line.call(call, type(None))
        self.built = m.Built(delivery.id, number)
        self.cameras = [RemoteCamera(self._line, k) for k in range(len(layout.cameras))]

    def witness_lifted(self, box: BoxId) -> None:
        """Tells the referee which box the cell means by a name."""
        self.referee.lifted(box, self._keep)

    def _keep(self, task: asyncio.Task[None]) -> None:
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def shutdown(self) -> None:
        """Ends the world, and waits until it has ended."""
        with suppress(DeviceError):  # it has ended already
            self._line.say(m.Shutdown())
        await self._line.ends(ENDING * self.pace.rate)
        await self._line.close()

    async def close(self) -> None:
        """Lets go of the world, which lives on."""
        await self._line.close()
