"""What is known of a face's place, as more and more of it is measured."""

import math
from dataclasses import dataclass
from typing import Self

import numpy as np
import numpy.typing as npt

from depal.geometry import Pose

Floats = npt.NDArray[np.float64]

U, V, DEPTH, SWING, TURN, WIDTH, HEIGHT = range(7)
"""A face may be moved along its width, downward, and into the box [m], turned about its downward
axis and, clockwise as seen, about its normal [rad], and be wider and higher than thought [m]."""

STATES = 7


@dataclass(frozen=True, slots=True, eq=False)
class Belief:
    """A normal distribution of the seven errors of a face, from where it is thought to be.

    Attributes:
        information: (7, 7) the inverse of the covariance.
        pull: (7,) information times mean.
    """

    information: Floats
    pull: Floats

    @classmethod
    def around(cls, sigma: tuple[float, ...]) -> Self:
        """That every error is about zero.

        Args:
            sigma: (7,) standard deviations.
        """
        return cls(np.diag(np.array(sigma) ** -2.0), np.zeros(STATES))

    def __add__(self, other: "Belief") -> "Belief":
        """Both together, of independent measurements."""
        return Belief(self.information + other.information, self.pull + other.pull)

    @property
    def mean(self) -> Floats:
        """(7,)."""
        return np.asarray(np.linalg.solve(self.information, self.pull))

    @property
    def covariance(self) -> Floats:
        """(7, 7)."""
        return np.asarray(np.linalg.inv(self.information))

    def from_there(self, step: Floats) -> "Belief":
        """The same of a face that has been moved by a step (7,) already."""
        return Belief(self.information, self.pull - self.information @ step)


def told(rows: Floats, values: Floats, sigma: Floats) -> Belief:
    """What measurements say.

    Args:
        rows: (n, 7) how each changes with the errors.
        values: (n,) what was measured, less what was expected.
        sigma: (n,) standard deviations.
    """
    weighted = rows / (sigma**2)[:, None]
    return Belief(weighted.T @ rows, weighted.T @ values)


def moved(cell_from_face: Pose, step: Floats) -> Pose:
    """A face's pose after a step (7,)."""
    c, s = math.cos(step[TURN]), math.sin(step[TURN])
    k, n = math.cos(step[SWING]), math.sin(step[SWING])
    swing = Pose(rotation=((k, 0.0, n), (0.0, 1.0, 0.0), (-n, 0.0, k)))
    u, v, depth = step[:3].tolist()
    turn = Pose((u, v, depth), ((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)))
    return cell_from_face @ turn @ swing


def flow(x: Floats, y: Floats, eye: tuple[float, float, float]) -> Floats:
    """How points of a face move in the picture that is laid flat where it is thought to be.

    A point that lies deeper than thought is seen nearer to the eye's foot.

    Args:
        x: (n,) of the points, from the face's middle [m].
        y: (n,) [m].
        eye: of the camera, in the face's frame [m].

    Returns:
        (n, 2, 7) along x and y, for each of the errors.
    """
    high = -eye[2]
    out = np.zeros((len(x), 2, STATES))
    nearer = np.stack(((eye[0] - x) / high, (eye[1] - y) / high), axis=1)
    out[:, 0, U] = out[:, 1, V] = 1.0
    out[:, :, DEPTH] = nearer
    out[:, :, SWING] = -nearer * x[:, None]
    out[:, 0, TURN], out[:, 1, TURN] = -y, x
    return out
