"""The primitives of `take`: reach the box, grasp it, lift it off."""

import asyncio
from collections.abc import Mapping
from contextlib import suppress

from depal.cell.breadth import astray, the_other_way
from depal.cell.choosing import VAIN
from depal.cell.guards import Guards
from depal.cell.halting import HaltedError
from depal.cell.hand import Hand, Phase, most_of
from depal.cell.identity import (
    beyond_seen,
    looks_like_two,
    may_be_two,
    plausible,
    size_by_weight,
    weighs_like,
    why_not,
)
from depal.cell.payload import Payload
from depal.cell.planning.desk import Desk
from depal.cell.planning.feeling import HIGHER, RISEN
from depal.cell.planning.plans import PickPlan
from depal.cell.primitives.falling import report_loss
from depal.cell.primitives.feeling import CLOSER, seals, sucked
from depal.cell.primitives.withdrawing import out_of_view
from depal.cell.standing import Firmness
from depal.cell.workplace import Held, Workplace
from depal.domain import BoxId, Recognition
from depal.executive.engine import Report
from depal.executive.events import Outcome
from depal.executive.runtime import Context
from depal.geometry import Vector3
from depal.motion.grasping import EXACT
from depal.ports import STANDS

ARM_AT = "kr60.at"

LIGHT = 0.25
"""Where less than this share of the expected mass hangs on the arm, it holds nothing."""

NOTHING = 0.15
"""Where nobody knows what to expect, less than this is nothing [kg]."""


TORN = 0.9
"""A module whose vacuum falls below this share of what it was has lost a cup's hold."""

TWICE = 2
"""What weighs like two boxes is put back so often; then it is one of another weight."""

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
                self._work.passed_over.add(box)
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
            self._tell_a_seam(plan)
            return await self._let_go(plan, "the vacuum did not come")
        early = self._desk.feeling.early(plan) if plan.feeling else 0.0
        sealed = ports.gripper.vacuum()
        lift = self._desk.feeling.lift(plan)
        slipped = await ports.arm.follow(lift, self._guards.holding())
        weight = 1 if slipped is None else WORSE
        await asyncio.sleep(SWINGING)
        mass = ports.arm.load()
        slipped = slipped or self._payload.felt(box, mass, context.limits())
        slipped = slipped or self._torn(plan, sealed) or self._wrong_weight(plan, mass)
        if slipped is not None:
            return await self._let_go(plan, slipped, weight)
        beyond = self._beyond(plan, mass)
        if early > HIGHER:  # it stands as low as it was thought to, and is so much higher
            beyond = (*beyond[:2], max(beyond[2], early))
        self._work.lifted(Held(box, plan.grasp, size, mass, beyond))
        self._doubt_identity(plan, mass)
        out = self._desk.feeling.out(plan) if early > RISEN else None
        lost = None if out is None else await ports.arm.follow(out, self._guards.holding())
        if lost is not None:
            return await report_loss(self._work, box, lost)
        return Report(((f"{box}.taken", True),))

    def _beyond(self, plan: PickPlan, mass: float) -> Vector3:
        """How much longer the box in the hand may be than it looked; its mass tells more [kg]."""
        work, box, size = self._work, plan.box.id, plan.box.shape.size
        if not work.pile.remembered:
            return EXACT
        if isinstance(plan.box, Recognition):
            return the_other_way(size) if work.tries.get(box) else EXACT
        return astray(beyond_seen(work.delivery, size, mass), unsized=box in work.pile.unsized)

    async def _looked_at_anew(self, box: BoxId) -> str | None:
        """After a try that failed a look comes before the next one; why that is hopeless."""
        work = self._work
        if box not in work.doubted:
            return None
        await out_of_view(work, self._desk)
        work.feedback.doubt()
        work.pile.see(await work.ports.sight.look())
        if work.pile.get(box) is None or box in work.pile.hidden:
            work.passed_over.add(box)
            work.tries[box] = work.tries.get(box, 0) + 1  # it ends, however often it comes back
            return f"box {box} is not seen on the pallet any more"
        return None

    def _torn(self, plan: PickPlan, sealed: Mapping[str, float]) -> str | None:
        """What hangs on some of the cups that had sealed is held beside its middle.

        Args:
            plan: of the box.
            sealed: the vacuum of each module before the lift [Pa].
        """
        if not self._work.pile.remembered:
            return None
        now = self._work.ports.gripper.vacuum()
        if all(now[name] >= TORN * value for name, value in sealed.items()):
            return None
        self._tell_a_seam(plan)
        return "some of the cups have lost their hold"

    def _tell_a_seam(self, plan: PickPlan, *, sure: bool = False) -> None:
        """Where some cups seal and others do not, no one face is under all of them.

        Args:
            plan: of the box.
            sure: whether a print does not say otherwise: it may be that of one of two boxes.
        """
        told = isinstance(plan.box, Recognition) and not sure
        if self._work.pile.remembered and not told and seals(self._work):
            self._work.feedback.part(self._desk.feeling.under_cups(plan))

    def _wrong_weight(self, plan: PickPlan, mass: float) -> str | None:
        """What hangs on the arm is nothing, too much, or more than one box."""
        work = self._work
        limit = work.layout.robot.payload - work.layout.tool.mass
        if mass > limit:
            return f"{mass:.1f} kg is more than the arm may carry ({limit:.1f} kg)"
        least, most = self._desk.picking.masses(plan.box)
        if mass < (NOTHING if least is None else LIGHT * least):
            return f"{mass:.1f} kg hang on the arm where {plan.mass:.1f} kg were expected"
        if most is not None and mass > most_of(most):
            told = isinstance(plan.box, Recognition)
            size = size_by_weight(work.delivery, plan.box.shape.size, mass)
            if size is not None and not told:
                work.pile.resize(plan.box.id, size)  # it is another product: taken anew as that
            elif self._weighs_like_two(plan, mass):
                self._tell_a_seam(plan, sure=True)
            if size is None and not told:
                work.tries[plan.box.id] = VAIN  # it is two boxes, or part of something else
            return f"{mass:.1f} kg hang on the arm where {most:.1f} kg were the most expected"
        if work.tries.get(plan.box.id, 0) < TWICE and self._weighs_like_two(plan, mass):
            self._tell_a_seam(plan)
            return f"{mass:.1f} kg hang on the arm, which two boxes weigh together"
        return None

    def _weighs_like_two(self, plan: PickPlan, mass: float) -> bool:
        """Whether two boxes may hang on the arm where one was seen: by their weight and size."""
        work, box, size = self._work, plan.box, plan.box.shape.size
        named = work.product_of(box)
        unsized = box.id in work.pile.unsized
        products = (named,) if named else plausible(work.delivery, size, unsized=unsized)
        if may_be_two(products, work.delivery, mass):
            return True
        alone = any(weighs_like(product, mass) for product in products)
        return not alone and work.pile.remembered and looks_like_two(work.delivery, size, mass)

    def _doubt_identity(self, plan: PickPlan, mass: float) -> None:
        """A box that the picture has named must weigh what the product does, and be on the note."""
        work, box = self._work, plan.box
        if not isinstance(box, Recognition):
            return
        product = work.delivery.products.get(box.gtin)
        if product is None:
            reasons: tuple[str, ...] = (f"product {box.gtin} is not on the note",)
        else:
            unsized = box.id in work.pile.unsized
            reasons = why_not(product, box.shape.size, mass, unsized=unsized)
            too_many = work.surplus(box.gtin)
            reasons = (*reasons, too_many) if too_many else reasons
        if reasons:
            work.mistrust(box.id, reasons)
            self._desk.promises.release(box.id)

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
