"""The world of the process: what stands in it, and what each call does in it."""

import asyncio
import traceback
from collections.abc import Awaitable, Callable
from dataclasses import dataclass, field
from typing import Any

import msgspec

from depal.errors import DepalError, DeviceError
from depal.executive.clock import LoopClock
from depal.ports.wire import messages as m
from depal.ports.wire.values import Photo, Sightings
from depal.simulation.cell import SimulatedCell, build
from depal.simulation.imaging.severity import Severity
from depal.simulation.process.late import LateWorld, lag_of_this_loop
from depal.simulation.referee import Referee

SILENT = "the controller is gone"


@dataclass(slots=True)
class Course:
    """A motion, from when it was commanded.

    Attributes:
        halted: why it is to end before its end.
        over: set when the arm rests.
    """

    halted: str | None = None
    over: asyncio.Event = field(default_factory=asyncio.Event)


class Stage:
    """At most one simulated cell; a new delivery replaces it as a whole.

    Everything that anybody does to the simulated cell comes through here.
    """

    def __init__(self) -> None:
        """Nothing is built."""
        self._clock = LoopClock()
        self._cell: SimulatedCell | None = None
        self._courses: list[Course] = []
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

    def halt(self, reason: str) -> None:
        """The arm comes to rest on its path: all motions that were commanded up to now end."""
        for course in self._courses:
            course.halted = course.halted or reason

    def limit(self, speed: float) -> None:
        """The arm is no faster than this from now on [m/s]; what is no speed stops it."""
        if self._cell is not None:
            self._cell.arm.limit(max(speed, 0.0))

    def sensed(self) -> tuple[m.State | None, str | None]:
        """What the sensors say now, or why they say nothing; neither while nothing is built."""
        if self._cell is None:
            return None, None
        try:
            return self._state(self._cell), None
        except DeviceError as error:
            return None, str(error)

    def _state(self, cell: SimulatedCell) -> m.State:
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
            safety.near,
            safety.inside,
        )

    def takes_on(self, call: m.Call) -> Awaitable[object]:
        """Takes on what a controller asks for; it is done by whoever awaits it.

        Returns:
            What MessagePack can hold, or a `DepalError` where it cannot be done.
        """
        doing = self._doings.get(type(call))
        return _is_no_call(call) if doing is None else doing(call)

    @property
    def _doings(self) -> dict[type, Callable[[Any], Awaitable[object]]]:
        return {
            m.Build: self._build,
            m.Follow: self._follow,
            m.Fold: self._fold,
            m.Suck: self._suck,
            m.Release: self._release,
            m.Read: self._read,
            m.Range: self._range,
            m.Take: self._take,
            m.Look: self._look,
            m.Do: self._do,
            m.Ask: self._ask,
            m.Lifted: self._lifted,
            m.Judge: self._judge,
        }

    async def _build(self, call: m.Build) -> None:
        if self._courses:
            raise DeviceError("the arm moves; expected it at rest while the pallet is exchanged")
        kinds = [each.value for each in Severity]
        if call.severity not in kinds:
            raise DeviceError(f"there is no severity {call.severity!r}; expected one of {kinds}")
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

    def _follow(self, call: m.Follow) -> Awaitable[str | None]:
        earlier, course = tuple(self._courses), Course()
        self._courses.append(course)
        return self._follows(call, course, earlier)

    async def _follows(
        self, call: m.Follow, course: Course, earlier: tuple[Course, ...]
    ) -> str | None:
        try:
            for other in earlier:
                if other.halted is not None:  # the arm is coming to rest
                    await other.over.wait()
            if course.halted is not None:
                return course.halted
            path = call.path.trajectory
            return await self.cell.arm.follow(path, lambda: course.halted, call.watch)
        finally:
            self._courses.remove(course)
            course.over.set()

    async def _fold(self, call: m.Fold) -> None:
        await self.cell.gripper.fold(up=call.up)

    async def _suck(self, call: m.Suck) -> bool:
        return await self.cell.gripper.suck(call.cups)

    async def _release(self, _: m.Release) -> None:
        await self.cell.gripper.release()

    async def _read(self, _: m.Read) -> tuple[str, ...]:
        return await self.cell.reader.read()

    async def _range(self, call: m.Range) -> tuple[float, ...]:
        if call.place not in self.cell.world.layout.places:
            raise DeviceError(f"there is no place {call.place!r}")
        return await self.cell.bays.profile(call.place)

    async def _take(self, call: m.Take) -> Photo:
        cameras = self.cell.cameras
        if not 0 <= call.camera < len(cameras):
            raise DeviceError(f"there is no camera {call.camera}; there are {len(cameras)}")
        return Photo.of(await cameras[call.camera].take())

    async def _look(self, _: m.Look) -> Sightings:
        return Sightings.of(await self.cell.sight.look())

    async def _do(self, call: m.Do) -> None:
        await self.cell.person.does(call.question, call.answer)

    async def _ask(self, call: m.Ask) -> str:
        return self.cell.person.what_is_so(call.question)

    async def _lifted(self, call: m.Lifted) -> None:
        self.cell.witness.lifted(call.box, self._clock.now())

    async def _judge(self, _: m.Judge) -> m.Truth:
        cell = self.cell
        cell.world.advance(self._clock.now())
        summary = Referee(cell.world).summary()
        return m.Truth(
            tuple(truth.where for truth in cell.referee.boxes()),
            {str(name): index for name, index in cell.witness.indices.items()},
            tuple(str(collision) for collision in summary.collisions),
            len(summary.lost),
        )


async def _is_no_call(call: m.Call) -> None:
    raise DeviceError(f"{type(call).__name__} is no call")


async def done(stage: Stage, number: int, doing: Awaitable[object]) -> m.Reply:
    """The reply to a call, whatever comes of it: nobody waits for ever."""
    try:
        value = msgspec.msgpack.encode(await doing)
    except DepalError as error:
        return m.Reply(number, error=str(error), state=stage.sensed()[0])
    except Exception as error:  # noqa: BLE001 - a fault of the world's own is told as well
        traceback.print_exc()
        what = f"the simulated world has failed: {type(error).__name__}: {error}"
        return m.Reply(number, error=what, state=stage.sensed()[0])
    return m.Reply(number, value, state=stage.sensed()[0])
