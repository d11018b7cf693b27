"""A planning desk for an arm whose flange moves straight: no inverse kinematics, no collisions.

It keeps the promises, the order of places and everything else that the real desk does; only the
paths are other ones.
"""

import asyncio
import math
from collections.abc import Callable, Iterator

import numpy as np

from depal.app.run.assembly import DeskOf, Wiring
from depal.cell.planning.carrying import Carrying
from depal.cell.planning.loads import expected_mass
from depal.cell.planning.picking import Picking
from depal.cell.planning.planner import Planner
from depal.cell.planning.plans import CarryPlan, Load, PickPlan, ShowPlan
from depal.cell.planning.presenting import Presenting
from depal.cell.planning.promises import Promises
from depal.cell.planning.viewing import Viewing
from depal.cell.timekeeping import PLANNING, Timekeeper
from depal.cell.workplace import Workplace
from depal.domain import Approach, BoxId, Grasp, Perceived, PlaceId
from depal.geometry import OrientedBox, Pose, Vector3
from depal.logistics.placing import Held, find_spots
from depal.motion.collision import Scene
from depal.motion.collision.values import Array
from depal.motion.kinematics import Kinematics
from depal.motion.moves import Kind, Part, Pick
from depal.ports import Trajectory

SAFE = 2.0
"""So high the flange passes over everything [m]."""

LIFT, ABOVE, BELOW = 0.03, 0.015, 0.02
"""A box is lifted so far, comes in so far above its spot, and is lowered so far below it [m]."""

LOWER = "lower"
"""The module that holds boxes from above."""

Refuses = Callable[[BoxId, int], bool]
"""Whether nothing reaches a box while so many stand on the pallet."""

Corner = tuple[float, float, float, float]
"""x, y, z [m] and yaw [rad] of the flange."""


def light_desk(refuses: Refuses) -> DeskOf:
    """Makes the desk of a light cell."""

    def made(wiring: Wiring, work: Workplace, times: Timekeeper) -> LightDesk:
        del wiring
        return LightDesk(work, LightPlanner(work, times), refuses)

    return made


class LightPlanner(Planner):
    """Counts and charges as a planner does, and plans nothing."""

    def __init__(self, work: Workplace, times: Timekeeper) -> None:
        """Without a mover."""
        self._work = work
        self._times = times
        self.planned = 0
        self.spent = []

    async def charge(self, motions: int) -> None:
        """Lets the simulated time of planning pass."""
        if motions:
            with self._times.during(PLANNING):
                await asyncio.sleep(motions * self._work.settings.charges.plan)


class LightDesk:
    """Everything that plans for a light cell."""

    def __init__(self, work: Workplace, planner: LightPlanner, refuses: Refuses) -> None:
        """A desk with nothing on it."""
        self.planner = planner
        self.promises = Promises(work.layout)
        self.kinematics = Kinematics(work.layout.robot)
        self.picking = LightPicking(work, planner, self.promises, refuses)
        self.carrying = LightCarrying(work, planner, self.promises, self.picking)
        self.presenting = LightPresenting(work, planner, self.promises)
        self.viewing = LightViewing(work, self.kinematics)
        self.clearing = LightClearing(work)
        self.feeling = LightFeeling(work)

    def pace(self, speed: float) -> None:
        """A light arm has one speed."""


class LightPicking(Picking):
    """Boxes are taken from above, at the middle of their tops."""

    def __init__(
        self, work: Workplace, planner: LightPlanner, promises: Promises, refuses: Refuses
    ) -> None:
        """Picks from the pile, as the cell believes it."""
        super().__init__(work, planner, promises)
        self._refuses = refuses

    def try_pick(
        self,
        box: Perceived,
        first: Grasp | None = None,
        *,
        only: bool = False,
    ) -> PickPlan | str:
        """A pick from where the arm will be next, or that there is none."""
        del first, only
        work = self._work
        self._planner.planned += 1
        if self._refuses(box.id, len(work.pile)):
            return "the arm does not reach it"
        return _pick(box, expected_mass(box, work.delivery), _next(work, self._promises))

    def offered(self, box: Perceived) -> tuple[Grasp, ...]:
        """The one way."""
        return (_grasp(box.shape.size),)

    async def pick_from(self, box: BoxId, place: PlaceId) -> PickPlan | str:
        """Nothing is taken out of places."""
        return f"box {box} is not taken out of {place}"

    def park(self) -> Trajectory | None:
        """Up, and to the robot's side."""
        x, y, z, yaw = _here(self._work)
        return _along([(x, y, z, yaw), (x, y, SAFE, yaw), (0.6, 0.0, SAFE, yaw)])

    def way_back(self, plan: PickPlan) -> Iterator[Trajectory]:
        """Straight up."""
        del plan
        x, y, z, yaw = _here(self._work)
        yield _along([(x, y, z, yaw), (x, y, SAFE, yaw)])


class LightCarrying(Carrying):
    """Boxes come in over their spots."""

    def _into(self, load: Load, place: PlaceId) -> CarryPlan | str:
        """Into one place, at its best spot."""
        self._planner.planned += 1
        spots = find_spots(self._promises.books.at(place), Held(load.size, load.mass), limit=1)
        if not spots:
            return "no room"
        spot = spots[0]
        cell_from_place = self._work.layout.places[place].cell_from_place
        target = cell_from_place @ spot.place_from_box
        x, y, z = (target @ load.grasp.box_from_flange).translation
        yaw = _yaw(target)
        start = _begin(load)
        over = (x, y, z + ABOVE, yaw)
        motion = _along([start, (*start[:2], SAFE, start[3]), (x, y, SAFE, yaw), over])
        descent = _along([over, (x, y, z - BELOW, yaw)], speed=0.1)
        retreat = np.array([[*over, 0.0, 0.0], [x, y, SAFE, yaw, 0.0, 0.0]])
        return CarryPlan(load, place, spot, target, motion, descent, retreat)

    def way_out(self, plan: CarryPlan) -> Trajectory | None:
        """Straight up."""
        return self.retreat(plan)

    def descent(self, plan: CarryPlan) -> Trajectory | None:
        """What is left of the way down."""
        low, here = _corner(plan.descent.positions[-1]), _here(self._work)
        return None if here[2] <= low[2] else _along([here, low], speed=0.1)

    def retreat(self, plan: CarryPlan) -> Trajectory | None:
        """Straight up."""
        del plan
        x, y, z, yaw = _here(self._work)
        return _along([(x, y, z, yaw), (x, y, SAFE, yaw)])


class LightPresenting(Presenting):
    """One side is shown."""

    def _sides(self, load: Load, bulky: Load, scene: Scene) -> ShowPlan | str:
        del bulky, scene
        self._planner.planned += 1
        mount = self._work.layout.reader
        x, y, _ = mount.cell_from_reader.apply((0.0, 0.0, mount.distance))
        start = _begin(load)
        yaw = start[3]
        return ShowPlan(
            _along([start, (*start[:2], SAFE, yaw), (x, y, SAFE, yaw), (x, y, 1.5, yaw)]), ()
        )


class LightViewing(Viewing):
    """The view is clear when the flange is not over the pallet."""

    def _is_away(self, q: tuple[float, ...] | Array) -> bool:
        stand = self._work.layout.pallet
        x, y, _ = stand.cell_from_pallet.inverse.apply((float(q[0]), float(q[1]), 0.0))
        length, width, _ = stand.size
        return not (0.0 < x < length and 0.0 < y < width)


class LightClearing:
    """Straight up from wherever the arm is."""

    def __init__(self, work: Workplace) -> None:
        """Of this cell."""
        self._work = work

    def ways_out(self) -> Iterator[Trajectory]:
        """One way."""
        x, y, z, yaw = _here(self._work)
        if z < SAFE:
            yield _along([(x, y, z, yaw), (x, y, SAFE, yaw)])


class LightFeeling:
    """What the sight tells is exact: nothing is felt for."""

    def __init__(self, work: Workplace) -> None:
        """Of this cell."""
        self._work = work

    def nearer(self, plan: PickPlan, way: float) -> Trajectory | None:
        """No way."""
        del plan, way
        return None

    def lift(self, plan: PickPlan) -> Trajectory:
        """The plan's lift."""
        return plan.lift

    def early(self, plan: PickPlan) -> float:
        """Boxes are as high as they look."""
        del plan
        return 0.0

    def out(self, plan: PickPlan) -> Trajectory | None:
        """No way."""
        del plan
        return None

    def under_cups(self, plan: PickPlan) -> OrientedBox:
        """The whole top."""
        shape = plan.box.shape
        length, width, height = shape.size
        x, y, z = shape.centre
        top = Pose((x, y, z + height / 2), shape.pose.rotation)
        return OrientedBox(top, (length, width, 0.002))


def _grasp(size: Vector3) -> Grasp:
    """From above, with every cup of the lower module."""
    cups = tuple((LOWER, k) for k in range(6))
    return Grasp(
        Approach.VERTICAL,
        folded=False,
        box_from_flange=Pose((0.0, 0.0, size[2] / 2)),
        cups=cups,
    )


def _pick(box: Perceived, mass: float, start: Corner) -> PickPlan:
    grasp = _grasp(box.shape.size)
    touch = box.shape.pose @ grasp.box_from_flange
    x, y, z = touch.translation
    yaw = _yaw(touch)
    at, up, high = (x, y, z, yaw), (x, y, z + LIFT, yaw), (x, y, SAFE, yaw)
    way = [start, (*start[:2], SAFE, start[3]), high, at]
    pick = Pick(
        grasp,
        (Part(Kind.FREE, _rows(way)),),
        Part(Kind.STRAIGHT, _rows([at, up]), touching=True),
        Part(Kind.STRAIGHT, _rows([up, high]), touching=True),
    )
    return PickPlan(box, mass, pick, _along(way), _along([at, up], speed=0.2))


def _next(work: Workplace, promises: Promises) -> Corner:
    """Where the arm will be next."""
    return _corner(promises.next_start or work.ports.arm.joints())


def _begin(load: Load) -> Corner:
    """Where a motion with a load begins: with its straight way out, where it has one."""
    return _corner(load.lead[0].path[0] if load.lead else load.start)


def _here(work: Workplace) -> Corner:
    return _corner(work.ports.arm.joints())


def _corner(row: tuple[float, ...] | Array) -> Corner:
    return (float(row[0]), float(row[1]), float(row[2]), float(row[3]))


def _yaw(pose: Pose) -> float:
    return math.atan2(pose.rotation[1][0], pose.rotation[0][0])


def _rows(corners: list[Corner]) -> Array:
    return np.array([[*corner, 0.0, 0.0] for corner in corners])


def _along(corners: list[Corner], speed: float = 1.5) -> Trajectory:
    """Straight from corner to corner; those that lie on another count once.

    Args:
        corners: in order.
        speed: of the flange [m/s].
    """
    way, times = [corners[0]], [0.0]
    for corner in corners[1:]:
        far = max(math.dist(corner[:3], way[-1][:3]), abs(corner[3] - way[-1][3]))
        if far > 1e-6:  # noqa: PLR2004 - as good as the same
            way.append(corner)
            times.append(times[-1] + far / speed)
    rows = _rows(way)
    return Trajectory(np.array(times), rows, np.zeros_like(rows))
