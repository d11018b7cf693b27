"""The primitives of `take`: reach the box, grasp it, lift it off."""

import asyncio
from contextlib import suppress

from depal.cell.choosing import VAIN, why_vague
from depal.cell.guards import Guards
from depal.cell.halting import HaltedError
from depal.cell.hand import Hand, Phase
from depal.cell.payload import Payload
from depal.cell.planning.desk import Desk
from depal.cell.planning.feeling import HIGHER, RISEN
from depal.cell.planning.plans import PickPlan
from depal.cell.primitives.falling import report_loss
from depal.cell.primitives.feeling import CLOSER, seals, sucked
from depal.cell.primitives.weighing import Weighing
from depal.cell.primitives.withdrawing import out_of_view
from depal.cell.standing import Firmness
from depal.cell.workplace import Held, Workplace
from depal.domain import Approach, BoxId, Recognition
from depal.executive.engine import Report
from depal.executive.events import Outcome
from depal.executive.runtime import Context
from depal.ports import STANDS

ARM_AT = "kr60.at"

WORSE = 2
"""Where the hold breaks in the lift the box is stuck, or larger than it looks: that counts for so
many tries in vain."""

SAME = 1
"""The same side of a box is tried so often again before another one."""

LOOKING = 1.0
"""While no further box is begun it is looked this often whether this one is wanted still [s]."""

FAR, BACK = 0.08, 0.05
"""What cups touch so far above a box is another one, from which the tool backs off so far [m]."""

SWINGING = 0.06
"""After the lift the load swings so long before it is weighed [s]."""


class Taking:
    """Gets a box into the gripper."""

    def __init__(self, work: Workplace, desk: Desk, guards: Guards) -> None:
        """Moves by the plans of the desk."""
        self._work = work
        self._desk = desk
        self._guards = guards
        self._payload = Payload()
        self._weighing = Weighing(work, desk)

    async def reach(self, context: Context) -> Report:
        """Moves the gripper to the face of the box."""
        box = BoxId(context.args["Box"])
        while self._work.gate.closed:
            await self._work.gate.passed(LOOKING)
            await context.checkpoint()
        unlike = await self._looked_at_anew(box)
        if unlike is not None:
            return Report(outcome=Outcome.FAILED, reason=unlike)
        plan = await self._desk.picking.pick(box)
        if isinstance(plan, str):
            if self._work.pile.remembered:  # its neighbours look otherwise than when it was chosen
                self._pass_over(box)
            return Report(outcome=Outcome.FAILED, reason=plan)
        least, _ = self._desk.picking.masses(plan.box)
        refusal = self._payload.refusal(box, least, context.limits())
        unfirm = Firmness(self._work).refusal(box) if refusal is None else None
        refusal = unfirm.reason if unfirm is not None else refusal
        if refusal is not None:
            return Report(outcome=Outcome.FAILED, reason=refusal)
        ports = self._work.ports
        if ports.gripper.folded() != plan.grasp.folded:
            await ports.gripper.fold(up=plan.grasp.folded)
        await context.checkpoint()
        stopped = await self._approach(context, plan)
        if stopped is not None:
            return Report(outcome=Outcome.FAILED, reason=stopped)
        return Report(((ARM_AT, box),))

    async def _approach(self, context: Context, plan: PickPlan) -> str | None:
        """To the plane of touch, or to where the cups touch something before; why it stopped."""
        follow, guards = self._work.ports.arm.follow, self._guards
        stopped = await follow(plan.approach, guards.asked_to_stop(context))
        if plan.down is None or stopped is not None:
            return stopped
        stopped = await follow(plan.down, guards.touching(lambda: context.stop_reason))
        if stopped != STANDS:
            return stopped
        feeling, box = self._desk.feeling, plan.box.id
        early = feeling.early(plan)
        if early > FAR:
            back = feeling.nearer(plan, -BACK)
            if back is not None:
                await follow(back, guards.asked_to_stop(context))
            self._work.doubted.setdefault(box, frozenset())
            return f"something stands {early:.2f} m above box {box}"
        closer = feeling.nearer(plan, CLOSER)
        return None if closer is None else await follow(closer, guards.asked_to_stop(context))

    async def grasp(self, context: Context) -> Report:
        """Suction on, then a short lift; retreats where the vacuum does not come."""
        box = BoxId(context.args["Box"])
        plan = self._desk.promises.pick_in_hand(box)
        ports = self._work.ports
        size = plan.box.shape.size
        self._work.begins(Hand(box, plan.grasp, size, plan.mass, Phase.GRASPING))
        came = await sucked(self._work, self._desk, plan, self._guards)
        self._work.modules.tried(box, {name for name, _ in plan.grasp.cups}, ports.gripper.vacuum())
        if not came:
            self._weighing.tell_a_seam(plan)
            if plan.grasp.approach is Approach.VERTICAL and seals(self._work):
                self._work.leaks[box] += 1
            return await self._let_go(plan, "the vacuum did not come")
        early = self._desk.feeling.early(plan) if plan.feeling else 0.0
        sealed = ports.gripper.vacuum()
        lift = self._desk.feeling.lift(plan)
        slipped = await ports.arm.follow(lift, self._guards.holding())
        weight = 1 if slipped is None else WORSE
        await asyncio.sleep(SWINGING)
        mass = ports.arm.load()
        weighing = self._weighing
        slipped = slipped or self._payload.felt(box, mass, context.limits())
        slipped = slipped or weighing.torn(plan, sealed) or weighing.wrong_weight(plan, mass)
        if slipped is not None:
            return await self._let_go(plan, slipped, weight)
        beyond = self._weighing.beyond(plan, mass)
        if early > HIGHER:  # it stands as low as it was thought to, and is so much higher
            beyond = (*beyond[:2], max(beyond[2], early))
        self._work.lifted(Held(box, plan.grasp, size, mass, beyond))
        self._weighing.doubt_identity(plan, mass)
        out = self._desk.feeling.out(plan) if early > RISEN else None
        lost = None if out is None else await ports.arm.follow(out, self._guards.holding())
        if lost is not None:
            return await report_loss(self._work, box, lost)
        return Report(((f"{box}.taken", True),))

    async def _looked_at_anew(self, box: BoxId) -> str | None:
        """After a try that failed a look comes before the next one; why that is hopeless."""
        work = self._work
        if box not in work.doubted:
            return None
        await out_of_view(work, self._desk)
        work.feedback.doubt()
        work.pile.see(await work.ports.sight.look())
        seen = work.pile.get(box)
        if seen is None or box in work.pile.hidden:
            self._pass_over(box)
            return f"box {box} is not seen on the pallet any more"
        vague = why_vague(work, seen)
        if vague is not None:
            self._pass_over(box)
        return vague

    def _pass_over(self, box: BoxId) -> None:
        """The box may be chosen anew: that counts as a try, so that it ends however often."""
        work = self._work
        work.passed_over.add(box)
        work.tries[box] = work.tries.get(box, 0) + 1

    async def _let_go(self, plan: PickPlan, reason: str, weight: int = 1) -> Report:
        """Vents, draws back out of the view, and lets the box be approached anew.

        Args:
            plan: of the box.
            reason: why it is not taken.
            weight: so many tries in vain this one counts for, of a box that no print has named.
        """
        ports, box = self._work.ports, plan.box.id
        await ports.gripper.release()
        self._work.lets_go()
        with suppress(HaltedError):  # it has drawn back by itself
            for retreat in self._desk.picking.way_back(plan):
                await ports.arm.follow(retreat)
        self._desk.promises.forget_pick(box)
        told = isinstance(plan.box, Recognition) or not self._work.pile.remembered
        counted = 1 if told else weight
        self._work.tries[box] = tries = self._work.tries.get(box, 0) + counted
        failed = self._work.doubted.get(box, frozenset())
        if tries > SAME:
            failed |= {plan.grasp.approach}
        self._work.doubted[box] = failed
        if tries >= VAIN and not told:
            self._work.deny(plan.box)  # something else stands there, or nothing
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
