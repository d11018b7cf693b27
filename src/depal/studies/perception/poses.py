"""How far off a face was that was found."""

import math
from dataclasses import dataclass

import numpy as np

from depal.perception.faces import Face, Facing
from depal.studies.perception.truth import TrueFace


@dataclass(frozen=True, slots=True)
class PoseError:
    """Of a face that was found, in the true face's frame.

    Attributes:
        facing: which way it looks.
        sideways: its middle, within the face's plane [m].
        depth: its middle, across the plane; positive is too far away [m].
        yaw: its turn about the vertical [rad].
        size: the greater of the errors of width and height [m].
        grasp: whether the box could be grasped as it stands: none is on it or before it.
    """

    facing: Facing
    sideways: float
    depth: float
    yaw: float
    size: float
    grasp: bool = False


def pose_error(found: Face, true: TrueFace, *, grasp: bool = False) -> PoseError:
    """Compares a face with the one that it is.

    Args:
        found: as it was found.
        true: as it is.
        grasp: whether its box could be grasped.
    """
    turn = np.array(true.cell_from_face.rotation)
    off = (np.array(found.cell_from_face.translation) - true.cell_from_face.translation) @ turn
    axes = np.array(found.cell_from_face.rotation)
    if true.facing is Facing.FRONT:
        yaw = _turned(axes[:, 2], turn[:, 2], math.tau)
    else:
        yaw = _turned(axes[:, 0], turn[:, 0], math.pi / 2)
    quarter = true.facing is Facing.TOP and abs(axes[:, 0] @ turn[:, 1]) > abs(
        axes[:, 0] @ turn[:, 0]
    )
    size = found.size[::-1] if quarter else found.size
    wrong = max(abs(a - b) for a, b in zip(size, true.size, strict=True))
    sideways, depth = float(np.hypot(off[0], off[1])), float(off[2])
    return PoseError(true.facing, sideways, depth, yaw, float(wrong), grasp)


def _turned(found: np.ndarray, true: np.ndarray, period: float) -> float:
    """From a direction to another about the vertical, the shortest way [rad]."""
    turn = math.atan2(found[1], found[0]) - math.atan2(true[1], true[0])
    return (turn + period / 2) % period - period / 2
