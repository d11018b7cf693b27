"""After a restart: from what was written and what the sensors say to what has happened.

The crash table of the reliability page as one pure function; what it cannot tell is `UNKNOWN`, and
a person is asked.
"""

from dataclasses import dataclass
from enum import Enum

from depal.cell.hand import Hand, Phase, most_of

CARRIED = 0.6
"""With at least this share of its mass on the arm a box hangs there."""

NOTHING = 0.25
"""With less than this share the arm carries no box."""

EMPTY_LOAD = 0.3
"""Where no mass is known, this much on the arm is a box [kg]."""


class Found(Enum):
    """What a restart has found.

    Nothing: no step was under way. Not started: the box stands on the pallet, untouched. Let go:
    the cups hold on to it, and it still stands on the pallet. Holding: it hangs on the arm. Set
    down: it stands in its place and the cups still hold on to it. Placed: it stands in its place
    and was let go. Dropped: it is gone from the hand. Unknown: a person must look.
    """

    NOTHING = "nothing"
    NOT_STARTED = "not started"
    LET_GO = "let go"
    HOLDING = "holding"
    SET_DOWN = "set down"
    PLACED = "placed"
    DROPPED = "dropped"
    UNKNOWN = "unknown"


@dataclass(frozen=True, slots=True)
class Sensed:
    """What the gripper and the flange tell.

    Attributes:
        vacuum: whether any module holds a vacuum.
        load: what hangs on the flange [kg].
    """

    vacuum: bool
    load: float


class Weight(Enum):
    """What hangs on the arm, beside what the box weighs."""

    MORE = "more"
    WHOLE = "whole"
    PART = "part"
    NONE = "none"


SUCKED, VENTED = True, False

TABLE: dict[tuple[Phase, bool, Weight], Found] = {
    (Phase.GRASPING, SUCKED, Weight.MORE): Found.LET_GO,
    (Phase.GRASPING, SUCKED, Weight.WHOLE): Found.HOLDING,
    (Phase.GRASPING, SUCKED, Weight.NONE): Found.LET_GO,
    (Phase.GRASPING, VENTED, Weight.NONE): Found.NOT_STARTED,
    (Phase.HELD, SUCKED, Weight.WHOLE): Found.HOLDING,
    (Phase.HELD, VENTED, Weight.NONE): Found.DROPPED,
    (Phase.LOWERING, SUCKED, Weight.WHOLE): Found.HOLDING,
    (Phase.LOWERING, SUCKED, Weight.PART): Found.SET_DOWN,
    (Phase.LOWERING, SUCKED, Weight.NONE): Found.SET_DOWN,
    (Phase.LOWERING, VENTED, Weight.NONE): Found.DROPPED,
    (Phase.VENTING, SUCKED, Weight.WHOLE): Found.HOLDING,
    (Phase.VENTING, SUCKED, Weight.PART): Found.SET_DOWN,
    (Phase.VENTING, SUCKED, Weight.NONE): Found.SET_DOWN,
    (Phase.VENTING, VENTED, Weight.NONE): Found.PLACED,
}
"""What is not in it nobody can tell."""


def reconcile(hand: Hand | None, sensed: Sensed) -> Found:
    """What has happened to the box that the last page of the ledger tells of.

    Args:
        hand: the step that was written last; None where no box was in it.
        sensed: now.
    """
    if hand is None:
        idle = Found.LET_GO if sensed.vacuum else Found.NOTHING
        return Found.UNKNOWN if sensed.load >= EMPTY_LOAD else idle
    return TABLE.get((hand.phase, sensed.vacuum, weight_of(hand, sensed.load)), Found.UNKNOWN)


def weight_of(hand: Hand, load: float) -> Weight:
    """How much of a box hangs on the arm, by the load [kg]; more where it is not alone."""
    if load > most_of(hand.mass):
        return Weight.MORE
    if load >= CARRIED * hand.mass:
        return Weight.WHOLE
    return Weight.NONE if load < NOTHING * hand.mass else Weight.PART
