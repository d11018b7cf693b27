"""The faults that can be injected, and how the cell has to end each (docs/reliability.md)."""

import math
from dataclasses import dataclass
from enum import Enum


class Phase(Enum):
    """What the cell is doing, as its devices see it.

    Look: a picture is taken. Plan: a motion is planned. Reach: the arm moves with an empty hand.
    Grasp: suction comes. Carry: the arm moves with a box. Place: it sets one down. Read: the
    barcode reader looks. Query: the store's system is asked. Tell: it is told. Write: something is
    written before it is done.
    """

    LOOK = "look"
    PLAN = "plan"
    REACH = "reach"
    GRASP = "grasp"
    CARRY = "carry"
    PLACE = "place"
    READ = "read"
    QUERY = "query"
    TELL = "tell"
    WRITE = "write"


MOVING = (Phase.REACH, Phase.CARRY, Phase.PLACE)

HELD = frozenset({Phase.GRASP, Phase.CARRY, Phase.PLACE, Phase.READ})
"""Phases in which it is known which box the cell works on."""


LIKE = (Phase.GRASP, Phase.LOOK)
"""What a box weighs is found out in the hand, its size by the look."""


class End(Enum):
    """How a fault may end.

    On: the cell went on by itself: it tried again, took another way, or waited until it was over.
    Aside: a box went to the exception place. Held: a person was asked. Aborted: nothing moved
    until a person had said start.
    """

    ON = "goes on"
    ASIDE = "sets aside"
    HELD = "held"
    ABORTED = "aborted"


@dataclass(frozen=True, slots=True)
class Entry:
    """One fault of the catalogue.

    Attributes:
        id: in RELIABILITY's catalogue.
        what: in words.
        phases: in which it can strike; the first is meant where a file names none.
        lasts: where a file does not say so [s]; 0 for what happens in a moment.
        ends: each of them ends it.
    """

    id: str
    what: str
    phases: tuple[Phase, ...]
    lasts: float
    ends: tuple[End, ...]

    @property
    def about_box(self) -> bool:
        """Whether a file can name the box that it strikes."""
        return any(phase in HELD for phase in self.phases)


_ON, _ASIDE, _HELD, _ABORTED = End.ON, End.ASIDE, End.HELD, End.ABORTED

ENTRIES = (
    Entry("P1", "the camera is dead or frozen", (Phase.LOOK,), 4.0, (_ON, _HELD)),
    Entry("P6", "the camera is bumped", (Phase.LOOK,), math.inf, (_HELD, _ON)),
    Entry("P7", "a box is moved after the look", (Phase.REACH,), 0.0, (_ON,)),
    Entry("N1", "the label is unreadable", (Phase.READ,), math.inf, (_ON, _ASIDE)),
    Entry("N3", "a product that is not on the note", (Phase.LOOK,), math.inf, (_ASIDE,)),
    Entry("N4", "a box's mass or size is not its product's", LIKE, math.inf, (_ASIDE,)),
    Entry("G1", "the vacuum is not reached", (Phase.GRASP,), 0.0, (_ON,)),
    Entry("G3", "the box is dropped in transit", (Phase.CARRY,), 0.0, (_HELD,)),
    Entry("G4", "a neighbour sticks to the box", (Phase.GRASP,), 0.0, (_ON, _HELD)),
    Entry("G7", "one of two suction modules is dead", (Phase.GRASP,), math.inf, (_ON, _HELD)),
    Entry("M2", "a box falls off the pile", (Phase.REACH,), 0.0, (_HELD,)),
    Entry("M3", "nothing reaches a box", (Phase.PLAN,), 60.0, (_ON, _HELD)),
    Entry("M4", "the planner gives up", (Phase.PLAN,), 0.0, (_ON,)),
    Entry("M5", "the arm leaves its path and stops", MOVING, 0.0, (_HELD, _ON)),
    Entry("M6", "the arm meets a torque that it does not expect", MOVING, math.inf, (_HELD,)),
    Entry("M7", "an emergency stop, or the gate is opened", MOVING, math.inf, (_ABORTED,)),
    Entry("O1", "somebody comes near, and then in before the arm", MOVING, 9.0, (_ON,)),
    Entry("T1", "the trolley is absent", (Phase.GRASP,), 60.0, (_ON, _ASIDE)),
    Entry("T2", "something stands in an empty place", (Phase.GRASP,), math.inf, (_ON, _ASIDE)),
    Entry("T3", "a trolley is exchanged unasked", (Phase.GRASP,), 0.0, (_ON,)),
    Entry("W1", "the store's system is silent", (Phase.QUERY, Phase.TELL), 5.0, (_ON, _ASIDE)),
    Entry("W2", "the store's system is slow", (Phase.QUERY, Phase.TELL), 30.0, (_ON, _ASIDE)),
    Entry("W3", "the store's system is told twice", (Phase.TELL, Phase.QUERY), 0.0, (_ON,)),
    Entry("C3", "the disk is full", (Phase.WRITE,), math.inf, (_HELD,)),
    Entry("W6", "the store knows no place", (Phase.QUERY,), 30.0, (_ON, _ASIDE)),
)

CATALOGUE = {entry.id: entry for entry in ENTRIES}
