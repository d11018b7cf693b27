"""What the cell says about its work while it works: choices with reasons, and events."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from depal.domain import BoxId
from depal.executive import events as ev
from depal.selection import Decision


@dataclass(frozen=True, slots=True)
class Line:
    """One box in one choice: its scores and its fate in words."""

    box: BoxId
    h: float
    l: float  # noqa: E741 - the paper's name
    s: float
    fate: str
    reason: str


@dataclass(frozen=True, slots=True)
class ChoiceNote:
    """A selection as it is told: Eqs. (1)-(3) per box, best first.

    Attributes:
        at: when [s].
        target: the box to store next, None where nothing could be grasped.
        outcome: how the selection ended, in words.
        lines: every perceived box, best score first.
        cycle: boxes that block one another.
    """

    at: float
    target: BoxId | None
    outcome: str
    lines: tuple[Line, ...]
    cycle: tuple[BoxId, ...]

    @property
    def why(self) -> str:
        """Why this box, in one sentence."""
        if self.target is None:
            return self.outcome
        chosen = next(line for line in self.lines if line.box == self.target)
        pull = f", pulled by a request (l = {chosen.l:.2f})" if chosen.l > 0 else ""
        passed = [line.box for line in self.lines if line.s > chosen.s and line.box != chosen.box]
        over = f"; {len(passed)} with a better score are blocked or out of reach" if passed else ""
        return f"best score that can be taken: s = {chosen.s:.3f}, h = {chosen.h:.3f}{pull}{over}"


Heard = Callable[[int, Sequence[ev.Event]], None]
Chosen = Callable[[ChoiceNote], None]


class Journalist:
    """Passes on what happens to those who want to know: a screen, a record."""

    def __init__(self) -> None:
        """Nobody listens yet."""
        self._heard: list[Heard] = []
        self._chosen: list[Chosen] = []

    def listen(self, heard: Heard | None = None, chosen: Chosen | None = None) -> None:
        """Adds a listener to events, to choices, or both."""
        if heard is not None:
            self._heard.append(heard)
        if chosen is not None:
            self._chosen.append(chosen)

    def heard(self, last: int, events: Sequence[ev.Event]) -> None:
        """A step of the executive has been written."""
        for listener in self._heard:
            listener(last, events)

    def chose(self, at: float, decision: Decision[Any]) -> None:
        """A selection was made."""
        note = note_of(at, decision)
        for listener in self._chosen:
            listener(note)


def note_of(at: float, decision: Decision[Any]) -> ChoiceNote:
    """A decision as it is told."""
    lines = tuple(Line(v.box.id, v.h, v.l, v.s, v.fate.value, v.reason) for v in decision.verdicts)
    target = decision.target.id if decision.target is not None else None
    return ChoiceNote(at, target, decision.outcome.value, lines, decision.cycle)
