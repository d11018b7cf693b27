"""A pile that is not what it seems: foreign, heavy, moved, stuck together, or falling."""

from dataclasses import replace

import numpy as np

from depal.domain import Gtin, Joints
from depal.geometry import OrientedBox, Pose
from depal.motion.kinematics import Kinematics
from depal.simulation.faults.catalogue import Phase
from depal.simulation.faults.chances import Chances
from depal.simulation.faults.plan import Fault, FaultPlan, Struck
from depal.simulation.referee import PALLET, Referee
from depal.simulation.world import World

FOREIGN = Gtin("01234567890128")
"""No delivery brings this product."""

NEAR = 0.035
"""Boxes with less between them may stick together [m]."""

ON_TOP = 0.02
"""A box whose lower side is this near to another's upper side lies on it [m]."""

AWAY = (0.03, 0.06)
"""So far a box is moved [m]."""

LIGHT, HEAVY = (0.5, 0.7), (1.22, 1.32)
"""A box that is not filled as it should be weighs so many times what its product does."""

SHORT = (0.70, 0.80)
"""A box that is not as high as its product has this share of the height."""

MOVING = frozenset({"P7", "M2"})
"""The faults that move boxes before the cups are at them."""

PUSH = 1.4
"""With this speed a falling box leaves the pile [m/s]."""


class FaultyPile:
    """N3, N4, P7, G4 and M2: what happens to boxes on the pallet."""

    def __init__(self, world: World, chances: Chances, plan: FaultPlan) -> None:
        """The pile of this world; a foreign product stands in it from the begin."""
        self._world, self._chances = world, chances
        self._referee = Referee(world)
        self._kinematics = Kinematics(world.layout.robot)
        for fault in plan.faults:
            if fault.id == "N3" and world.cases:
                count = len(world.cases)
                drawn = int(chances.dice(4).integers(count))
                box = drawn if fault.when.box is None else fault.when.box % count
                cases = list(world.cases)
                cases[box] = replace(cases[box], gtin=FOREIGN)
                world.cases = tuple(cases)
                chances.struck.append(Struck(fault, world.now, Phase.LOOK, box))
            if fault.id == "N4" and fault.when.phase is Phase.LOOK:
                self._shorten(fault)

    def reached_for(self, end: Joints) -> None:
        """The arm begins to move, with an empty hand, to these joints [rad]."""
        if self._chances.planned.isdisjoint(MOVING):
            return
        flange = self._kinematics.flange(np.array(end))
        tips = [
            flange.apply(module.flange_from_face.translation)
            for module in self._world.layout.tool.modules
        ]
        tops = self._tops()
        if not tops:
            return
        tip = min(tips, key=lambda point: min(self._off(point, box) for box in tops))
        box = min(tops, key=lambda one: self._off(tip, one))
        for way in self._free_ways(box):
            if self._chances.strikes("P7", Phase.REACH, box) is not None:
                pose = self._world.box(box)
                x, y, z = pose.translation
                self._world.place_box(box, Pose((x + way[0], y + way[1], z), pose.rotation))
            break
        if self._chances.strikes("M2", Phase.REACH, box) is not None:
            self._push(box)

    def grasped(self, box: int) -> None:
        """The cups are at a box: it may weigh what it should not."""
        if self._chances.strikes("N4", Phase.GRASP, box) is None:
            return
        random, world = self._chances.dice(5), self._world
        low, high = LIGHT if random.random() < 0.5 else HEAVY  # noqa: PLR2004 - even
        share = float(random.uniform(low, high))
        body = world.model.box_bodies[box]
        world.model.mj.body_mass[body] *= share
        world.model.mj.body_inertia[body] *= share
        cases = list(world.cases)
        cases[box] = replace(cases[box], mass=cases[box].mass * share)
        world.cases = tuple(cases)

    def _shorten(self, fault: Fault) -> None:
        """A box that nothing lies on has been lower from the beginning."""
        world, random, tops = self._world, self._chances.dice(11), self._tops()
        if not tops:
            return
        box = tops[int(random.integers(len(tops)))]
        if fault.when.box in tops:
            box = fault.when.box
        case, pose = world.cases[box], world.box(box)
        a, b, c = case.shape.size
        size = (a, b, c * float(random.uniform(*SHORT)))
        world.model.mj.geom_size[world.model.box_geoms[box]] = np.array(size) / 2
        cases = list(world.cases)
        cases[box] = replace(case, shape=OrientedBox(case.shape.pose, size))
        world.cases = tuple(cases)
        world.place_box(box, Pose((0.0, 0.0, (size[2] - c) / 2)) @ pose)
        self._chances.struck.append(Struck(fault, world.now, Phase.LOOK, box))

    def sticks(self, box: int) -> None:
        """The vacuum holds a box: a neighbour that stands close by may come along."""
        if "G4" not in self._chances.planned:
            return
        beside = [other for other in self._on_pallet() if other != box and self._beside(box, other)]
        if beside and self._chances.strikes("G4", Phase.GRASP, box) is not None:
            self._world.suction.stick(beside[0], box)

    def _push(self, box: int) -> None:
        """Over the front, towards the robot."""
        world = self._world
        dof = world.model.box_dofs[box]
        world.refresh()
        x, y, _ = world.box(box).translation
        away = np.hypot(x, y)
        world.data.qvel[dof : dof + 3] = (-PUSH * x / away, -PUSH * y / away, 0.5)
        world.wake()

    def _on_pallet(self) -> list[int]:
        where = self._referee.where
        return [case.index for case in self._world.cases if where(case.index) == PALLET]

    def _tops(self) -> list[int]:
        """Boxes on the pallet that nothing lies on."""
        boxes = self._on_pallet()
        return [box for box in boxes if not any(self._lies_on(other, box) for other in boxes)]

    def _lies_on(self, upper: int, lower: int) -> bool:
        (la, lb), (ua, ub) = self._bounds(lower), self._bounds(upper)
        level = abs(ua[2] - lb[2]) < ON_TOP
        return (
            upper != lower and level and bool((np.minimum(lb, ub) > np.maximum(la, ua))[:2].all())
        )

    def _beside(self, box: int, other: int) -> bool:
        (a, b), (c, d) = self._bounds(box), self._bounds(other)
        gap = np.maximum(c - b, a - d)
        return bool(gap[:2].max() < NEAR and gap[2] < -ON_TOP)

    def _free_ways(self, box: int) -> list[tuple[float, float]]:
        """Shifts of a box along the pallet's front that push it against nothing [m]."""
        far = float(self._chances.dice(6).uniform(*AWAY))
        a, b = self._bounds(box)
        found = []
        for shift in ((0.0, far), (0.0, -far)):
            lower, upper = a + np.array([*shift, 0.005]), b + np.array([*shift, 0.0])
            others = [self._bounds(other) for other in self._on_pallet() if other != box]
            if not any((np.minimum(d, upper) > np.maximum(c, lower)).all() for c, d in others):
                found.append(shift)
        return found

    def _bounds(self, box: int) -> tuple[np.ndarray, np.ndarray]:
        """The lowest and the highest corner of the box around a box, each (3,) [m]."""
        pose, size = self._world.box(box), self._world.cases[box].shape.size
        reach = np.abs(np.array(pose.rotation)) @ np.array(size) / 2
        centre = np.array(pose.translation)
        return centre - reach, centre + reach

    def _off(self, point: tuple[float, float, float], box: int) -> float:
        lower, upper = self._bounds(box)
        at = np.array(point)
        return float(np.linalg.norm(np.maximum(np.maximum(lower - at, at - upper), 0.0)))
