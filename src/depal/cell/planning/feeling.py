"""The small motions with which the gripper feels for a face that is not quite where it looked."""

import numpy as np

from depal.cell.planning.loads import WARY
from depal.cell.planning.planner import Planner
from depal.cell.planning.plans import PickPlan
from depal.cell.planning.promises import Promises
from depal.cell.planning.timing import rebased
from depal.cell.workplace import Workplace
from depal.geometry import OrientedBox, Pose
from depal.motion.collision.values import Array
from depal.motion.grasping import Holding
from depal.motion.moves import CLOSE, Kind, Part
from depal.motion.moves.picking import into_face
from depal.motion.planning.straight import straight
from depal.ports import Trajectory

FINE = 0.003
"""Of the paths [m]."""

HIGHER = 0.015
"""Where cups have sealed so far above the plane of touch, the box is higher than it looked [m]."""

RISEN = 0.001
"""Where they have sealed so far above it the box is lifted as far as was planned, from there: a
lift that ended where it was planned to would leave the bellows pressed in [m]."""

THIN = 0.002
"""A flat place is so deep [m]."""


class Feeling:
    """Plans around the plane of touch."""

    def __init__(self, work: Workplace, planner: Planner, promises: Promises) -> None:
        """At the boxes of this cell."""
        self._work = work
        self._planner = planner
        self._promises = promises

    def nearer(self, plan: PickPlan, way: float) -> Trajectory | None:
        """Straight along the approach by so much [m]; None where something is in the way."""
        planner, work = self._planner, self._work
        kinematics = planner.mover.body.kinematics
        x, y, z = into_face(kinematics.flange(planner.here), plan.grasp, work.layout)
        path = straight(kinematics, planner.here, (x * way, y * way, z * way), pitch=FINE)
        if path is None:
            return None
        scene = self._promises.scene(work.pile, plan.box.id, work.bounds.zones)
        checker = planner.mover.checker(scene, CLOSE, folded=plan.grasp.folded)
        if way > 0.0 and checker.first_hit(path) is not None:
            return None
        return planner.timing.slowly(Part(Kind.STRAIGHT, path, touching=True))

    def early(self, plan: PickPlan) -> float:
        """How far above the plane of touch the arm stands, on something that is higher [m]."""
        flange = self._planner.mover.body.kinematics.flange
        here, there = flange(self._planner.here), flange(plan.pick.approach[-1].path[-1])
        return here.translation[2] - there.translation[2]

    def lift(self, plan: PickPlan) -> Trajectory:
        """The plan's lift from where the cups have sealed; as far up from a face that is higher."""
        planner, part = self._planner, plan.pick.lift
        if np.allclose(planner.here, part.path[0], atol=1e-4):
            return plan.lift
        path = rebased(part.path, planner.here)
        if plan.feeling and self.early(plan) > RISEN:
            up = self._as_far(part)
            path = path if up is None else up
        return planner.timing.slowly(Part(part.kind, path, part.touching)) or plan.lift

    def out(self, plan: PickPlan) -> Trajectory | None:
        """As far as the plan's way out of the pile, from where a box hangs that was higher."""
        planner, part = self._planner, plan.pick.out
        path = self._as_far(part)
        if path is None:
            return None
        size = plan.box.shape.size
        holding = Holding.of(plan.grasp, plan.mass, self._work.layout.tool, size=size)
        return planner.timing.along([Part(part.kind, path, part.touching)], holding, pace=WARY)

    def _as_far(self, part: Part) -> Array | None:
        """Straight from where the arm stands, as a straight part goes from where it begins."""
        kinematics = self._planner.mover.body.kinematics
        begin, end = (kinematics.flange(row).translation for row in (part.path[0], part.path[-1]))
        x, y, z = np.subtract(end, begin).tolist()
        return straight(kinematics, self._planner.here, (x, y, z), pitch=FINE)

    def under_cups(self, plan: PickPlan) -> OrientedBox:
        """The flat place that the plan's cups touch where the arm stands, in the cell frame."""
        tool, folded = self._work.layout.tool, plan.grasp.folded
        flange = self._planner.mover.body.kinematics.flange(self._work.ports.arm.joints())
        faces = {
            module.name: (module, flange @ tool.module(module.name, folded=folded).flange_from_face)
            for module in tool.modules
        }
        first = faces[plan.grasp.cups[0][0]][1]
        points = []
        for name, index in plan.grasp.cups:
            module, face = faces[name]
            points.append(first.inverse.apply(face.apply((0.0, *module.cups[index]))))
        low, high = np.min(points, axis=0), np.max(points, axis=0)
        radius = tool.suction.cup_radius
        x, y, z = ((low + high) / 2).tolist()
        _, wide, tall = (high - low + 2 * radius).tolist()
        middle = Pose(first.apply((x, y, z)), first.rotation)
        return OrientedBox(middle, (THIN, wide, tall))
