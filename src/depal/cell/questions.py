"""What people were asked, and how long the cell waited for them."""

from dataclasses import dataclass

from depal.ports import Clock, Person, Question


@dataclass(frozen=True, slots=True)
class Asked:
    """A question with its answer.

    Attributes:
        question: what was asked.
        answer: what the person said; None while nobody has.
        asked: when [s].
        answered: when [s].
    """

    question: Question
    asked: float
    answer: str | None = None
    answered: float | None = None


class Questions:
    """Questions to the supervising person, in order."""

    def __init__(self, person: Person, clock: Clock) -> None:
        """Nothing was asked yet."""
        self._person = person
        self._clock = clock
        self._asked: list[Asked] = []

    async def ask(self, question: Question) -> str:
        """Asks, and waits for as long as it takes."""
        asked = self._clock.now()
        number = len(self._asked)
        self._asked.append(Asked(question, asked))
        answer = await self._person.ask(question)
        self._asked[number] = Asked(question, asked, answer, self._clock.now())
        return answer

    @property
    def all(self) -> tuple[Asked, ...]:
        """Every question so far."""
        return tuple(self._asked)

    @property
    def open(self) -> tuple[Asked, ...]:
        """Those that nobody has answered."""
        return tuple(asked for asked in self._asked if asked.answer is None)
