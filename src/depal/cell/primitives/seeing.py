"""The primitives of `depalletize`: look, select, wait until the box has left."""

from depal.cell.choosing import Choice, choose, priority_of
from depal.cell.departures import Fate
from depal.cell.planning.desk import Desk
from depal.cell.reporting import Journalist
from depal.cell.workplace import Workplace
from depal.domain import BoxId, Recognition
from depal.executive.engine import Call, Report
from depal.executive.events import Change
from depal.executive.runtime import Context
from depal.ports import TAKEN, Question
from depal.selection import Outcome as Selected


class Seeing:
    """Looks at the pallet and chooses from it."""

    def __init__(self, work: Workplace, desk: Desk, notes: Journalist) -> None:
        """Works on what the cell believes."""
        self._work = work
        self._desk = desk
        self._notes = notes

    async def look(self, context: Context) -> Report:
        """Takes a picture and finds the boxes; what it learns of each is a fact of its own."""
        work = self._work
        view = await work.ports.sight.look()
        work.pile.see(view)
        learned: list[Change] = []
        for box in work.pile.boxes:
            if isinstance(box, Recognition) and not context.facts.get(f"{box.id}.known"):
                learned += [(f"{box.id}.known", True), (f"{box.id}.product", str(box.gtin))]
        if learned:
            work.tell(learned, "camera")
        pallet = context.args["Pallet"]
        return Report(((f"{pallet}.seen", True), (f"{pallet}.empty", not len(work.pile))))

    async def select_box(self, context: Context) -> Report:
        """Algorithm 1; what cannot be grasped at all is left to a person."""
        work, pallet = self._work, context.args["Pallet"]
        choice = choose(work, self._desk)
        await self._desk.planner.charge(choice.plans)
        decision = choice.decision
        self._notes.chose(work.now, decision)
        if decision.target is None or decision.grasp is None:
            return await self._stuck(choice, pallet)
        box = decision.target.id
        self._desk.promises.keep_pick(decision.grasp)
        store = Call("store", (box,), priority_of(decision, box))
        return Report(((f"{pallet}.next", box),), allocate=(store,))

    async def await_box(self, context: Context) -> Report:
        """Waits until the chosen box has left the pallet and the view is clear."""
        pallet = context.args["Pallet"]
        box = BoxId(str(context.facts[f"{pallet}.next"]))
        await self._work.gone(box).wait()
        return Report(((f"{pallet}.next", None), (f"{pallet}.seen", False)))

    async def _stuck(self, choice: Choice, pallet: str) -> Report:
        """Nothing can be grasped: a person takes the box with the best score that is free."""
        verdicts = choice.decision.verdicts
        if choice.decision.outcome is Selected.NOTHING_PERCEIVED or not verdicts:
            return Report(((f"{pallet}.seen", False),), reason="no box is seen")
        free = [verdict for verdict in verdicts if not verdict.blockers] or list(verdicts)
        box, reason = free[0].box, free[0].reason
        question = Question(
            f"take/{box.id}",
            f"The arm cannot take box {box.id}: {reason}. Please take it off the pallet.",
            (TAKEN,),
            str(box.id),
        )
        await self._work.questions.ask(question)
        self._work.ended(box.id, Fate.BY_PERSON, reason=reason)
        return Report(((f"{pallet}.seen", False),), reason=reason)
