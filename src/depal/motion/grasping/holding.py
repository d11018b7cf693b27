"""Whether a held box stays held: the wrench at the cups against what their vacuum carries.

The theory is `domain.cup_group`'s; here it meets a grasp: which cups, where the box's centre of
mass is, how the flange moves. The planner counts on the pull divided by the tool's safety.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.domain import Cup, Grasp, Tool
from depal.domain.cup_group import CupGroup
from depal.geometry import Vector3

Floats = npt.NDArray[np.float64]

G = 9.81


Groups = dict[tuple[bool, tuple[Cup, ...]], CupGroup]
"""Groups of cups by whether the lower module is up and which cups they are."""


@dataclass(frozen=True, slots=True, eq=False)
class Holding:
    """A held box as the suction feels it, in the flange's frame.

    Attributes:
        group: the cups that hold.
        flange_from_face: (3, 3) columns are the axes of the plane of touch.
        middle: (3,) the middle of the cups [m].
        centre: (3,) the box's centre of mass [m].
        mass: [kg].
        pull: the full pull of the cups [N].
        safety: the planner counts on the pull divided by this.
        inertia: (3, 3) of the box about its centre [kg m^2].
    """

    group: CupGroup
    flange_from_face: Floats
    middle: Floats
    centre: Floats
    mass: float
    pull: float
    safety: float
    inertia: Floats

    @classmethod
    def of(
        cls,
        grasp: Grasp,
        mass: float,
        tool: Tool,
        known: Groups | None = None,
        size: Vector3 | None = None,
    ) -> "Holding":
        """A box of a mass [kg], held by a grasp; groups of cups that are known are not made anew.

        Without a size [m] its mass is in one point, which is enough at rest.
        """
        plane = tool.module(grasp.cups[0][0], folded=grasp.folded).flange_from_face
        key = (grasp.folded, grasp.cups)
        group = None if known is None else known.get(key)
        if group is None:
            group = _group(grasp, tool)
            if known is not None:
                known[key] = group
        suction = tool.suction
        return cls(
            group,
            np.array(plane.rotation),
            np.array(plane.apply((0.0, *group.middle))),
            np.array(grasp.flange_from_box.translation),
            mass,
            suction.cup_force * len(grasp.cups),
            tool.safety,
            np.zeros((3, 3)) if size is None else _inertia(grasp, mass, size),
        )

    def share_in_motion(
        self,
        acceleration: Floats,
        angular_acceleration: Floats,
        angular_velocity: Floats,
        gravity: Floats,
        safety: float | None = None,
    ) -> float:
        """The same for a flange that turns; everything in the flange's frame.

        Args:
            acceleration: (3,) of the flange's origin [m/s^2].
            angular_acceleration: (3,) [rad/s^2].
            angular_velocity: (3,) [rad/s].
            gravity: (3,) downwards [m/s^2].
            safety: divides the pull; the tool's if left out.
        """
        spin, arm = angular_velocity, self.centre
        moved = acceleration + np.cross(angular_acceleration, arm)
        moved = moved + np.cross(spin, np.cross(spin, arm)) - gravity
        turning = self.inertia @ angular_acceleration + np.cross(spin, self.inertia @ spin)
        return self.share(moved, safety, turning)

    def share(
        self,
        specific_force: Floats,
        safety: float | None = None,
        turning: Floats | None = None,
    ) -> float:
        """How much of what is counted on a motion uses; above 1 it is too much.

        Args:
            specific_force: (3,) what the cups must give the box per mass, in the flange's frame:
                its acceleration minus gravity [m/s^2].
            safety: divides the pull; the tool's if left out.
            turning: (3,) the moment about the centre that turns the box, nothing if left out [N m].
        """
        force = -self.mass * specific_force  # on the cups by the box
        moment = np.cross(self.centre - self.middle, force)
        if turning is not None:
            moment = moment - turning
        into_face = self.flange_from_face.T
        counted = self.pull / (self.safety if safety is None else safety)
        share, _ = self.group.load_share(into_face @ force, into_face @ moment, counted)
        return share


def static_share(grasp: Grasp, mass: float, tool: Tool, known: Groups | None = None) -> float:
    """The share of what is counted on that holding still uses, the box upright."""
    up = np.array(grasp.box_from_flange.rotation)[2]  # the box's z, in the flange's frame
    return Holding.of(grasp, mass, tool, known).share(G * up)


def _inertia(grasp: Grasp, mass: float, size: Vector3) -> Floats:
    """Of a box whose mass is spread evenly, in the flange's frame (3, 3) [kg m^2]."""
    squares = np.array(size) ** 2
    turn = np.array(grasp.flange_from_box.rotation)
    about: Floats = turn @ np.diag(mass * (squares.sum() - squares) / 12) @ turn.T
    return about


def in_a_row(grasp: Grasp, tool: Tool) -> bool:
    """Whether its cups lie on one line, about which hardly anything holds against a moment."""
    centres = _centres(grasp, tool)
    return bool(np.linalg.matrix_rank(centres - centres[0], tol=tool.suction.cup_radius) <= 1)


def _group(grasp: Grasp, tool: Tool) -> CupGroup:
    return CupGroup.of(_centres(grasp, tool), tool.suction.cup_radius, tool.suction.friction)


def _centres(grasp: Grasp, tool: Tool) -> Floats:
    """(n, 2) of its cups in their plane [m]."""
    face_from_flange = tool.module(grasp.cups[0][0], folded=grasp.folded).flange_from_face.inverse
    centres = []
    for name, cup in grasp.cups:
        module = tool.module(name, folded=grasp.folded)
        point = module.flange_from_face.apply((0.0, *module.cups[cup]))
        centres.append(face_from_flange.apply(point)[1:])
    return np.array(centres)
