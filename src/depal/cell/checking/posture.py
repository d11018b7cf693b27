"""Where the arm's solid parts are in a posture."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.domain import JOINT_AXES, Joints, Robot, Tool
from depal.geometry import Matrix3, OrientedBox, Pose, Vector3

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Posture:
    """The arm's solid parts in the cell frame.

    Attributes:
        starts: one end of each capsule, (n, 3) [m].
        ends: the other end, (n, 3) [m].
        radii: (n,) [m].
        tool: its solid parts, the lower module unfolded.
        joints: the axes' points from the base to the flange, (8, 3) [m].
    """

    starts: Array
    ends: Array
    radii: Array
    tool: tuple[OrientedBox, ...]
    joints: Array


def posture(robot: Robot, tool: Tool, angles: Joints) -> Posture:
    """Where everything is at the given angles.

    Args:
        robot: the arm.
        tool: on its flange.
        angles: of the six axes [rad].
    """
    links, flange = link_poses(robot, angles)
    starts = [links[shape.link].apply(shape.start) for shape in robot.shapes]
    ends = [links[shape.link].apply(shape.end) for shape in robot.shapes]
    return Posture(
        np.array(starts).reshape(-1, 3),
        np.array(ends).reshape(-1, 3),
        np.array([shape.radius for shape in robot.shapes]),
        tuple(box.seen_from(flange) for box in tool.shapes),
        np.array([*(link.translation for link in links), flange.translation]),
    )


def link_poses(robot: Robot, angles: Joints) -> tuple[list[Pose], Pose]:
    """The frames of the seven links and of the flange, in the cell.

    Args:
        robot: the arm.
        angles: of the six axes [rad].
    """
    *origins, flange_origin = robot.geometry.joint_origins
    links = [Pose()]
    for origin, axis, angle in zip(origins, JOINT_AXES, angles, strict=True):
        links.append(links[-1] @ Pose(origin, about(axis, angle)))
    return links, links[-1] @ Pose(flange_origin)


def about(axis: Vector3, angle: float) -> Matrix3:
    """The turn about an axis of length 1 by an angle [rad] (Rodrigues)."""
    x, y, z = axis
    c, s = math.cos(angle), math.sin(angle)
    u = 1.0 - c
    return (
        (c + x * x * u, x * y * u - z * s, x * z * u + y * s),
        (y * x * u + z * s, c + y * y * u, y * z * u - x * s),
        (z * x * u - y * s, z * y * u + x * s, c + z * z * u),
    )
