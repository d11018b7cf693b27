"""The primitives of `take`: reach the box, grasp it, lift it off."""

from depal.cell.guards import Guards
from depal.cell.planning.desk import Desk
from depal.cell.planning.plans import PickPlan
from depal.cell.workplace import Workplace
from depal.domain import BoxId
from depal.executive.engine import Report
from depal.executive.events import Outcome
from depal.executive.runtime import Context

ARM_AT = "kr60.at"

LIGHT = 0.25
"""Where less than this share of the expected mass hangs on the arm, it holds nothing."""


class Taking:
    """Gets a box into the gripper."""

    def __init__(self, work: Workplace, desk: Desk, guards: Guards) -> None:
        """Moves by the plans of the desk."""
        self._work = work
        self._desk = desk
        self._guards = guards

    async def reach(self, context: Context) -> Report:
        """Moves the gripper to the face of the box."""
        box = BoxId(context.args["Box"])
        plan = await self._desk.picking.pick(box)
        if isinstance(plan, str):
            return Report(outcome=Outcome.FAILED, reason=plan)
        ports = self._work.ports
        if ports.gripper.folded() != plan.grasp.folded:
            await ports.gripper.fold(up=plan.grasp.folded)
        await context.checkpoint()
        stopped = await ports.arm.follow(plan.approach, self._guards.asked_to_stop(context))
        if stopped is not None:
            return Report(outcome=Outcome.FAILED, reason=stopped)
        return Report(((ARM_AT, box),))

    async def grasp(self, context: Context) -> Report:
        """Suction on, then a short lift; retreats where the vacuum does not come."""
        box = BoxId(context.args["Box"])
        plan = self._desk.promises.pick_in_hand(box)
        ports = self._work.ports
        if not await ports.gripper.suck(plan.grasp.cups):
            return await self._let_go(plan, "the vacuum did not come")
        slipped = await ports.arm.follow(plan.lift, self._guards.holding())
        mass = ports.arm.load()
        limit = self._work.layout.robot.payload - self._work.layout.tool.mass
        if slipped is None and mass > limit:
            slipped = f"{mass:.1f} kg is more than the arm may carry ({limit:.1f} kg)"
        if slipped is None and mass < LIGHT * plan.mass:
            slipped = f"{mass:.1f} kg hang on the arm where {plan.mass:.1f} kg were expected"
        if slipped is not None:
            return await self._let_go(plan, slipped)
        self._work.lifted(box, plan.grasp, plan.box.shape.size, mass)
        return Report(((f"{box}.taken", True),))

    async def _let_go(self, plan: PickPlan, reason: str) -> Report:
        """Vents, draws back, and lets the box be approached anew."""
        ports = self._work.ports
        await ports.gripper.release()
        retreat = self._desk.picking.draw_back(plan)
        if retreat is not None:
            await ports.arm.follow(retreat)
        self._desk.promises.forget_pick(plan.box.id)
        return Report(((ARM_AT, None),), Outcome.FAILED, reason)

    async def probe_arm(self, context: Context) -> Report:
        """After a restart: the arm is nowhere that is known, so every motion is planned anew."""
        del context
        return Report(((ARM_AT, None),))

    async def probe_gripper(self, context: Context) -> Report:
        """After a restart: whether the gripper holds something."""
        box = context.args["Box"]
        taken = any(value > 0.0 for value in self._work.ports.gripper.vacuum().values())
        return Report(((f"{box}.taken", taken),))
