"""What a check finds wrong, at a path into the input, before it is put into words for people."""

from collections.abc import Sequence
from dataclasses import dataclass

from depal.errors import Problem, did_you_mean

Loc = tuple[str | int, ...]
"""A path into a file: keys of objects and indices of lists, from the outside in."""

_SHOWN = 60
"""How many characters of a foreign text a message repeats."""


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that is wrong, and the path to it.

    Attributes:
        loc: the path; empty for the whole.
        what: what is wrong there.
        expected: what would have been right.
        exists: what there is instead.
        twin: the path to another place that `what` ends with; empty where there is none.
    """

    loc: Loc
    what: str
    expected: str = ""
    exists: str = ""
    twin: Loc = ()

    def at(self, where: str, twin: str = "") -> Problem:
        """The finding as a problem, at places that a person finds in the file."""
        named = twin or place(self.twin)
        what = f"{self.what} {named}" if named else self.what
        return Problem(where, what, self.expected, self.exists)


def place(loc: Loc) -> str:
    """A path as people write it: `lines[2].size[0]`."""
    text = ""
    for step in loc:
        if isinstance(step, int):
            text += f"[{step}]"
        elif not step.isidentifier():
            text += f"[{shown(step)}]"
        else:
            text += f".{step}" if text else step
    return text


def shown(value: object) -> str:
    """A foreign value in a few printable characters; lists and objects by their kind alone."""
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return repr(value if len(value) <= _SHOWN else f"{value[:_SHOWN]}...")
    if isinstance(value, int | float):
        text = {"nan": "NaN", "inf": "Infinity", "-inf": "-Infinity"}.get(str(value), str(value))
        return text if len(text) <= _SHOWN else f"{text[:_SHOWN]}..."
    return "an object" if isinstance(value, dict) else "a list"


def choices(name: str, known: Sequence[str], limit: int = 12) -> str:
    """What is close to a name that does not exist, and what there is."""
    hint, listing = did_you_mean(name, known, limit), did_you_mean("", known, limit)
    return hint if hint == listing else f"{hint} ({listing})"
