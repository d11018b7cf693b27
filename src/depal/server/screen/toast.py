"""Short answers to what somebody did, and the guard against doing it twice."""

from collections.abc import Callable

from nicegui import ui

from depal.errors import DepalError, InputError
from depal.server.problems import Answer, SignInNeeded
from depal.server.screen.desk import asked
from depal.server.screen.said import Said
from depal.server.screen.words import Words

ENTRANCE = "/sign-in"


def told(message: str) -> None:
    """It is done."""
    ui.notify(message, position="bottom", classes="toast", icon="check", timeout=3000)


def refused(message: str) -> None:
    """It cannot be done, and why."""
    ui.notify(
        message, position="bottom", classes="toast is-refused", icon="block", timeout=9000,
        close_button="OK", multi_line=True,
    )  # fmt: skip


class Guard:
    """One command at a time for each window: the same one meanwhile was pressed twice.

    Attributes:
        problems: all that was wrong with what was refused last.
    """

    def __init__(self, words: Words, said: Said) -> None:
        """Nothing is under way.

        Args:
            words: of the screen.
            said: puts what the cell says into the screen's language.
        """
        self._words, self._said = words, said
        self._under_way: tuple[object, ...] | None = None
        self.problems: tuple[str, ...] = ()

    async def do(
        self,
        message: str,
        command: Callable[..., object],
        *arguments: object,
        listed: bool = False,
    ) -> bool:
        """Calls a use case and tells what came of it.

        Args:
            message: where it is done; empty to say nothing.
            command: of the desk.
            arguments: for it.
            listed: whether the caller shows the problems itself.

        Returns:
            Whether it was done; else it was refused, or something else is under way.
        """
        if self._under_way is not None:
            if self._under_way != (command, arguments):
                refused(self._words("done.wait"))
            return False
        self._under_way, self.problems = (command, arguments), ()
        try:
            await asked(command, *arguments)
        except SignInNeeded:
            ui.navigate.to(ENTRANCE)
            return False
        except DepalError as error:
            self._refuse(error, listed=listed)
            return False
        finally:
            self._under_way = None
        if message:
            told(message)
        return True

    def _refuse(self, error: DepalError, *, listed: bool) -> None:
        found = error.problems if isinstance(error, (Answer, InputError)) else ()
        self.problems = tuple(str(problem) for problem in found)
        if self.problems and listed:
            return
        text = ". ".join(self.problems) if self.problems else str(error).splitlines()[0]
        refused(self._said(text))
