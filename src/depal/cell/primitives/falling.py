"""What is done and said when a held box is lost."""

from depal.cell.halting import moved_away
from depal.cell.workplace import Workplace
from depal.domain import BoxId
from depal.executive.engine import Report
from depal.executive.events import Outcome
from depal.ports import LOST, Trajectory


async def report_loss(
    work: Workplace, box: BoxId, reason: str, way_out: Trajectory | None = None
) -> Report:
    """A motion with a held box has stopped early.

    A broken vacuum is a fact of the world: the cups are vented, the arm draws back from where it
    is, and the box counts as fallen: until a person has taken it away nothing moves. Any other
    reason leaves it in the gripper.

    Args:
        work: the cell.
        box: which.
        reason: why the motion stopped.
        way_out: straight back, where the arm is inside a place.
    """
    if reason == LOST:
        await work.ports.gripper.release()
        await moved_away(work.ports.arm, way_out)
        work.dropped(box)
    return Report(outcome=Outcome.FAILED, reason=reason)
