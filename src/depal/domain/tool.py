"""The gripper as a cell file describes it: modules of suction cups on an L."""

import math
from dataclasses import dataclass

from depal.geometry import OrientedBox, Pose, Vector3

FRONT = "front"
LOWER = "lower"


@dataclass(frozen=True, slots=True)
class SuctionModule:
    """A plate of cups.

    Attributes:
        name: "front" or "lower".
        flange_from_face: the middle of the plane in which the cups touch; x out of the face
            towards the box, y and z in the plane.
        size: extent of the plate along the face's y and z [m].
        cups: centres of the cups in the face's y and z [m].
    """

    name: str
    flange_from_face: Pose
    size: tuple[float, float]
    cups: tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class Suction:
    """What a cup does.

    Attributes:
        cup_radius: [m].
        vacuum: below the pressure around, on cardboard [Pa].
        friction: of a cup on cardboard.
        stroke: how far a bellows reaches beyond, and gives behind, the plane of touch [m].
        stiffness: of one cup along its axis [N/m].
        rise: until the vacuum stands [s].
        vent: until a box is let go [s].
    """

    cup_radius: float
    vacuum: float
    friction: float
    stroke: float
    stiffness: float
    rise: float
    vent: float

    @property
    def cup_force(self) -> float:
        """The greatest pull of one covered cup: area times vacuum [N]."""
        return math.pi * self.cup_radius**2 * self.vacuum


@dataclass(frozen=True, slots=True)
class Tool:
    """A gripper; frames are the flange's: x out of the flange, z up when the arm is at zero.

    Attributes:
        mass: [kg].
        centre_of_mass: from the flange [m].
        suction: of every cup.
        modules: with the lower one unfolded, facing down.
        folded_lower: the lower module hinged up, its face coplanar with the front one's.
        shapes: the solid parts with the lower module unfolded, in the flange's frame; all of them
            stay behind the planes of touch by at least the bellows' stroke.
        folded_shapes: the same with the lower module hinged up.
        safety: the planner counts on the holding force divided by this.
        fold_time: the hinge takes this long [s].
    """

    mass: float
    centre_of_mass: Vector3
    suction: Suction
    modules: tuple[SuctionModule, ...]
    folded_lower: SuctionModule
    shapes: tuple[OrientedBox, ...]
    folded_shapes: tuple[OrientedBox, ...]
    safety: float
    fold_time: float

    def module(self, name: str, *, folded: bool = False) -> SuctionModule:
        """The module of that name."""
        if folded and name == LOWER:
            return self.folded_lower
        return next(module for module in self.modules if module.name == name)
