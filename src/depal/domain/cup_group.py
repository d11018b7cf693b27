"""When cups let go: the load on a group of cups against what its vacuum holds.

The vacuum presses the lips on the box, and both are stiff against tilting: cleats in the cups. A
pull takes from that pressure; a moment moves its centre, and where this would leave the outline of
the lips, the box tips about one edge and lifts the other. Shear, and the twist about the normal,
are carried by friction under what pressure is left.
"""

import math
from dataclasses import dataclass
from enum import Enum

import numpy as np
import numpy.typing as npt
from scipy.spatial import ConvexHull

Floats = npt.NDArray[np.float64]

RIM = 12
"""Points that stand for the lip of a cup."""


class Break(Enum):
    """Why a group of cups lets go."""

    PULL = "pull"
    SHEAR = "shear"
    PEEL = "peel"


@dataclass(frozen=True, slots=True, eq=False)
class CupGroup:
    """The cups of one module that hold one box.

    Attributes:
        middle: the mean of their centres, in the face's y and z [m].
        count: of cups.
        friction: of a cup on the box.
        tension_from_moment: (m, 2) the pressure that a moment about y and one about z need to be
            held, for tipping about each edge of the lips' outline [N / N m].
        arm: the lever of the twist about the normal [m].
    """

    middle: tuple[float, float]
    count: int
    friction: float
    tension_from_moment: Floats
    arm: float

    @classmethod
    def of(cls, cups: Floats, radius: float, friction: float) -> "CupGroup":
        """The group of cups with these centres in the face's y and z, (n, 2) [m]."""
        middle = cups.mean(axis=0)
        angles = np.arange(RIM) * 2 * np.pi / RIM
        ring = radius * np.stack((np.cos(angles), np.sin(angles)), axis=1)
        rim = ((cups - middle)[:, None, :] + ring[None, :, :]).reshape(-1, 2)
        arm = math.sqrt(float((rim**2).mean(axis=0).sum()))
        # The pressure's centre (M_z, -M_y) / N stays within n . p <= reach for every edge.
        outward = ConvexHull(rim).equations
        normals, reach = outward[:, :2], -outward[:, 2:]
        tension = np.stack((-normals[:, 1], normals[:, 0]), axis=1) / reach
        return cls((float(middle[0]), float(middle[1])), len(cups), friction, tension, arm)

    def load_share(self, force: Floats, moment: Floats, vacuum_force: float) -> tuple[float, Break]:
        """How much of what holds the load uses: above 1 the group lets go.

        Args:
            force: on the cups by the box, in the face's frame: x away from the tool [N].
            moment: on the cups by the box, about the middle of the group [N m].
            vacuum_force: area times vacuum of all cups of the group [N].

        Returns:
            The greatest of the three shares, and which it is.
        """
        pull, side, up = force.tolist()
        if pull >= vacuum_force:
            return (pull / vacuum_force if vacuum_force > 0 else math.inf), Break.PULL
        twist = float(moment[0]) / self.arm
        grip = self.friction * (vacuum_force - pull)
        shear = math.sqrt(side**2 + up**2 + twist**2) / grip
        lift = (pull + float((self.tension_from_moment @ moment[1:]).max())) / vacuum_force
        shares = ((pull / vacuum_force, Break.PULL), (lift, Break.PEEL), (shear, Break.SHEAR))
        return max(shares, key=lambda share: share[0])
