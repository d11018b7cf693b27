"""A person who sees to what is broken, when asked to."""

from collections.abc import Callable

from depal.ports import Person, Question
from depal.simulation.devices.safety import SimulatedSafety
from depal.simulation.faults.chances import Chances

ABOUT = {"arm": ("M6", "M7"), "pallet": ("P1", "P6"), "records": ("C3",)}
"""What a person mends who is asked about a thing."""


class MendingPerson:
    """Clears, resets and mends whatever a question is about, if the answer is the first one."""

    def __init__(
        self,
        person: Person,
        safety: SimulatedSafety,
        chances: Chances,
        acknowledged: Callable[[], None],
    ) -> None:
        """The person of a cell in which faults strike; `acknowledged` frees the arm."""
        self._person, self._safety, self._chances = person, safety, chances
        self._acknowledged = acknowledged

    async def ask(self, question: Question) -> str:
        """Asks, and has it done."""
        answer = await self._person.ask(question)
        if answer == question.choices[0] and question.about in ABOUT:
            self._chances.mended(ABOUT[question.about])
            if question.about == "arm":
                self._safety.stopped = False
                self._acknowledged()
        return answer
