"""The primitives of `depalletize`: look, select, wait until the box has left."""

import asyncio
from collections.abc import Sequence

from depal.cell.choosing import Choice, choose, may_pass, priority_of
from depal.cell.departures import Fate
from depal.cell.planning.desk import Desk
from depal.cell.reporting import Journalist
from depal.cell.workplace import Workplace
from depal.domain import BoxId, Gtin, Perceived, Recognition
from depal.executive.engine import Call, Report
from depal.executive.events import Change, Outcome
from depal.executive.runtime import Context
from depal.ports import TAKEN, Question, View
from depal.selection import Outcome as Selected

AGAIN = 5
"""Before a person is asked for a box that looks differ about, the cell looks so often again."""

LATER = 1.0
"""Where a box has vanished another look comes so much later [s]."""

BLANK = 2
"""Before a pallet that should hold boxes counts as empty, the cell looks so often again."""

ABSENT = "it is not there"
"""A person has looked, and there is no such box."""

ABSENCES = 3
"""A person is sent so often in a row for a box that is not there."""

UNSHOWN = "unshown"
"""What boxes are called that the note promises and no look shows, when a person is asked."""


class Seeing:
    """Looks at the pallet and chooses from it."""

    def __init__(self, work: Workplace, desk: Desk, notes: Journalist) -> None:
        """Works on what the cell believes."""
        self._work = work
        self._desk = desk
        self._notes = notes
        self._again = self._blank = self._absent = 0
        self._doubted: set[BoxId] = set()

    async def look(self, context: Context) -> Report:
        """Takes a picture and finds the boxes; what it learns of each is a fact of its own."""
        work = self._work
        before = work.pile.boxes
        view = await work.ports.sight.look()
        if self._vanished(before, view):
            await asyncio.sleep(LATER)
            view = await work.ports.sight.look()
        fallen = self._vanished(before, view)
        work.pile.see(view)
        for lost in fallen:
            work.fallen(lost.id)
        work.keep()
        for box in view.moved:
            work.left_behind.pop(box, None)  # what was not possible there may be here
        learned = self._learned(context)
        if learned:
            work.tell(learned, "camera")
        if len(work.pile):
            self._blank = 0
        pallet = context.args["Pallet"]
        empty = not len(work.pile) and (work.seen_to or not self._expected())
        return Report(((f"{pallet}.seen", True), (f"{pallet}.empty", empty)))

    def _vanished(self, before: Sequence[Perceived], view: View) -> tuple[Perceived, ...]:
        """What nothing stood before, nobody has taken, and this look shows no more.

        A sight that remembers tells for itself what is hidden.
        """
        if view.remembered:
            return ()
        seen = {box.id for box in view.boxes}
        left = self._work.departures.has_left
        return tuple(box for box in before if box.id not in seen and not left(box.id))

    def _learned(self, context: Context) -> list[Change]:
        """What the picture tells of products; it may also take back what it told before."""
        learned: list[Change] = []
        for box in self._work.pile.boxes:
            gtin = str(box.gtin) if isinstance(box, Recognition) else None
            known = context.facts.get(f"{box.id}.product")
            if gtin != known and not context.facts.get(f"{box.id}.taken"):
                learned += [(f"{box.id}.known", gtin is not None), (f"{box.id}.product", gtin)]
        return learned

    def _expected(self) -> int:
        """How many boxes of the note nobody has seen."""
        return self._work.tally().missing

    async def select_box(self, context: Context) -> Report:
        """Algorithm 1; what cannot be grasped at all is left to a person."""
        work, pallet = self._work, context.args["Pallet"]
        await work.plans.passed()
        choice = choose(work, self._desk)
        await self._desk.planner.charge(choice.plans)
        decision = choice.decision
        self._notes.chose(work.now, decision)
        if decision.target is None or decision.grasp is None:
            return await self._stuck(choice, pallet)
        box = decision.target.id
        if choice.doubts is not None and box not in self._doubted:
            self._doubted.add(box)
            self._work.feedback.doubt()
            return Report(((f"{pallet}.seen", False),), reason=f"box {box}: {choice.doubts}")
        self._again = self._absent = 0
        self._work.gone(box).clear()  # it may have been given up before
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
        unseen = ((f"{pallet}.seen", False),)
        if choice.decision.outcome is Selected.NOTHING_PERCEIVED or not verdicts:
            return Report(unseen, reason=await self._nothing_seen())
        free = [verdict for verdict in verdicts if not verdict.blockers] or list(verdicts)
        vague = [each for each in free if may_pass(self._work, each.box, each.reason)]
        if vague and self._again < AGAIN:
            self._again += 1  # another look may tell
            self._work.feedback.doubt()
            return Report(unseen, reason=f"box {vague[0].box.id}: {vague[0].reason}")
        self._again = 0
        box, reason = free[0].box, free[0].reason
        question = Question(
            f"take/{box.id}",
            f"The arm cannot take box {box.id}: {reason}. Please take it off the pallet.",
            (TAKEN, ABSENT),
            str(box.id),
            box.shape.centre,
        )
        if await self._work.questions.ask(question) == TAKEN:
            self._work.ended(box.id, Fate.BY_PERSON, reason=reason)
            self._absent = 0
            return Report(unseen, reason=reason)
        self._work.deny(box)
        self._absent += 1
        if self._absent > ABSENCES:
            return Report(outcome=Outcome.FAILED, reason="what is seen on the pallet is not there")
        return Report(unseen, reason=reason)

    async def _nothing_seen(self) -> str:
        """The pallet seems empty, and the note promises more: look again, then ask a person."""
        work = self._work
        if self._blank < BLANK:
            self._blank += 1
            work.feedback.doubt()
            return "no box is seen"
        work.seen_to = True
        number = 0
        for gtin, count in sorted(work.tally().unseen.items()):
            for _ in range(count):
                number += 1
                await self._ask_for(BoxId(f"{UNSHOWN} {number}"), gtin)
        return "a person has looked"

    async def _ask_for(self, box: BoxId, gtin: Gtin) -> None:
        """A case that the note promises and no look shows: a person takes it, or it is missing."""
        work = self._work
        if work.tally().missing < 1:
            return
        reason = "no look showed it"
        question = Question(
            f"missing/{box}",
            f"The note promises one more case of {work.delivery.products[gtin].name} ({gtin}), "
            "and none is seen. Please take it off the pallet, or off the floor, if it is there.",
            (TAKEN, ABSENT),
            str(box),
            gtin=gtin,
        )
        if await work.questions.ask(question) == TAKEN:
            work.ended(box, Fate.BY_PERSON, reason=reason)
            work.pile.identify(box, gtin)
