"""The devices of a world in another process, each behind its port."""

import asyncio
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

from depal.domain import BoxId, Cup, Joints, PlaceId
from depal.drivers.remote.line import Line
from depal.errors import DeviceError
from depal.ports import Frame, Guard, Question, SafetyState, Trajectory, View, Watch
from depal.ports.wire import messages as m
from depal.ports.wire.values import Path, Photo, Sightings


@runtime_checkable
class TwoPart(Protocol):
    """A guard of which the robot's own controller watches a part."""

    @property
    def watch(self) -> Watch:
        """That part."""
        ...

    def asked(self) -> str | None:
        """The other part: a reason to stop, or None."""
        ...


@dataclass(frozen=True, slots=True)
class RemoteArm:
    """Behind `Arm`: what sensors tell is watched there, every other reason here."""

    line: Line

    def joints(self) -> Joints:
        """Where the axes are [rad]."""
        return self.line.state.joints

    def load(self) -> float:
        """What hangs on the flange [kg]."""
        return self.line.state.load

    async def follow(self, trajectory: Trajectory, guard: Guard | None = None) -> str | None:
        """Moves along a trajectory that begins where the arm stands."""
        watch, asked = Watch(), guard
        if isinstance(guard, TwoPart):
            watch, asked = guard.watch, guard.asked
        halted: list[str] = []

        def look(_: m.State) -> None:
            reason = asked() if asked is not None and not halted else None
            if reason is not None:
                halted.append(reason)
                self.line.say(m.Halt(reason))

        ignore = self.line.listen(look)
        try:
            return await self.line.call(m.Follow(Path.of(trajectory), watch), str | None)  # type: ignore[arg-type]
        except asyncio.CancelledError:
            with suppress(DeviceError):  # a world that has gone moves nothing
                self.line.say(m.Halt("broken off"))
            raise
        finally:
            ignore()


@dataclass(frozen=True, slots=True)
class RemoteOverride:
    """Behind `Override`."""

    line: Line

    def limit(self, speed: float) -> None:
        """Flange and tool are no faster than this from now on [m/s]."""
        with suppress(DeviceError):  # a world that has gone moves nothing
            self.line.say(m.Limit(speed))


@dataclass(frozen=True, slots=True)
class RemoteGripper:
    """Behind `Gripper`."""

    line: Line

    def vacuum(self) -> dict[str, float]:
        """What each module's sensor reads [Pa]."""
        return self.line.state.vacuum

    def folded(self) -> bool:
        """Whether the lower module is hinged up."""
        return self.line.state.folded

    async def fold(self, *, up: bool) -> None:
        """Moves the hinge and waits for its end."""
        await self.line.call(m.Fold(up), type(None))

    async def suck(self, cups: tuple[Cup, ...]) -> bool:
        """Opens the valves of these cups; whether the vacuum stands."""
        return await self.line.call(m.Suck(cups), bool)

    async def release(self) -> None:
        """Vents all cups and waits until the box is let go."""
        await self.line.call(m.Release(), type(None))


@dataclass(frozen=True, slots=True)
class RemoteBays:
    """Behind `Bays`."""

    line: Line

    def trolley(self, bay: str) -> str | None:
        """The trolley that stands locked in the bay, None where none does."""
        return self.line.state.trolleys.get(bay)

    async def profile(self, place: PlaceId) -> tuple[float, ...]:
        """How far in a compartment is free, strip by strip [m]."""
        return await self.line.call(m.Range(place), tuple[float, ...])


@dataclass(frozen=True, slots=True)
class RemoteSafety:
    """Behind `Safety`."""

    line: Line

    def state(self) -> SafetyState:
        """What it says now."""
        state = self.line.state
        return SafetyState(
            state.stopped, state.gate_open, state.near, state.inside, self.line.heard_at
        )


@dataclass(frozen=True, slots=True)
class RemoteReader:
    """Behind `BarcodeReader`."""

    line: Line

    async def read(self) -> tuple[str, ...]:
        """What it decodes now."""
        return await self.line.call(m.Read(), tuple[str, ...])


@dataclass(frozen=True, slots=True)
class RemoteCamera:
    """Behind `Camera`."""

    line: Line
    number: int

    async def take(self) -> Frame:
        """Takes one picture."""
        return (await self.line.call(m.Take(self.number), Photo)).frame


@dataclass(frozen=True, slots=True)
class RemoteSight:
    """Behind `Sight`: perception that knows the truth."""

    line: Line

    async def look(self) -> View:
        """Looks at the pallet."""
        return (await self.line.call(m.Look(), Sightings)).view


@dataclass(frozen=True, slots=True)
class RemoteDeeds:
    """What a person does beside a simulated cell."""

    line: Line

    async def do(self, question: Question, answer: str) -> None:
        """Does in the world what an answer promises."""
        await self.line.call(m.Do(question, answer), type(None))

    async def what_is_so(self, question: Question) -> str:
        """What somebody would answer who stands there; for tests and demonstrations."""
        return await self.line.call(m.Ask(question), str)


@dataclass(frozen=True, slots=True)
class RemoteReferee:
    """The truth about a simulated cell, for reports and tests only."""

    line: Line

    async def judge(self) -> m.Truth:
        """What is so."""
        return await self.line.call(m.Judge(), m.Truth)

    def lifted(self, box: BoxId, keep: Callable[[asyncio.Task[None]], None]) -> None:
        """The cell calls the box in the hand by this name."""
        keep(asyncio.get_running_loop().create_task(self._lifted(box)))

    async def _lifted(self, box: BoxId) -> None:
        with suppress(DeviceError):  # nobody asks the referee of a world that has gone
            await self.line.call(m.Lifted(box), type(None))
