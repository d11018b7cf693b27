"""A run that is over, or goes on, at any moment of it: from its journal and its choices."""

import json
from bisect import bisect_right
from dataclasses import dataclass
from pathlib import Path

from depal.executive import events as ev
from depal.executive.engine import Engine
from depal.executive.events import Event
from depal.executive.record import Recording
from depal.server.cellstate import QueueLine, Solid, TaskTree
from depal.server.tasktrees import trees_of

CHOICES = "choices.jsonl"
"""Beside the journal: every selection with h, l, s, fate and reason of each box."""

NEAR = 6
"""So many of the last events are told."""


@dataclass(frozen=True, slots=True)
class Happened:
    """An event in words.

    Attributes:
        at: when [s].
        what: happened; a key of the catalogue.
        label: of the task that it happened to.
        reason: why, in the cell's words.
    """

    at: float
    what: str
    label: str
    reason: str = ""


@dataclass(frozen=True, slots=True)
class Selection:
    """A selection as it was told.

    Attributes:
        at: when [s].
        target: the chosen box, or None.
        outcome: how it ended, in words.
        queue: every box, best first.
    """

    at: float
    target: str | None
    outcome: str
    queue: tuple[QueueLine, ...]


@dataclass(frozen=True, slots=True)
class Moment:
    """A run after one of its events.

    Attributes:
        number: of the event; 0 for the beginning.
        at: when it was [s].
        trees: the task trees.
        last: the last events, the latest first.
        selection: the last one; None where there was none yet.
    """

    number: int
    at: float
    trees: tuple[TaskTree, ...]
    last: tuple[Happened, ...]
    selection: Selection | None


class Replayed:
    """A record, and where in it one is; forward is cheap, back begins anew."""

    def __init__(self, recording: Recording, selections: tuple[Selection, ...]) -> None:
        """At the beginning."""
        self._recording, self._selections = recording, selections
        self._engine, self._at = Engine(recording.repository), 0
        self._labels: dict[int, str] = {}
        self._roots: dict[int, str] = {}
        self.steps = tuple(
            number
            for number, event in enumerate(recording.events, start=1)
            if not isinstance(event, ev.Ticked)
        )

    @classmethod
    def read(cls, folder: Path) -> "Replayed":
        """Reads a record.

        Raises:
            JournalError: there is none, or it is damaged.
            TaskError: its task file cannot be read.
        """
        return cls(Recording.read(folder), selections_of(folder / CHOICES))

    @property
    def selections(self) -> tuple[Selection, ...]:
        """Every selection, in order."""
        return self._selections

    def number_at(self, at: float) -> int:
        """The last event until a time [s]."""
        return bisect_right([event.at for event in self._recording.events], at)

    def moment(self, number: int) -> Moment:
        """The run after an event."""
        events = self._recording.events
        number = min(max(number, 0), len(events))
        if number < self._at:
            self._engine, self._at = Engine(self._recording.repository), 0
        state = self._engine.state
        for event in events[self._at : number]:
            state.apply(event)
            if isinstance(event, ev.Allocated):
                self._roots[event.tree] = f"{event.schema}({', '.join(event.args)})"
            elif isinstance(event, ev.Started):
                node = state.trees[event.tree].nodes[event.node]
                self._labels[event.attempt] = node.node.label
        self._at = number
        at = events[number - 1].at if number else 0.0
        return Moment(number, at, trees_of(state), self._last(number), self._selected(at))

    def _last(self, number: int) -> tuple[Happened, ...]:
        found: list[Happened] = []
        for event in reversed(self._recording.events[:number]):
            told = self._told(event)
            if told is not None:
                found.append(told)
            if len(found) == NEAR:
                break
        return tuple(found)

    def _selected(self, at: float) -> Selection | None:
        place = bisect_right([selection.at for selection in self._selections], at)
        return self._selections[place - 1] if place else None

    def _told(self, event: Event) -> Happened | None:
        match event:
            case ev.Allocated(schema=schema, args=args):
                return Happened(event.at, "past.allocated", f"{schema}({', '.join(args)})")
            case ev.Started(attempt=attempt):
                return Happened(event.at, "past.started", self._labels.get(attempt, ""))
            case ev.Ended(attempt=attempt, outcome=outcome, reason=reason):
                label = self._labels.get(attempt, "")
                return Happened(event.at, f"past.{outcome.value}", label, reason)
            case ev.Archived(tree=tree, accomplished=accomplished):
                what = "past.accomplished" if accomplished else "past.withdrawn"
                return Happened(event.at, what, self._roots.get(tree, ""))
            case ev.ModeChanged(held=held, source=source):
                return Happened(event.at, "past.held" if held else "past.going", source)
            case _:
                return None


def selections_of(path: Path) -> tuple[Selection, ...]:
    """The selections of a record; none where there is no such file.

    A last line that is cut off belongs to a run that was killed, or goes on.
    """
    if not path.is_file():
        return ()
    found = []
    for line in path.read_text("utf-8").splitlines():
        try:
            found.append(_selection(json.loads(line)))
        except (ValueError, KeyError, TypeError):
            continue
    return tuple(found)


def _selection(told: dict[str, object]) -> Selection:
    lines = told["lines"]
    if not isinstance(lines, list):
        raise TypeError("lines are a list")
    target = told["target"]
    return Selection(
        float(str(told["at"])),
        None if target is None else str(target),
        str(told["outcome"]),
        tuple(_line(line) for line in lines),
    )


def _line(told: dict[str, object]) -> QueueLine:
    solid = Solid(_vector(told["centre"]), _vector(told["size"]), float(str(told["yaw"])))
    gtin, blockers = told["gtin"], told.get("blockers") or []
    if not isinstance(blockers, list):
        raise TypeError("blockers are a list")
    return QueueLine(
        box=str(told["box"]),
        gtin=None if gtin is None else str(gtin),
        name="" if gtin is None else str(gtin),
        solid=solid,
        h=float(str(told["h"])),
        l=float(str(told["l"])),
        s=float(str(told["s"])),
        fate=str(told["fate"]),
        reason=str(told["reason"]),
        blockers=tuple(map(str, blockers)),
    )


def _vector(told: object) -> tuple[float, float, float]:
    if not isinstance(told, list):
        raise TypeError("a vector is a list")
    x, y, z = (float(value) for value in told)
    return x, y, z
