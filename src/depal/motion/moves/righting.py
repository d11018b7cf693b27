"""A held box that leans further than it may, for its task allows less now, is turned upright."""

import math

import numpy as np

from depal.domain import Grasp
from depal.geometry import Pose, Vector3
from depal.motion.collision import Scene
from depal.motion.collision.values import Array
from depal.motion.moves.margins import OPEN
from depal.motion.moves.reach import Reach
from depal.motion.moves.values import Kind, Part

FURTHER = math.radians(0.5)
"""While it is turned upright it may lean so much further than where it hangs [rad]."""


def righted(
    reach: Reach, start: Array, scene: Scene, grasp: Grasp, size: Vector3
) -> tuple[Part, ...]:
    """The motion that turns a held box upright, the flange's origin where it is.

    Args:
        reach: of the arm, with how far the box may lean.
        start: (6,) where the arm is [rad].
        scene: all that stands around, the held box left out.
        grasp: how the box is held.
        size: of the box [m].

    Returns:
        One part; none where the box leans no further than it may, or something is in the way.
    """
    frame = reach.body.kinematics.frames(start)[6]
    up = frame[:, :3] @ np.array(grasp.box_from_flange.rotation)[2]
    lean = math.acos(min(1.0, max(-1.0, float(up[2]))))
    if lean <= reach.tilt:
        return ()
    upright = Pose.from_arrays(frame[:, 3], _onto_vertical(up) @ frame[:, :3])
    there = reach.checker(scene, OPEN, grasp, size)
    along = reach.leaning(lean + FURTHER).checker(scene, OPEN, grasp, size)
    for q in reach.branches(upright, start):
        if there.free(q) and along.edge_free(start, q):
            return (Part(Kind.FREE, np.stack((start, q))),)
    return ()


def _onto_vertical(up: Array) -> Array:
    """The shortest turn that brings a direction of length 1 onto the vertical, (3, 3)."""
    x, y, z = up.tolist()
    cross = np.array([[0.0, 0.0, -x], [0.0, 0.0, -y], [x, y, 0.0]])
    turn: Array = np.eye(3) + cross + cross @ cross / (1.0 + z)
    return turn
