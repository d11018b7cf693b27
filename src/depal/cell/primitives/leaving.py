"""The primitives of `query` and `leave`: find a place, carry the box there, set it down."""

from depal.cell.departures import Fate
from depal.cell.guards import LOST, Guards
from depal.cell.planning.desk import Desk
from depal.cell.planning.plans import CarryPlan
from depal.cell.primitives.falling import report_loss
from depal.cell.primitives.taking import ARM_AT
from depal.cell.workplace import Workplace
from depal.domain import BoxId, PlaceId
from depal.executive.engine import Report
from depal.executive.events import Outcome
from depal.executive.runtime import Context
from depal.ports import Movement


class Leaving:
    """Puts a held box where it belongs."""

    def __init__(self, work: Workplace, desk: Desk, guards: Guards) -> None:
        """Moves by the plans of the desk."""
        self._work = work
        self._desk = desk
        self._guards = guards

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
            return report_loss(self._work, box, stopped)
        return Report(((ARM_AT, place),))

    async def release(self, context: Context) -> Report:
        """Sets the box down until it stands, vents, draws back; one change of facts."""
        box = BoxId(context.args["Box"])
        plan = self._desk.promises.carry_in_hand(box)
        stopped = await self._set_down(plan)
        if stopped is not None:
            return report_loss(self._work, box, stopped)
        self._work.ended(box, Fate.STORED, plan.place)
        await self._tell(box, plan)
        return Report(((f"{box}.taken", False), (f"{box}.stored", True), (ARM_AT, None)))

    async def put(self, context: Context) -> Report:
        """The same for a box that is set aside or moved."""
        box, place = BoxId(context.args["Box"]), PlaceId(context.args["To"])
        plan = self._desk.promises.carry_in_hand(box)
        stopped = await self._set_down(plan)
        if stopped is not None:
            return report_loss(self._work, box, stopped)
        reason = self._work.aside_reasons.get(box, "set aside")
        self._work.ended(box, Fate.SET_ASIDE, plan.place, reason)
        return Report(((f"{box}.taken", False), (f"{box}.at", place), (ARM_AT, None)))

    async def _set_down(self, plan: CarryPlan) -> str | None:
        ports, held = self._work.ports, self._work.held
        mass = held.mass if held is not None else 0.0
        lost = self._guards.holding(self._guards.touches_down(mass))
        if await ports.arm.follow(plan.descent, lost) == LOST:
            return LOST
        await ports.gripper.release()
        self._desk.promises.confirm(plan)
        retreat = self._desk.carrying.retreat(plan)
        if retreat is not None:
            await ports.arm.follow(retreat)
        return None

    async def _tell(self, box: BoxId, plan: CarryPlan) -> None:
        product = self._work.product_of(box)
        gtin = product.gtin if product else None
        movement = Movement(f"{box}@{plan.place}", box, gtin, plan.place, self._work.now)
        await self._work.ports.store.moved(movement)
