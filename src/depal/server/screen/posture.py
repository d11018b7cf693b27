"""Where the arm's links are, from its joints, for drawing."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from depal.domain import Robot
from depal.geometry import Vector3
from depal.motion.kinematics import link_frames

DIMENSIONS = ("a1", "a2", "b", "c1", "c2", "c3", "c4")

Turn = tuple[Vector3, Vector3, Vector3]


@dataclass(frozen=True, slots=True)
class LinkPose:
    """Where a link is, in the cell frame.

    Attributes:
        origin: of its frame [m].
        turn: its rotation, by rows.
    """

    origin: Vector3
    turn: Turn

    def at(self, point: Vector3) -> Vector3:
        """A point of the link, in the cell frame [m]."""
        x, y, z = (
            sum(r * p for r, p in zip(row, point, strict=True)) + o
            for row, o in zip(self.turn, self.origin, strict=True)
        )
        return x, y, z


STILL: LinkPose = LinkPose((0.0, 0.0, 0.0), ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)))
"""Of the base."""


def posture(robot: Robot, joints: Sequence[float]) -> tuple[LinkPose, ...]:
    """The base, links 1 to 6 and the flange.

    Args:
        robot: the arm.
        joints: (6,) [rad]; empty for the parked arm.
    """
    given = np.asarray(joints or robot.parked, dtype=np.float64)
    dims = np.array([getattr(robot.geometry, name) for name in DIMENSIONS], dtype=np.float64)
    frames = np.empty((7, 3, 4))
    link_frames(given, dims, frames)
    return (STILL, *(_pose(frame) for frame in frames.tolist()))


def _pose(frame: list[list[float]]) -> LinkPose:
    (a, b, c, x), (d, e, f, y), (g, h, i, z) = frame
    return LinkPose((x, y, z), ((a, b, c), (d, e, f), (g, h, i)))
