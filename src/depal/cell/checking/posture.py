"""Where the arm's solid parts are in a posture."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.domain import Joints, Robot, Tool
from depal.geometry import OrientedBox, Pose
from depal.motion.kinematics import Kinematics

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
    frames = Kinematics(robot).frames(angles)
    poses = [Pose.from_arrays(frame[:, 3], frame[:, :3]) for frame in frames]
    return [Pose(), *poses[:-1]], poses[-1]
