"""What an exploration finds."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

from depal.executive.conditions import Value


class HazardKind(Enum):
    """What can go wrong."""

    DEAD_END = "dead end"
    LIVELOCK = "livelock"
    EXCLUSION = "broken exclusion"
    HALF_CHANGE = "acts on half a change"


@dataclass(frozen=True, slots=True)
class TraceStep:
    """One thing that happens on the way.

    Attributes:
        what: as a phrase.
        facts: what is the case afterwards; facts that are unset are left out.
        running: the primitives that run afterwards.
    """

    what: str
    facts: Mapping[str, Value]
    running: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Hazard:
    """One thing that can go wrong.

    Attributes:
        kind: of hazard.
        what: what goes wrong, as a sentence without its full stop.
        trace: the shortest way there; empty where it is so from the start.
    """

    kind: HazardKind
    what: str
    trace: tuple[TraceStep, ...]


@dataclass(frozen=True, slots=True)
class Wait:
    """A place where the task goes on only when something from outside happens.

    Attributes:
        what: for what it waits, as in "b1.target" or "not b1.on_floor".
        trace: the shortest way there.
    """

    what: str
    trace: tuple[TraceStep, ...]


@dataclass(frozen=True, slots=True)
class Exploration:
    """Every state of an allocated task.

    Attributes:
        task: as in "store(b1)".
        states: how many there are.
        valuations: how many different sets of facts among them.
        transitions: how many there are.
        complete: whether every state was seen; else the limit was reached.
        hazards: by kind, then the nearest first.
        waits: where the world has to act, the nearest first.
        idle: the primitives that never start.
        attended: in how many states a person is asked because retries are used up.
    """

    task: str
    states: int
    valuations: int
    transitions: int
    complete: bool
    hazards: tuple[Hazard, ...]
    waits: tuple[Wait, ...]
    idle: tuple[str, ...]
    attended: int
