"""Seen boxes for tests: exact ones, noisy ones, and piles of them."""

import math

import numpy as np

from depal.domain import Gtin
from depal.geometry import OrientedBox, Pose, Vector3
from depal.perception.faces import SeenBox

SIGMA = (0.003, 0.003, 0.003, 0.001, 0.001, 0.005)
"""What perception has: position [m], turns [rad]."""


def spread(sigma: tuple[float, ...] = SIGMA) -> np.ndarray:
    """A covariance."""
    return np.diag(np.square(sigma))


def seen(
    centre: Vector3,
    size: Vector3 = (0.3, 0.3, 0.3),
    yaw: float = 0.0,
    gtin: str | None = None,
    *,
    score: float = 0.95,
    sized: bool = True,
) -> SeenBox:
    """A box as it is."""
    shape = OrientedBox.upright(centre, size, yaw)
    return SeenBox(shape, score, spread(), (), Gtin(gtin) if gtin else None, sized)


def blurred(box: SeenBox, random: np.random.Generator, scale: float = 1.0) -> SeenBox:
    """The same with the errors that its covariance speaks of."""
    errors = random.normal(0.0, np.sqrt(np.diag(box.covariance))) * scale
    centre = np.array(box.shape.centre) + errors[:3]
    rotation = box.shape.pose.rotation
    yaw = math.atan2(rotation[1][0], rotation[0][0]) + float(errors[5])
    pose = Pose.from_yaw((float(centre[0]), float(centre[1]), float(centre[2])), yaw)
    shape = OrientedBox(pose, box.shape.size)
    return SeenBox(shape, box.score, box.covariance, box.faces, box.gtin, box.sized)
