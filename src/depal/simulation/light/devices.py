"""The devices of a light world, as one controller has them: with its end they are dead to it."""

import asyncio
import math
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from depal.domain import BoxId, Cup, Detection, Joints, Perceived, PlaceId, Recognition
from depal.errors import DeviceError
from depal.executive.clock import Clock
from depal.ports import Guard, Trajectory, View, Watch
from depal.simulation.devices.ranging import profile_of
from depal.simulation.light.life import Life
from depal.simulation.light.rates import Rates
from depal.simulation.light.world import LEAKING, PALLET, LightWorld
from depal.simulation.witness import name_of

PERIOD, FINE = 0.4, 0.02
"""A guard is asked so often; one that weighs what is set down, more often [s]."""

FAR = 0.3
"""On ways that lead less far than this a box does not fall [m]."""

NEAR = 0.02
"""A trajectory must begin this near to where the axes stand [m, rad]."""

EXPOSURE, FIRST, LATER = 0.5, 1.2, 0.5
"""A look takes so long: its exposure, then the first one's computing or a later one's [s]."""

READING, BEFORE_LENS = 0.3, 0.4
"""A reading takes so long [s]; the box must be this near to the reader's spot [m]."""

LOWER = "lower"
"""The module that holds boxes from above."""


@dataclass(frozen=True, slots=True)
class Seat:
    """What the devices of one controller share.

    Attributes:
        world: the truth.
        clock: of the cell.
        life: of the controller.
        rates: of the faults.
        random: for chances, one sequence for the whole world.
        struck: how often each fault has.
    """

    world: LightWorld
    clock: Clock
    life: Life
    rates: Rates
    random: np.random.Generator
    struck: Counter[str]

    @property
    def now(self) -> float:
        """The time [s]."""
        return self.clock.now()

    def strikes(self, fault: str, rate: float) -> bool:
        """Whether a fault strikes at this chance."""
        if rate <= 0.0 or self.random.random() >= rate:
            return False
        self.struck[fault] += 1
        return True


class LightArm:
    """An arm that follows trajectories, or stands still."""

    def __init__(self, seat: Seat) -> None:
        """At rest."""
        self._seat = seat
        self.limited = math.inf

    def joints(self) -> Joints:
        """The axes: x, y, z [m], yaw [rad] of the flange, 0, 0."""
        self._seat.life.check()
        self._seat.world.advance(self._seat.now)
        a, b, c, d, e, f = self._seat.world.axes
        return (a, b, c, d, e, f)

    def load(self) -> float:
        """What hangs on the flange [kg]."""
        self._seat.life.check()
        return self._seat.world.load(self._seat.now)

    def limit(self, speed: float) -> None:
        """The override; nobody comes near a light world, whose ways have no speed of the tool."""
        self._seat.life.check()
        self.limited = speed

    async def follow(self, trajectory: Trajectory, guard: Guard | None = None) -> str | None:
        """Moves; where the controller ends on the way the arm stands still there.

        Raises:
            DeviceError: the trajectory begins elsewhere.
        """
        seat, world = self._seat, self._seat.world
        seat.life.check()
        away = max(abs(a - b) for a, b in zip(trajectory.start, world.axes, strict=True))
        if away > NEAR:
            raise DeviceError(f"the trajectory begins {away:.3f} from where the arm stands")
        began = seat.now
        course = world.begin(trajectory, began, self._drop(trajectory, began))
        end = began + trajectory.duration
        period = FINE if _weighs(guard) else PERIOD
        try:
            while True:
                left = end - seat.now
                if left > 0.0:
                    await asyncio.sleep(min(period, left))
                    seat.life.check()
                world.advance(seat.now)
                reason = None if guard is None else guard()
                if reason is not None:
                    world.stop(seat.now)
                    return reason
                if left <= period:
                    world.advance(max(end, seat.now))
                    return None
        except BaseException:
            if world.is_on(course):
                world.stop(seat.now)
            raise

    def _drop(self, trajectory: Trajectory, now: float) -> float | None:
        """When the held box falls on this way."""
        seat = self._seat
        if not seat.world.held:
            return None
        corners = trajectory.positions
        if float(np.abs(corners[-1, :2] - corners[0, :2]).max()) < FAR:
            return None
        if not seat.strikes("dropped", seat.rates.dropped):
            return None
        return now + trajectory.duration * float(seat.random.uniform(0.3, 0.9))


def _weighs(guard: Guard | None) -> bool:
    watch = getattr(guard, "watch", None)
    return isinstance(watch, Watch) and watch.load is not None


class LightGripper:
    """Suction from above."""

    def __init__(self, seat: Seat) -> None:
        """As the world's valves stand."""
        self._seat = seat

    def vacuum(self) -> dict[str, float]:
        """Of each module [Pa]."""
        self._seat.life.check()
        self._seat.world.advance(self._seat.now)
        names = (module.name for module in self._seat.world.layout.tool.modules)
        return {name: self._seat.world.vacuum if name == LOWER else 0.0 for name in names}

    def folded(self) -> bool:
        """Whether the lower module is up."""
        return self._seat.world.folded

    async def fold(self, *, up: bool) -> None:
        """Moves the hinge."""
        self._seat.life.check()
        self._seat.world.folded = up
        await asyncio.sleep(self._seat.world.layout.tool.fold_time)

    async def suck(self, cups: tuple[Cup, ...]) -> bool:
        """Opens the valves: from then on the vacuum stands or not, whoever waits for it."""
        del cups
        seat, world = self._seat, self._seat.world
        seat.life.check()
        if not world.held:
            self._seal()
        await asyncio.sleep(world.layout.tool.suction.rise)
        seat.life.check()
        return bool(world.held)

    def _seal(self) -> None:
        seat, world = self._seat, self._seat.world
        box = world.under_cups(seat.now)
        if box is None:
            return
        if seat.strikes("missed", seat.rates.missed):
            world.vacuum = LEAKING
            return
        beside = world.neighbour(box)
        sticks = beside is not None and seat.strikes("double", seat.rates.double)
        world.grip((box, beside) if sticks and beside is not None else (box,), seat.now)

    async def release(self) -> None:
        """Vents: the box is let go at once, whoever waits for it."""
        self._seat.life.check()
        self._seat.world.vent(self._seat.now)
        await asyncio.sleep(self._seat.world.layout.tool.suction.vent)
        self._seat.life.check()


class LightBays:
    """The bays' sensors."""

    def __init__(self, seat: Seat) -> None:
        """Of this world."""
        self._seat = seat

    def trolley(self, bay: str) -> str | None:
        """The trolley in a bay."""
        self._seat.life.check()
        return self._seat.world.bays[bay]

    async def profile(self, place: PlaceId) -> tuple[float, ...]:
        """How far in a compartment is free, strip by strip [m]."""
        self._seat.life.check()
        world = self._seat.world
        world.advance(self._seat.now)
        there = [box.shape for box in world.boxes if box.where == place]
        return profile_of(world.layout.places[place], there)


class LightReader:
    """Reads the label of a box that is held before it."""

    def __init__(self, seat: Seat) -> None:
        """Where the layout has it."""
        self._seat = seat
        mount = seat.world.layout.reader
        self._spot = mount.cell_from_reader.apply((0.0, 0.0, mount.distance))

    async def read(self) -> tuple[str, ...]:
        """The product's number of what hangs there."""
        self._seat.life.check()
        await asyncio.sleep(READING)
        self._seat.life.check()
        world = self._seat.world
        world.advance(self._seat.now)
        near = max(abs(a - b) for a, b in zip(world.axes[:2], self._spot[:2], strict=True))
        held = next(iter(world.held), None)
        return () if held is None or near > BEFORE_LENS else (str(world.boxes[held].gtin),)


class LightSight:
    """Sees every box on the pallet as it stands."""

    def __init__(self, seat: Seat, known: Callable[[int], bool]) -> None:
        """Has not looked yet.

        Args:
            seat: of the controller.
            known: whether a box is recognised, by its index in the stack.
        """
        self._seat, self._known = seat, known
        self._looked = False

    async def look(self) -> View:
        """Looks."""
        self._seat.life.check()
        await asyncio.sleep(EXPOSURE)
        self._seat.life.check()
        view = View(self._seat.now, self._found())
        await asyncio.sleep(LATER if self._looked else FIRST)
        self._looked = True
        return view

    def _found(self) -> tuple[Perceived, ...]:
        found: list[Perceived] = []
        for box in self._seat.world.boxes:
            if box.where != PALLET:
                continue
            name: BoxId = name_of(box.index)
            if self._known(box.index):
                found.append(Recognition(name, box.shape, box.gtin))
            else:
                found.append(Detection(name, box.shape))
        return tuple(found)
