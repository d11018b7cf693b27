"""The primitives of `exchange`: a full trolley goes, an empty one comes."""

import asyncio

from depal.cell.planning.desk import Desk
from depal.cell.workplace import Workplace
from depal.executive.engine import Report
from depal.executive.events import Outcome
from depal.executive.runtime import Context
from depal.ports import Question


class Exchanging:
    """Has trolleys exchanged by a person."""

    def __init__(self, work: Workplace, desk: Desk) -> None:
        """Keeps the books in step."""
        self._work = work
        self._desk = desk
        self._asked: dict[str, asyncio.Task[str]] = {}

    async def inspect(self, context: Context) -> Report:
        """Looks at the bay's sensor."""
        trolley = context.args["Trolley"]
        present = self._work.ports.bays.trolley(trolley) is not None
        full = bool(context.facts.get(f"{trolley}.full"))
        facts = ((f"{trolley}.seen", True), (f"{trolley}.present", present))
        return Report((*facts, (f"{trolley}.full", full)))

    async def call(self, context: Context) -> Report:
        """Unlocks the bay and calls for a person."""
        trolley = context.args["Trolley"]
        self._ask(trolley, context.attempt)
        return Report(((f"{trolley}.present", False),))

    def _ask(self, trolley: str, attempt: int) -> asyncio.Task[str]:
        question = Question(
            f"exchange/{trolley}/{attempt}",
            f"{trolley} is full. Please pull it out and put an empty one into its bay.",
            ("done",),
            trolley,
        )
        asking = self._work.questions.ask(question)
        self._asked[trolley] = task = asyncio.get_running_loop().create_task(asking)
        return task

    async def await_new(self, context: Context) -> Report:
        """Waits until an empty trolley is locked in the bay."""
        trolley = context.args["Trolley"]
        # Who was asked before a restart is asked anew.
        asked = self._asked.get(trolley) or self._ask(trolley, context.attempt)
        await asyncio.shield(asked)  # a time-out here does not unask the person
        del self._asked[trolley]
        if self._work.ports.bays.trolley(trolley) is None:
            return Report(outcome=Outcome.FAILED, reason=f"no trolley is locked in {trolley}")
        self._desk.promises.exchanged(trolley)
        self._work.exchange_of(trolley).end()
        return Report(((f"{trolley}.present", True), (f"{trolley}.full", False)))
