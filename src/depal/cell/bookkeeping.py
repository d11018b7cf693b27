"""What must be written before anything moves, and what happens while it cannot be.

A disk that is full or can only be read takes neither the executive's journal nor the ledger's page.
What is not written is not done: nothing is begun, the arm and the gripper stay as they are, vacuum
included, and a person is asked to make room. Then everything goes on from where it stopped, in the
order in which it was decided.
"""

import asyncio
from collections.abc import Callable
from dataclasses import dataclass

from depal.cell.questions import Questions
from depal.domain import Cup, Joints
from depal.errors import JournalError, UnwrittenError
from depal.executive.runtime import Runtime
from depal.ports import Arm, Gripper, Guard, Question, Trajectory

GO_ON, HOPELESS = "there is room again", "it cannot be written now"

OFTEN = 5
"""A person is asked so often in a row before the run ends."""

RECORDS = "records"
"""What the questions are about."""


class Bookkeeping:
    """Notices what cannot be written, and asks until it can be.

    Attributes:
        error: why something is not written; None where everything is.
    """

    def __init__(self, questions: Questions) -> None:
        """Everything is written."""
        self._questions = questions
        self._runtime: Runtime | None = None
        self._gives_up: Callable[[UnwrittenError], None] = _nobody
        self._page: Callable[[], None] | None = None
        self._open = asyncio.Event()
        self._open.set()
        self._asking: asyncio.Task[None] | None = None
        self._times = 0
        self._hopeless: UnwrittenError | None = None
        self.error: JournalError | None = None

    def bind(self, runtime: Runtime, gives_up: Callable[[UnwrittenError], None]) -> None:
        """The executive whose journal it is; `gives_up` hears that nobody can make room."""
        self._runtime, self._gives_up = runtime, gives_up
        runtime.wait_to_write(self.fails)

    def keeping(self, write: Callable[[], None]) -> Callable[[], None]:
        """The same way to write a page; where it fails nothing moves until it has succeeded."""

        def keep() -> None:
            try:
                write()
            except JournalError as error:
                self._page = write
                self.fails(error)
            else:
                self._page = None

        return keep

    def fails(self, error: JournalError) -> None:
        """Something could not be written."""
        if self._hopeless is not None:
            return
        self.error = error
        self._open.clear()
        if self._asking is None:
            self._asking = asyncio.get_running_loop().create_task(self._until_written())

    async def written(self) -> None:
        """Returns once everything is written: whoever is about to move something waits here.

        Raises:
            UnwrittenError: nobody can make room.
        """
        await self._open.wait()
        if self._hopeless is not None:
            raise self._hopeless

    async def _until_written(self) -> None:
        while self.error is not None:
            error = self.error
            self._times += 1
            if self._times > OFTEN or not await self._answered(error):
                self._hopeless = UnwrittenError(f"the cell has stopped where it was: {error}")
                self._open.set()
                self._gives_up(self._hopeless)
                return
            self._write_again()
        self._times = 0
        self._asking = None
        self._open.set()

    async def _answered(self, error: JournalError) -> bool:
        question = Question(
            f"unwritten/{self._times}",
            f"Nothing moves, for what is done cannot be written: {error}. Please make room.",
            (GO_ON, HOPELESS),
            RECORDS,
        )
        return await self._questions.ask(question) == GO_ON

    def _write_again(self) -> None:
        """The page first: what the executive begins then finds it written."""
        self.error = None
        if self._page is not None:
            self.keeping(self._page)()
        if self.error is None and self._runtime is not None:
            self._runtime.write_again()

    def close(self) -> None:
        """Nobody is asked any more."""
        if self._asking is not None:
            self._asking.cancel()


@dataclass(frozen=True, slots=True)
class WrittenArm:
    """An arm that begins no motion before it is written what it is for."""

    arm: Arm
    books: Bookkeeping

    def joints(self) -> Joints:
        """Where the axes are [rad]."""
        return self.arm.joints()

    def load(self) -> float:
        """What hangs on the flange [kg]."""
        return self.arm.load()

    async def follow(self, trajectory: Trajectory, guard: Guard | None = None) -> str | None:
        """Moves, once it is written what for."""
        await self.books.written()
        return await self.arm.follow(trajectory, guard)


@dataclass(frozen=True, slots=True)
class WrittenGripper:
    """A gripper that neither takes nor lets go before it is written."""

    gripper: Gripper
    books: Bookkeeping

    def vacuum(self) -> dict[str, float]:
        """Of each module [Pa]."""
        return self.gripper.vacuum()

    def folded(self) -> bool:
        """Whether the lower module is up."""
        return self.gripper.folded()

    async def fold(self, *, up: bool) -> None:
        """Moves the hinge."""
        await self.books.written()
        await self.gripper.fold(up=up)

    async def suck(self, cups: tuple[Cup, ...]) -> bool:
        """Makes vacuum."""
        await self.books.written()
        return await self.gripper.suck(cups)

    async def release(self) -> None:
        """Vents."""
        await self.books.written()
        await self.gripper.release()


def _nobody(_: UnwrittenError) -> None:
    """Nobody waits for the end of the run."""
