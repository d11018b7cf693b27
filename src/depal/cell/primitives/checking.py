"""The primitives of `check`: show the held box to the reader, read its barcode."""

from depal.cell.guards import Guards
from depal.cell.planning.desk import Desk
from depal.cell.planning.plans import ShowPlan
from depal.cell.primitives.falling import report_loss
from depal.cell.primitives.taking import ARM_AT
from depal.cell.workplace import Workplace
from depal.domain import BoxId, Gtin
from depal.executive.engine import Report
from depal.executive.events import Outcome
from depal.executive.runtime import Context
from depal.ports import Question

READER = "reader"

UNKNOWN = "I cannot tell"


class Checking:
    """Finds out which product a held box is."""

    def __init__(self, work: Workplace, desk: Desk, guards: Guards) -> None:
        """Moves by the plans of the desk."""
        self._work = work
        self._desk = desk
        self._guards = guards
        self._shown: ShowPlan | None = None

    async def show(self, context: Context) -> Report:
        """Carries the held box to the reader."""
        box = BoxId(context.args["Box"])
        plan = await self._desk.presenting.show(box)
        if isinstance(plan, str):
            return await self._ask(box, plan)
        await context.checkpoint()
        follow = self._work.ports.arm.follow
        self._desk.viewing.clears(box, plan.first)
        stopped = await follow(plan.first, self._guards.holding(lambda: context.stop_reason))
        if stopped is not None:
            return await report_loss(self._work, box, stopped)
        self._shown = plan
        return Report(((ARM_AT, READER),))

    async def read(self, context: Context) -> Report:
        """Reads side by side until a code is one of the delivery's products."""
        box = BoxId(context.args["Box"])
        plan, work = self._shown, self._work
        seen: list[str] = []
        for turn in (None, *(plan.turns if plan is not None else ())):
            if turn is not None:
                stopped = await work.ports.arm.follow(turn, self._guards.holding())
                if stopped is not None:
                    return await report_loss(work, box, stopped)
            codes = await work.ports.reader.read()
            seen += [code for code in codes if code not in seen]
            known = [Gtin(code) for code in codes if Gtin(code) in work.delivery.products]
            if len(set(known)) == 1:
                return self._is(box, known[0])
        return await self._ask(box, f"the reader saw {', '.join(seen) or 'no code'}")

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
            return self._is(box, Gtin(answer))
        return Report(outcome=Outcome.FAILED, reason=f"nobody knows the product: {why}")

    def _is(self, box: BoxId, gtin: Gtin) -> Report:
        work = self._work
        work.pile.identify(box, gtin)
        work.wishes.identified(box, gtin, work.now)
        return Report(((f"{box}.known", True), (f"{box}.product", str(gtin))))
