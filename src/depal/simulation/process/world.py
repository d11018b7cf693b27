"""The world of the process: what stands in it, and what each call does in it."""

from collections.abc import Awaitable, Callable
from typing import Any

import msgspec

from depal.errors import DepalError, DeviceError
from depal.executive.clock import LoopClock
from depal.ports import Guard
from depal.ports.wire import messages as m
from depal.simulation.cell import SimulatedCell, build
from depal.simulation.imaging.severity import Severity
from depal.simulation.process.late import LateWorld, lag_of_this_loop
from depal.simulation.referee import Referee

SILENT = "the controller is gone"


class Stage:
    """At most one simulated cell; a new delivery replaces it as a whole."""

    def __init__(self) -> None:
        """Nothing is built."""
        self._clock = LoopClock()
        self._cell: SimulatedCell | None = None
        self._halt: str | None = None
        self.built: m.Built | None = None

    @property
    def cell(self) -> SimulatedCell:
        """What stands there.

        Raises:
            DeviceError: nothing does.
        """
        if self._cell is None:
            raise DeviceError("nothing is built in this world; build first")
        return self._cell

    def advance(self) -> None:
        """Brings the world to the loop's time."""
        if self._cell is not None:
            self._cell.world.advance(self._clock.now())

    def halt(self, reason: str) -> None:
        """The arm comes to rest on its path."""
        self._halt = reason

    def state(self) -> m.State | None:
        """What the sensors say now."""
        if self._cell is None:
            return None
        cell = self._cell
        safety = cell.safety.state()
        return m.State(
            self._clock.now(),
            cell.arm.joints(),
            cell.arm.load(),
            cell.gripper.vacuum(),
            cell.gripper.folded(),
            {storage.id: cell.bays.trolley(storage.id) for storage in cell.world.layout.storages},
            safety.stopped,
            safety.gate_open,
            lag_of_this_loop(),
        )

    async def call(self, call: m.Call) -> object:
        """Does what a controller asks for.

        Returns:
            What MessagePack can hold.

        Raises:
            DepalError: it cannot be done.
        """
        doing = self._doings.get(type(call))
        if doing is None:
            raise DeviceError(f"{type(call).__name__} is no call")
        return await doing(call)

    @property
    def _doings(self) -> dict[type, Callable[[Any], Awaitable[object]]]:
        return {
            m.Build: self._build,
            m.Follow: self._follow,
            m.Fold: self._fold,
            m.Suck: self._suck,
            m.Release: self._release,
            m.Read: self._read,
            m.Take: self._take,
            m.Look: self._look,
            m.Do: self._do,
            m.Ask: self._ask,
            m.Lifted: self._lifted,
            m.Judge: self._judge,
        }

    async def _build(self, call: m.Build) -> None:
        self._cell = build(
            call.layout,
            call.delivery,
            call.seed,
            clock=self._clock,
            start=self._clock.now(),
            severity=Severity(call.severity),
            kind=LateWorld,
        )
        self.built = m.Built(call.delivery.id, call.number)

    async def _follow(self, call: m.Follow) -> str | None:
        cell, self._halt = self.cell, None
        guard: Guard = lambda: (  # noqa: E731 - it is handed over
            self._halt or call.watch.reason(cell.gripper.vacuum(), cell.arm.load)
        )
        return await cell.arm.follow(call.path.trajectory, guard)

    async def _fold(self, call: m.Fold) -> None:
        await self.cell.gripper.fold(up=call.up)

    async def _suck(self, call: m.Suck) -> bool:
        return await self.cell.gripper.suck(call.cups)

    async def _release(self, _: m.Release) -> None:
        await self.cell.gripper.release()

    async def _read(self, _: m.Read) -> tuple[str, ...]:
        return await self.cell.reader.read()

    async def _take(self, call: m.Take) -> m.Photo:
        cameras = self.cell.cameras
        if not 0 <= call.camera < len(cameras):
            raise DeviceError(f"there is no camera {call.camera}; there are {len(cameras)}")
        return m.Photo.of(await cameras[call.camera].take())

    async def _look(self, _: m.Look) -> m.Sightings:
        return m.Sightings.of(await self.cell.sight.look())

    async def _do(self, call: m.Do) -> None:
        await self.cell.person.does(call.question, call.answer)

    async def _ask(self, call: m.Ask) -> str:
        return self.cell.person.what_is_so(call.question)

    async def _lifted(self, call: m.Lifted) -> None:
        self.cell.witness.lifted(call.box, self._clock.now())

    async def _judge(self, _: m.Judge) -> m.Truth:
        self.advance()
        cell = self.cell
        summary = Referee(cell.world).summary()
        return m.Truth(
            tuple(truth.where for truth in cell.referee.boxes()),
            {str(name): index for name, index in cell.witness.indices.items()},
            tuple(str(collision) for collision in summary.collisions),
            len(summary.lost),
        )


async def done(stage: Stage, request: m.Request) -> m.Reply:
    """The reply to a request, whatever comes of it."""
    try:
        value = msgspec.msgpack.encode(await stage.call(request.call))
    except DepalError as error:
        return m.Reply(request.number, error=str(error), state=stage.state())
    return m.Reply(request.number, value, state=stage.state())
