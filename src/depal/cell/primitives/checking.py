"""The primitives of `check`: show the held box to the reader, read its barcode."""

from collections import Counter
from dataclasses import replace

from depal.cell.breadth import astray
from depal.cell.choosing import GAVE_UP
from depal.cell.guards import Guards
from depal.cell.hand import Phase
from depal.cell.identity import fits, may_be_two, told_size, weighs_like, why_not
from depal.cell.mistaken import sizes_of_the_mistaken
from depal.cell.planning.desk import Desk
from depal.cell.planning.plans import ShowPlan
from depal.cell.primitives.falling import report_loss
from depal.cell.primitives.taking import ARM_AT
from depal.cell.workplace import Workplace
from depal.domain import BoxId, Gtin, Product
from depal.executive.engine import Report
from depal.executive.events import Outcome
from depal.executive.runtime import Context
from depal.geometry import Vector3
from depal.logistics.gtin import gtin_fault
from depal.motion.grasping import resized
from depal.ports import Question

READER = "reader"

UNKNOWN = "I cannot tell"

TWICE = 2
"""A code that is not on the note is believed when it was read so often."""


class Checking:
    """Finds out which product a held box is."""

    def __init__(self, work: Workplace, desk: Desk, guards: Guards) -> None:
        """Moves by the plans of the desk."""
        self._work = work
        self._desk = desk
        self._guards = guards
        self._shown: ShowPlan | None = None
        self._searched: set[BoxId] = set()
        self._refused: dict[BoxId, str] = {}

    async def show(self, context: Context) -> Report:
        """Carries the held box to the reader."""
        box, work = BoxId(context.args["Box"]), self._work
        plan = await self._desk.presenting.show(box)
        if isinstance(plan, str):
            if GAVE_UP in plan and box not in self._searched:
                self._searched.add(box)  # another search may find what this one has not
                return Report(outcome=Outcome.FAILED, reason=plan)
            told = await self._ask(box, plan)
            if told.outcome is Outcome.DONE:  # what a person says is no effect of a motion
                work.tell(told.facts, "person")
                return Report()
            return told
        await context.checkpoint()
        follow = work.ports.arm.follow
        self._desk.viewing.clears(box, plan.first)
        stopped = await follow(plan.first, self._guards.holding(lambda: context.stop_reason))
        if stopped is not None:
            return await report_loss(work, box, stopped)
        self._shown = plan
        return Report(((ARM_AT, READER),))

    async def read(self, context: Context) -> Report:
        """Reads side by side until a code is one of the delivery's products."""
        box = BoxId(context.args["Box"])
        plan, work = self._shown, self._work
        if box in self._refused:
            return Report(outcome=Outcome.FAILED, reason=self._refused[box])
        seen: Counter[str] = Counter()
        for turn in (None, *(plan.turns if plan is not None else ())):
            if turn is not None:
                stopped = await work.ports.arm.follow(turn, self._guards.holding())
                if stopped is not None:
                    return await report_loss(work, box, stopped)
            codes = await work.ports.reader.read()
            seen.update(codes)
            known = [Gtin(code) for code in codes if Gtin(code) in work.delivery.products]
            if len(set(known)) == 1:
                return self._judged(box, known[0])
        self._shown = None  # every side was shown
        strange = [
            code for code, times in seen.items() if times >= TWICE and gtin_fault(code) is None
        ]
        if len(strange) == 1:
            work.strangers[box] = strange[0]
            return self._refuse(box, f"product {strange[0]} is not on the note")
        if not seen:
            return self._refuse(box, "no side of it shows a label that can be read")
        return await self._ask(box, f"the reader saw {', '.join(seen)}")

    async def _ask(self, box: BoxId, why: str) -> Report:
        """Nobody but a person can tell."""
        products = self._work.delivery.products
        question = Question(
            f"product/{box}",
            f"Which product is the box in the gripper ({box})? {why[:1].upper()}{why[1:]}.",
            (*products, UNKNOWN),
            str(box),
        )
        answer = await self._work.questions.ask(question)
        if answer in products:
            return self._judged(box, Gtin(answer))
        return self._refuse(box, f"nobody knows the product: {why}")

    def _judged(self, box: BoxId, gtin: Gtin) -> Report:
        """Somebody has told the product: it must weigh so, fit so, and be promised still."""
        work = self._work
        product, held = work.delivery.products[gtin], work.held
        if held is None:
            return Report(outcome=Outcome.FAILED, reason=f"box {box} is not held")
        mass = work.ports.arm.load()
        work.held = held = replace(held, mass=mass)
        # One edge may have been seen wrongly: a code and a weight that agree outweigh it.
        unsized = work.pile.remembered or box in work.pile.unsized
        reasons = why_not(product, held.size, mass, unsized=unsized)
        if reasons:
            if work.pile.remembered and not fits(product, held.size, unsized=True):
                work.unplaceable.add(box)  # where it ends beside the cups nobody knows
                self._tell_of_the_like(product, held.size, mass)
            if may_be_two((product,), work.delivery, mass):
                work.unplaceable.add(box)
                reasons = (*reasons, "two boxes weigh so together")
            return self._refuse(box, "; ".join(reasons))
        work.pile.identify(box, gtin)
        too_many = work.surplus(gtin)
        if too_many is not None:
            return self._refuse(box, too_many)
        if work.pile.remembered and not fits(product, held.size):
            self._tell_of_the_like(product, held.size, mass)
        size, beyond = told_size(product.size, held.size)
        if work.pile.remembered:  # what it is does not tell where it was
            beyond = astray(beyond, unsized=held.beyond[2] > 0.0)
        grasp = resized(held.grasp, held.size, size)
        work.held = replace(held, size=size, grasp=grasp, beyond=beyond)
        work.steps(Phase.HELD)
        work.feedback.learn(box, product)
        work.aside_reasons.pop(box, None)
        work.wishes.identified(box, gtin, work.now)
        return Report(((f"{box}.known", True), (f"{box}.product", str(gtin))))

    def _tell_of_the_like(self, product: Product, seen: Vector3, mass: float) -> None:
        """What looks like a box that turned out to be another one may be one of those too."""
        work = self._work
        if not weighs_like(product, mass):
            return
        pile, delivery = work.pile, work.delivery
        sizes = sizes_of_the_mistaken(seen, product, pile.boxes, delivery, pile.left_as)
        for box, size in sizes.items():
            pile.resize(box, size)

    def _refuse(self, box: BoxId, reason: str) -> Report:
        """Nothing is stored under a name that something speaks against."""
        before = self._work.aside_reasons.get(box)
        self._refused[box] = f"{before}; {reason}" if before and before != reason else reason
        return Report(outcome=Outcome.FAILED, reason=self._refused[box])
