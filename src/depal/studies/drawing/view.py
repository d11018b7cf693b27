"""Looking at the pallet from the robot's side: a parallel projection onto the sheet."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class View:
    """An orthographic view from the robot's side, z upright in the picture.

    With no turn the viewer looks along +x: +y is on the left.

    Attributes:
        turn: the viewer's step aside, positive to the left (+y) [rad], within +-pi/2.
        rise: how far the viewer looks down [rad], between 0 and pi/2.
    """

    turn: float
    rise: float

    @property
    def towards(self) -> Array:
        """From the scene to the viewer, (3,), of length 1, in the scene's frame."""
        aside, down = (math.cos(self.turn), math.sin(self.turn)), math.cos(self.rise)
        return np.array((-aside[0] * down, aside[1] * down, math.sin(self.rise)))

    @property
    def plane(self) -> Array:
        """The picture's right and up, (2, 3), of length 1 each, in the scene's frame."""
        right = np.array((-math.sin(self.turn), -math.cos(self.turn), 0.0))
        return np.stack((right, np.cross(self.towards, right)))

    def flat(self, points: npt.ArrayLike) -> Array:
        """Points of the scene, (..., 3) [m], in the picture, (..., 2) [m]."""
        flat: Array = np.asarray(points, dtype=float) @ self.plane.T
        return flat


FROM_THE_ROBOT = View(turn=math.radians(-32.0), rise=math.radians(24.0))
"""Front, top and right side are seen: the view of every picture in space."""
