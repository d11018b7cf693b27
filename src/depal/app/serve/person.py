"""The supervising person behind the port `Person`: questions wait until somebody answers."""

import asyncio
from collections.abc import Callable

from depal.app.serve.outside import Deeds
from depal.executive.clock import Clock
from depal.ports import Question
from depal.server.cell import Refusal
from depal.server.cellstate import QuestionState

Asked = Callable[[QuestionState], None]
Answered = Callable[[str, str, str, float], None]


class ScreenPerson:
    """Whoever stands before a screen; the first answer to a question counts."""

    def __init__(
        self, run: int, clock: Clock, deeds: Deeds, asked: Asked, answered: Answered
    ) -> None:
        """Nothing is asked yet.

        Args:
            run: whose questions these are: part of their names.
            clock: of the cell.
            deeds: done in a simulated world once an answer has come.
            asked: told of each question.
            answered: told of each answer: question, choice, by whom, when [s].
        """
        self._run, self._clock, self._deeds = run, clock, deeds
        self._asked, self._answered = asked, answered
        self._open: dict[str, tuple[QuestionState, asyncio.Future[tuple[str, str]]]] = {}
        self._count = 0
        self._closed: dict[str, str] = {}

    @property
    def open(self) -> tuple[QuestionState, ...]:
        """The questions that nobody has answered, oldest first."""
        return tuple(state for state, _ in self._open.values())

    async def ask(self, question: Question, *, blocks: bool = True) -> str:
        """Asks, waits, and has done what the answer promises."""
        self._count += 1
        name = f"{self._run}/{question.id}/{self._clock.now():.0f}-{self._count}"
        state = QuestionState(
            name,
            question.text,
            question.choices,
            question.about,
            self._clock.now(),
            blocks,
            question.at,
        )
        future: asyncio.Future[tuple[str, str]] = asyncio.get_running_loop().create_future()
        self._open[name] = (state, future)
        self._asked(state)
        try:
            choice, by = await future
        except asyncio.CancelledError:
            self._open.pop(name, None)
            raise
        self._answered(name, choice, by, self._clock.now())
        await self._deeds.do(question, choice)
        return choice

    def answer(self, name: str, choice: str, by: str) -> None:
        """Somebody has answered.

        Raises:
            Refusal: there is no such open question, or no such choice.
        """
        if name not in self._open:
            told = self._closed.get(name)
            raise Refusal(told or f"there is no open question {name!r}")
        state, future = self._open[name]
        if choice not in state.choices:
            raise Refusal(f"{choice!r} is no answer; the choices are {', '.join(state.choices)}")
        del self._open[name]
        self._closed[name] = f"{by} has answered this question: {choice}"
        future.set_result((choice, by))
