"""Every error that depal raises on purpose, and how it speaks.

    DepalError
    ├── InputError          something that was given cannot be used (exit status 2)
    │   ├── DeliveryError   a delivery file or a delivery note
    │   ├── RequestError    a request, or a file of them
    │   ├── PileError       a set of perceived boxes that cannot stand in one world
    │   ├── TaskError       a task file, or a call of a task, that cannot be used
    │   ├── BookError       a picture book that cannot be used
    │   ├── SettingError    a number or a name outside its range
    │   ├── CellError       a cell file, or a cell that cannot do its work
    │   ├── FrameError      a recorded frame, or a calibration, that cannot be used
    │   ├── OrderError      a recorded order of unloading that cannot be used
    │   └── FaultError      a file of faults that cannot be used
    ├── DeviceError         a device does not do what it was told
    ├── JournalError        a journal that is damaged, edited, or of another version
    ├── UnwrittenError      what must be written before anything moves cannot be written
    └── MissingPartError    an optional part that is not installed

A message says what is wrong, where, what was expected, and what exists.
"""

import difflib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

__all__ = [
    "BookError",
    "CellError",
    "DeliveryError",
    "DepalError",
    "DeviceError",
    "FaultError",
    "FrameError",
    "InputError",
    "JournalError",
    "MissingPartError",
    "OrderError",
    "PileError",
    "Problem",
    "RequestError",
    "SettingError",
    "TaskError",
    "UnwrittenError",
    "did_you_mean",
]


@dataclass(frozen=True, slots=True)
class Problem:
    """One thing that is wrong with an input.

    Attributes:
        where: the place in the input: a field, a line, an option.
        what: what is wrong there, as a sentence without its full stop.
        expected: what would have been right; empty where `what` says it all.
        exists: what there is instead, to choose from; empty where there is nothing to list.
    """

    where: str
    what: str
    expected: str = ""
    exists: str = ""

    def __str__(self) -> str:
        """The problem in one line."""
        line = f"{self.where}: {self.what}" if self.where else self.what
        if self.expected:
            line += f"; expected {self.expected}"
        if self.exists:
            line += f"; {self.exists}"
        return line


class DepalError(Exception):
    """Anything that depal raises on purpose."""


PRINTED = 50
"""How many problems one message spells out; the error itself holds all of them."""


class InputError(DepalError):
    """Something that was given cannot be used; nothing was done with it.

    Attributes:
        source: what was read, for instance a file's name; may be empty.
        problems: everything that is wrong with it, in the order of the input; at least one.
    """

    def __init__(self, source: str, problems: Sequence[Problem]) -> None:
        """Joins the problems into one message."""
        self.source = source
        self.problems = tuple(problems)
        lines = [str(problem) for problem in self.problems[:PRINTED]]
        if len(self.problems) > PRINTED:
            lines.append(f"and {len(self.problems) - PRINTED} more")
        if len(lines) > 1:
            lines = [f"{len(self.problems)} problems", *lines]
        message = "\n  ".join(lines)
        if source:
            message = f"{source}: {message}"
        super().__init__(message)

    def __reduce__(self) -> tuple[type["InputError"], tuple[str, Sequence[Problem]]]:
        """Lets the error travel from a worker's process."""
        return (InputError, (self.source, self.problems))


class DeliveryError(InputError):
    """A delivery file or a delivery note that cannot be used."""


class RequestError(InputError):
    """A request, or a file of requests, that cannot be used."""


class PileError(InputError):
    """Perceived boxes that cannot stand in one world."""


class TaskError(InputError):
    """A task file, or a call of a task, that cannot be used."""


class BookError(InputError):
    """A picture book that cannot be used."""


class SettingError(InputError):
    """A setting outside its range."""

    def __init__(self, where: str, what: str, expected: str = "", exists: str = "") -> None:
        """States the one setting that is wrong."""
        super().__init__("", [Problem(where, what, expected, exists)])


class CellError(InputError):
    """A cell file that cannot be used, or a cell that cannot do its work."""


class FrameError(InputError):
    """A recorded frame, or a calibration, that cannot be used."""


class OrderError(InputError):
    """A recorded order of unloading that cannot be used."""


class FaultError(InputError):
    """A file of faults that cannot be used."""


class DeviceError(DepalError):
    """A device does not do what it was told; the message says which and why."""


class JournalError(DepalError):
    """A journal that is damaged, edited, or written by another version; nothing moves on it."""


class UnwrittenError(DepalError):
    """What must be written before anything moves cannot be: the run has stopped where it was."""


class MissingPartError(DepalError):
    """An optional part is not installed; the message names the command that installs it."""


def did_you_mean(name: str, known: Iterable[str], limit: int = 8) -> str:
    """What exists beside a name that does not.

    Args:
        name: the name that was not found.
        known: the names that exist.
        limit: how many of them are listed at the most.

    Returns:
        "did you mean 'a'?" where one is close, else "there is: a, b, c", or a word on emptiness.
    """
    names = sorted(set(known))
    close = difflib.get_close_matches(name, names, n=1, cutoff=0.75)
    if close:
        return f"did you mean {close[0]!r}?"
    if not names:
        return "there is none"
    more = f" and {len(names) - limit} more" if len(names) > limit else ""
    return f"there is: {', '.join(names[:limit])}{more}"
