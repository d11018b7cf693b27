"""The gripper feels for a face that is not quite where it looked.

A camera measures the distance of a face worse than a bellows reaches. Where no cup seals, the
plane of touch is moved along the approach, first back and then forth, until one does.
"""

import numpy as np

from depal.cell.planning.desk import Desk
from depal.cell.planning.plans import PickPlan
from depal.cell.planning.timing import rebased
from depal.cell.workplace import Workplace
from depal.geometry import OrientedBox, Pose
from depal.motion.moves import CLOSE, Kind, Part
from depal.motion.moves.picking import into_face
from depal.motion.planning.straight import straight
from depal.ports import Trajectory

STEPS = (-0.009, 0.009, 0.018)
"""Where the plane of touch is tried after it was tried where the face seems to be [m]: together
with the stroke of the bellows, behind it and before it, these leave no gap."""

FINE = 0.003
"""Of the paths between them [m]."""

THIN = 0.002
"""A flat place is so deep [m]."""

SEALED = 1.0
"""With more vacuum than this some cup seals: the distance is right, and something else is not."""


async def sucked(work: Workplace, desk: Desk, plan: PickPlan) -> bool:
    """Suction on; where no cup seals, nearer and farther; whether the vacuum came."""
    gripper, arm = work.ports.gripper, work.ports.arm
    done = 0.0
    for step in (0.0, *STEPS):
        if step:
            motion = _along(work, desk, plan, step - done)
            if motion is None:
                return False
            await arm.follow(motion)
            done = step
        if await gripper.suck(plan.grasp.cups):
            return True
        if seals(work):
            return False
    return False


def seals(work: Workplace) -> bool:
    """Whether some cup has sealed."""
    return max(work.ports.gripper.vacuum().values(), default=0.0) > SEALED


def under_cups(work: Workplace, desk: Desk, plan: PickPlan) -> OrientedBox:
    """The flat place that the plan's cups touch where the arm stands, in the cell frame."""
    tool, folded = work.layout.tool, plan.grasp.folded
    flange = desk.planner.mover.body.kinematics.flange(work.ports.arm.joints())
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


def lifted_from(desk: Desk, plan: PickPlan) -> Trajectory:
    """The plan's lift from where the cups have sealed."""
    planner = desk.planner
    part = plan.pick.lift
    if np.allclose(planner.here, part.path[0], atol=1e-4):
        return plan.lift
    path = rebased(part.path, planner.here)
    return planner.timing.slowly(Part(part.kind, path, part.touching)) or plan.lift


def _along(work: Workplace, desk: Desk, plan: PickPlan, way: float) -> Trajectory | None:
    """Straight along the approach by so much [m]; None where something is in the way."""
    planner = desk.planner
    kinematics = planner.mover.body.kinematics
    x, y, z = into_face(kinematics.flange(planner.here), plan.grasp, work.layout)
    path = straight(kinematics, planner.here, (x * way, y * way, z * way), pitch=FINE)
    if path is None:
        return None
    scene = desk.promises.scene(work.pile, without=plan.box.id)
    checker = planner.mover.checker(scene, CLOSE, folded=plan.grasp.folded)
    if way > 0.0 and checker.first_hit(path) is not None:
        return None
    return planner.timing.slowly(Part(Kind.STRAIGHT, path, touching=True))
