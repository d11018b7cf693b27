"""The physical step that a box is in: written before the motion begins (exactly one placement)."""

from dataclasses import dataclass
from enum import Enum

from depal.domain import BoxId, Grasp, PlaceId
from depal.geometry import Vector3

HEAVY, SPARE = 1.35, 0.5
"""What hangs on the arm is more than one box beyond this much of what one weighs, and this [kg]."""


def most_of(mass: float) -> float:
    """What a box that is expected to weigh so much may weigh at the most [kg]."""
    return HEAVY * mass + SPARE


class Phase(Enum):
    """How far a box has got between the pallet and its place.

    Grasping: the cups are at its face, suction comes, the lift begins. Held: it is off the pallet.
    Lowering: it is being set down. Venting: it stands, and the cups let go.
    """

    GRASPING = "grasping"
    HELD = "held"
    LOWERING = "lowering"
    VENTING = "venting"


@dataclass(frozen=True, slots=True)
class Hand:
    """What the gripper is doing with a box.

    Attributes:
        box: its name.
        grasp: how it is held.
        size: along its own axes [m].
        mass: as expected while it is grasped, then as felt [kg].
        phase: how far it has got.
        place: where it is being set down; None before.
        beyond: how much longer the box may be along its own axes, at either end [m].
    """

    box: BoxId
    grasp: Grasp
    size: Vector3
    mass: float
    phase: Phase
    place: PlaceId | None = None
    beyond: Vector3 = (0.0, 0.0, 0.0)
