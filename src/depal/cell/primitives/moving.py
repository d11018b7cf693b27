"""The primitive of `move` that differs: reach a box that stands in a place."""

from depal.cell.guards import Guards
from depal.cell.planning.desk import Desk
from depal.cell.primitives.taking import ARM_AT
from depal.cell.workplace import Workplace
from depal.domain import BoxId, PlaceId
from depal.executive.engine import Report
from depal.executive.events import Outcome
from depal.executive.runtime import Context


class Moving:
    """Gets boxes out of places."""

    def __init__(self, work: Workplace, desk: Desk, guards: Guards) -> None:
        """Moves by the plans of the desk."""
        self._work = work
        self._desk = desk
        self._guards = guards

    async def reach_into(self, context: Context) -> Report:
        """Moves the gripper into a place, to the face of a box that stands there."""
        box, place = BoxId(context.args["Box"]), PlaceId(context.args["From"])
        plan = await self._desk.picking.pick_from(box, place)
        if isinstance(plan, str):
            return Report(outcome=Outcome.FAILED, reason=plan)
        await context.checkpoint()
        stopped = await self._work.ports.arm.follow(
            plan.approach, self._guards.asked_to_stop(context)
        )
        if stopped is not None:
            return Report(outcome=Outcome.FAILED, reason=stopped)
        return Report(((ARM_AT, box),))
