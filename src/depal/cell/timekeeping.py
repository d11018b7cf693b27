"""Where the simulated time of a run goes: the ports, each with a stopwatch."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace

from depal.cell.workplace import Ports
from depal.domain import Cup, Joints
from depal.ports import (
    Arm,
    BarcodeReader,
    Clock,
    Gripper,
    Guard,
    Person,
    Question,
    Sight,
    Trajectory,
    View,
)

MOTION, SUCTION, READING, LOOKING, PLANNING, WAITING, REST = (
    "arm motion",
    "suction",
    "reader",
    "looking",
    "planning",
    "waiting for people",
    "nothing",
)

ORDER = (MOTION, SUCTION, READING, LOOKING, PLANNING, WAITING)
"""Time in which several things go on counts for the first of them: the rest is in its shadow."""


class Timekeeper:
    """Intervals of simulated time by what went on."""

    def __init__(self, clock: Clock) -> None:
        """Nothing has gone on yet."""
        self._clock = clock
        self._spans: dict[str, list[tuple[float, float]]] = {name: [] for name in ORDER}

    @contextmanager
    def during(self, what: str) -> Iterator[None]:
        """Something goes on while this is open."""
        began = self._clock.now()
        try:
            yield
        finally:
            ended = self._clock.now()
            if ended > began:
                self._spans[what].append((began, ended))

    def shares(self, until: float) -> dict[str, float]:
        """Seconds by what went on, each second counted once; they add up to `until` [s]."""
        out: dict[str, float] = {}
        covered: list[tuple[float, float]] = []
        before = 0.0
        for name in ORDER:
            covered = _union([*covered, *self._spans[name]])
            total = sum(end - start for start, end in covered)
            out[name] = total - before
            before = total
        out[REST] = max(0.0, until - before)
        return out


def _union(spans: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    merged: list[tuple[float, float]] = []
    for start, end in sorted(spans):
        if merged and start <= merged[-1][1]:
            merged[-1] = (merged[-1][0], max(merged[-1][1], end))
        else:
            merged.append((start, end))
    return merged


@dataclass(frozen=True, slots=True)
class TimedArm:
    """An arm whose motions are timed."""

    arm: Arm
    times: Timekeeper

    def joints(self) -> Joints:
        """Where the axes are [rad]."""
        return self.arm.joints()

    def load(self) -> float:
        """What hangs on the flange [kg]."""
        return self.arm.load()

    async def follow(self, trajectory: Trajectory, guard: Guard | None = None) -> str | None:
        """Moves."""
        with self.times.during(MOTION):
            return await self.arm.follow(trajectory, guard)


@dataclass(frozen=True, slots=True)
class TimedGripper:
    """A gripper whose vacuum is timed."""

    gripper: Gripper
    times: Timekeeper

    def vacuum(self) -> dict[str, float]:
        """Of each module [Pa]."""
        return self.gripper.vacuum()

    def folded(self) -> bool:
        """Whether the lower module is up."""
        return self.gripper.folded()

    async def fold(self, *, up: bool) -> None:
        """Moves the hinge."""
        with self.times.during(SUCTION):
            await self.gripper.fold(up=up)

    async def suck(self, cups: tuple[Cup, ...]) -> bool:
        """Makes vacuum."""
        with self.times.during(SUCTION):
            return await self.gripper.suck(cups)

    async def release(self) -> None:
        """Vents."""
        with self.times.during(SUCTION):
            await self.gripper.release()


@dataclass(frozen=True, slots=True)
class TimedReader:
    """A reader whose readings are timed."""

    reader: BarcodeReader
    times: Timekeeper

    async def read(self) -> tuple[str, ...]:
        """Reads."""
        with self.times.during(READING):
            return await self.reader.read()


@dataclass(frozen=True, slots=True)
class TimedSight:
    """Perception whose looks are timed."""

    sight: Sight
    times: Timekeeper

    async def look(self) -> View:
        """Looks."""
        with self.times.during(LOOKING):
            return await self.sight.look()


@dataclass(frozen=True, slots=True)
class TimedPerson:
    """A person for whom waiting is timed."""

    person: Person
    times: Timekeeper

    async def ask(self, question: Question) -> str:
        """Asks."""
        with self.times.during(WAITING):
            return await self.person.ask(question)


def timed(ports: Ports, times: Timekeeper) -> Ports:
    """The same ports, each with the stopwatch."""
    return replace(
        ports,
        arm=TimedArm(ports.arm, times),
        gripper=TimedGripper(ports.gripper, times),
        reader=TimedReader(ports.reader, times),
        sight=TimedSight(ports.sight, times),
        person=TimedPerson(ports.person, times),
    )
