"""A box before all that is known of it has been put together, and after."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.geometry import OrientedBox, Pose
from depal.perception.faces import Errors, Face, Facing

Floats = npt.NDArray[np.float64]

X, Y, Z, YAW = range(4)
"""Of a box's middle in the region's frame [m], and its turn there [rad]."""

SIDEWAYS, DEPTH, TURN = 0.003, 0.006, math.radians(0.7)
"""Of a face that nobody has measured closely: in its plane, square to it [m], its yaw [rad]."""


@dataclass(frozen=True, slots=True)
class Place:
    """A face in the region's frame.

    Attributes:
        face: it.
        region_from_face: where it was found.
        yaw: of the box, by this face alone [rad].
    """

    face: Face
    region_from_face: Pose
    yaw: float

    @property
    def errors(self) -> Errors:
        """Of its place."""
        return self.face.errors or Errors(
            tuple(
                tuple(sigma**2 if i == j else 0.0 for j in range(4))
                for i, sigma in enumerate((SIDEWAYS, SIDEWAYS, DEPTH, TURN))
            ),
            0,
            (0.0,) * 4,
        )


@dataclass(frozen=True, slots=True)
class Draft:
    """A box with its faces.

    Attributes:
        places: of its faces, one or two.
        size: depth, width, height [m].
        stands: whether its height is known, so that it can be said what it stands on.
    """

    places: tuple[Place, ...]
    size: tuple[float, float, float]
    stands: bool

    @property
    def guess(self) -> Floats:
        """(4,) where the box is by its faces, the first of each axis."""
        depth, _, height = self.size
        guesses = []
        for place in self.places:
            x, y, z = place.region_from_face.translation
            c, s = math.cos(place.yaw), math.sin(place.yaw)
            if place.face.facing is Facing.FRONT:
                guesses.append((x + depth / 2 * c, y + depth / 2 * s, z, place.yaw))
            else:
                guesses.append((x, y, z - height / 2, place.yaw))
        return np.asarray(np.mean(guesses, axis=0))

    def off(self, place: Place, state: Floats) -> tuple[Floats, Floats]:
        """How far a face was found from where it is, when the box is in a state.

        Args:
            place: of the face.
            state: (4,).

        Returns:
            (4,) along the face's u, v and depth [m], and clockwise [rad]; and (4, 4) how what is
            expected there changes with the state.
        """
        turn = np.array(place.region_from_face.rotation)
        half = np.zeros(3)
        slope = np.zeros(3)
        c, s = math.cos(state[YAW]), math.sin(state[YAW])
        depth, _, height = self.size
        if place.face.facing is Facing.FRONT:
            half[:] = -depth / 2 * c, -depth / 2 * s, 0.0
            slope[:] = depth / 2 * s, -depth / 2 * c, 0.0
        else:
            half[2] = height / 2
        away = np.array(place.region_from_face.translation) - state[:3] - half
        off = np.append(turn.T @ away, state[YAW] - place.yaw)
        rows = np.zeros((4, 4))
        rows[:3, :3], rows[:3, YAW] = turn.T, turn.T @ slope
        rows[3, YAW] = -1.0
        return off, rows

    def shape(self, state: Floats) -> OrientedBox:
        """The box in a state, in the region's frame; its own x is its depth."""
        x, y, z, yaw = state.tolist()
        return OrientedBox(Pose.from_yaw((x, y, z), yaw), self.size)
