"""The gripper feels for a face that is not quite where it looked.

A camera measures the distance of a face worse than a bellows reaches. Where no cup seals, the
plane of touch is moved along the approach, first back and then forth, until one does. Forth it goes
no farther than until the cups touch something: where they do and none seals, the face is another.
What pushes the tool back from the front is not felt: before a front that may stand nearer than it
looks the tool stops short, and goes forth alone.
"""

from depal.cell.guards import PRESSING, Guards
from depal.cell.planning.desk import Desk
from depal.cell.planning.plans import PickPlan
from depal.cell.workplace import Workplace

STEPS = (-0.009, 0.009, 0.018)
"""Where the plane of touch is tried after it was tried where the face seems to be [m]: together
with the stroke of the bellows, behind it and before it, these leave no gap."""

FORTH = (-0.009, 0.0, 0.009, 0.018)
"""The same from short of the face [m]."""

CLOSER = 0.005
"""From where the first cup touches all of them are pressed on by so much [m]."""

SEALED = 1.0
"""With more vacuum than this some cup seals: the distance is right, and something else is not."""


async def sucked(work: Workplace, desk: Desk, plan: PickPlan, guards: Guards) -> bool:
    """Suction on; where no cup seals, nearer and farther; whether the vacuum came."""
    gripper, arm = work.ports.gripper, work.ports.arm
    if await gripper.suck(plan.grasp.cups):
        return True
    done, spare = -plan.short, bool(plan.short)
    for step in FORTH if plan.short else STEPS:
        forth, sealed = step > done, seals(work)
        # From short of a face that stands askew some cups seal first: one step more, and no other.
        if (sealed and not spare) or (forth and arm.load() < -PRESSING):
            return False
        spare = spare and not sealed
        motion = desk.feeling.nearer(plan, step - done)
        if motion is None:
            return False
        touched = await arm.follow(motion, guards.touching() if forth else None)
        closer = desk.feeling.nearer(plan, CLOSER) if touched is not None else None
        if closer is not None:
            await arm.follow(closer)
        done = step
        if await gripper.suck(plan.grasp.cups):
            return True
        if touched is not None:
            return False
    return False


def seals(work: Workplace) -> bool:
    """Whether some cup has sealed."""
    return max(work.ports.gripper.vacuum().values(), default=0.0) > SEALED
