"""The primitives of `recover` and `ask_person`: a person decides."""

from contextlib import suppress

from depal.cell.clearing import get_clear
from depal.cell.departures import Fate
from depal.cell.halting import HaltedError
from depal.cell.planning.desk import Desk
from depal.cell.primitives.withdrawing import out_of_view
from depal.cell.workplace import Workplace
from depal.domain import BoxId
from depal.executive.engine import Report
from depal.executive.runtime import Context
from depal.ports import TAKEN, Question


class Minding:
    """Talks to the supervising person."""

    def __init__(self, work: Workplace, desk: Desk) -> None:
        """Asks through the workplace; moves by the plans of the desk."""
        self._work = work
        self._desk = desk
        self._texts: dict[str, Question] = {}

    def pose(self, question: Question) -> None:
        """A question that `ask_person` is going to ask, by its id."""
        self._texts[question.id] = question

    async def show_question(self, context: Context) -> Report:
        """Puts the question onto the panel."""
        return Report(((f"{context.args['Question']}.shown", True),))

    async def await_answer(self, context: Context) -> Report:
        """Waits for the person."""
        name = context.args["Question"]
        question = self._texts.get(name, Question(name, name, ("yes", "no"), name))
        answer = await self._work.questions.ask(question)
        return Report(((f"{name}.answer", answer),))

    async def look_again(self, context: Context) -> Report:
        """Looks for the box after a fault."""
        box = BoxId(context.args["Box"])
        self._work.pile.see(await self._work.ports.sight.look())
        facts = [(f"{box}.retried", True)]
        if self._work.pile.get(box) is not None:
            return Report((*facts, (f"{box}.fault", None)))
        return Report(tuple(facts))

    async def ask_decision(self, context: Context) -> Report:
        """Asks what to do about the box."""
        box = context.args["Box"]
        fault = context.facts.get(f"{box}.fault") or "it lies on the floor"
        question = Question(
            f"decision/{box}", f"Box {box}: {fault}. Please pick it up.", (TAKEN,), box
        )
        answer = await self._work.questions.ask(question)
        return Report(((f"{box}.decision", answer),))

    async def ask_to_take(self, context: Context) -> Report:
        """Asks a person to take a box out of the gripper, and lets go of it.

        Then the arm draws back as it would with the box: from among others no way may lead on.
        """
        work, box = self._work, BoxId(context.args["Box"])
        fault = work.stranded.get(box, "there is no place for it")
        question = Question(
            f"hand/{box}",
            f"The arm cannot put box {box} down: {fault}. Please take it out of the gripper.",
            (TAKEN,),
            box,
        )
        await work.questions.ask(question)
        await work.ports.gripper.release()
        work.unplaceable.discard(box)
        with suppress(HaltedError):  # it has stopped: after the start it gets clear anyway
            await get_clear(work, self._desk)
        work.ended(box, Fate.BY_PERSON, reason=work.aside_reasons.get(box, fault))
        return Report(((f"{box}.taken", False),))

    async def carry_on(self, context: Context) -> Report:
        """The box is out of the way: its store is withdrawn, and the pile looked at anew."""
        box = context.args["Box"]
        runtime = self._work.runtime
        for number, tree in list(runtime.engine.state.trees.items()):
            if tree.root.node.args == (box,) and tree.root.node.schema.name != "recover":
                runtime.withdraw(number, "a person has taken the box")
        await out_of_view(self._work, self._desk)
        self._work.feedback.doubt()
        self._work.pile.see(await self._work.ports.sight.look())
        facts = ((f"{box}.fault", None), (f"{box}.on_floor", False), (f"{box}.decision", None))
        return Report(facts)
