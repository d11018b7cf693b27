"""What is said when a held box is lost."""

from depal.cell.guards import LOST
from depal.cell.workplace import Workplace
from depal.domain import BoxId
from depal.executive.engine import Report
from depal.executive.events import Outcome


def report_loss(work: Workplace, box: BoxId, reason: str) -> Report:
    """A motion with a held box has stopped early.

    A broken vacuum is a fact of the world: the box is not taken any more and lies on the floor.
    Any other reason leaves it in the gripper.
    """
    if reason == LOST:
        work.dropped(box)
    return Report(outcome=Outcome.FAILED, reason=reason)
