"""A person who answers as a test says."""

import asyncio
from collections.abc import Callable
from dataclasses import dataclass, field

from depal.ports.people import Question


def first_choice(question: Question) -> str:
    """The person does what is asked."""
    return question.choices[0]


@dataclass(slots=True)
class FakePerson:
    """Answers after a delay.

    Attributes:
        answer: what the person says, and does, when the delay is over.
        delay: until then [s].
        asked: every question, in order.
    """

    answer: Callable[[Question], str] = first_choice
    delay: float = 20.0
    asked: list[Question] = field(default_factory=list)

    async def ask(self, question: Question) -> str:
        """Waits and answers."""
        self.asked.append(question)
        await asyncio.sleep(self.delay)
        return self.answer(question)
