"""The primitives of `leave`: carry the box to its place, set it down."""

from depal.cell.departures import Fate
from depal.cell.guards import Guards
from depal.cell.halting import moved_away
from depal.cell.hand import Phase
from depal.cell.planning.desk import Desk
from depal.cell.planning.plans import CarryPlan
from depal.cell.primitives.falling import report_loss
from depal.cell.primitives.taking import ARM_AT
from depal.cell.stock import movement_id
from depal.cell.workplace import Workplace
from depal.domain import BoxId, PlaceId
from depal.executive.engine import Report
from depal.executive.events import Outcome
from depal.executive.runtime import Context
from depal.ports import LOST, Movement


class Leaving:
    """Puts a held box where it belongs."""

    def __init__(self, work: Workplace, desk: Desk, guards: Guards) -> None:
        """Moves by the plans of the desk."""
        self._work = work
        self._desk = desk
        self._guards = guards
        self._standing: dict[BoxId, CarryPlan] = {}

    async def carry(self, context: Context) -> Report:
        """Carries the held box into its place, just above where it will stand."""
        box = BoxId(context.args["Box"])
        place = PlaceId(str(context.args.get("To") or context.facts[f"{box}.target"]))
        plan = await self._desk.carrying.carry(box, place)
        if isinstance(plan, str):
            return Report(outcome=Outcome.FAILED, reason=plan)
        if "To" not in context.args and plan.place != place:
            place = plan.place  # from where the arm is another of its places can be reached
            self._work.tell([(f"{box}.target", place)], "cell")
        await context.checkpoint()
        self._desk.viewing.clears(box, plan.motion)
        guard = self._guards.holding(lambda: context.stop_reason)
        stopped = await self._work.ports.arm.follow(plan.motion, guard)
        if stopped is not None:
            self._desk.promises.forget_carry(box)
            way_out = self._desk.carrying.way_out(plan)
            return await report_loss(self._work, box, stopped, way_out)
        return Report(((ARM_AT, place),))

    async def release(self, context: Context) -> Report:
        """Sets the box down until it stands, vents, draws back; one change of facts."""
        box = BoxId(context.args["Box"])
        lost = await self._put_down(box, Fate.STORED, "")
        if lost is not None:
            return lost
        await self._tell(box)
        return Report(((f"{box}.taken", False), (f"{box}.stored", True), (ARM_AT, None)))

    async def put(self, context: Context) -> Report:
        """The same for a box that is set aside or moved."""
        box, place = BoxId(context.args["Box"]), PlaceId(context.args["To"])
        reason = self._work.aside_reasons.get(box, "set aside")
        lost = await self._put_down(box, Fate.SET_ASIDE, reason)
        if lost is not None:
            return lost
        return Report(((f"{box}.taken", False), (f"{box}.at", place), (ARM_AT, None)))

    async def _put_down(self, box: BoxId, fate: Fate, reason: str) -> Report | None:
        """Down until it stands, then away; taken up half-way, it goes on from there."""
        plan = self._standing.get(box)
        if plan is None:
            plan = self._desk.promises.carry_in_hand(box)
            if await self._lower(plan) == LOST:
                back = self._desk.carrying.retreat(plan)
                return await report_loss(self._work, box, LOST, back)
            self._standing[box] = plan
            self._desk.promises.confirm(plan)
            self._work.ended(box, fate, plan.place, reason)
        await moved_away(self._work.ports.arm, self._desk.carrying.retreat(plan))
        return None

    async def _lower(self, plan: CarryPlan) -> str | None:
        ports, held = self._work.ports, self._work.held
        mass = held.mass if held is not None else 0.0
        guard = self._guards.setting_down(mass)
        self._work.steps(Phase.LOWERING, plan.place)
        descent = self._desk.carrying.descent(plan)
        if descent is not None and await ports.arm.follow(descent, guard) == LOST:
            return LOST
        self._work.steps(Phase.VENTING, plan.place)
        await ports.gripper.release()
        return None

    async def _tell(self, box: BoxId) -> None:
        plan = self._standing[box]
        product = self._work.product_of(box)
        gtin = product.gtin if product else None
        movement = Movement(movement_id(box, plan.place), box, gtin, plan.place, self._work.now)
        await self._work.outbox.tell(movement)
