"""Straight moves: the flange along a line at constant orientation, as configurations."""

import math

import numpy as np

from depal.geometry import Pose, Vector3, kernel
from depal.motion.collision.values import Array
from depal.motion.kinematics import Kinematics, keep_within, solve_branches

PITCH = 0.01
"""Distance between two configurations of a straight move [m]."""

JUMP = 0.35
"""An axis that turns further than this between two of them has changed its branch [rad]."""


@kernel
def line_path(
    frame: Array, shift: Array, count: int, start: Array, dims: Array, lower: Array, upper: Array
) -> tuple[int, Array]:
    """Configurations along a line, from `start` on.

    Args:
        frame: (3, 4) rows [R | p] of the flange at the start.
        shift: (3,) from the start to the end [m].
        count: how many steps.
        start: (6,) the configuration at the start [rad].
        dims: (7,) of the arm's geometry [m].
        lower: (6,) [rad].
        upper: (6,) [rad].

    Returns:
        How many rows are good, count + 1 for all, and the rows (count + 1, 6).
    """
    path = np.empty((count + 1, 6))
    path[0] = start
    branches, kept, pose = np.empty((8, 6)), np.empty((8, 6)), frame.copy()
    for step in range(1, count + 1):
        for row in range(3):
            pose[row, 3] = frame[row, 3] + shift[row] * step / count
        near = path[step - 1]
        found = keep_within(
            branches, solve_branches(pose, dims, near[3], branches), near, lower, upper, kept
        )
        best, least = -1, 1e18
        for k in range(found):
            most = 0.0
            for axis in range(6):
                most = max(most, abs(kept[k, axis] - near[axis]))
            if most < least:
                best, least = k, most
        if best < 0 or least > JUMP:
            return step, path
        path[step] = kept[best]
    return count + 1, path


def straight(
    kinematics: Kinematics, start: Array, shift: Vector3, pitch: float = PITCH
) -> Array | None:
    """The configurations of a straight move.

    Args:
        kinematics: of the arm.
        start: (6,) where it begins [rad].
        shift: of the flange, in the cell frame [m].
        pitch: distance between two configurations [m].

    Returns:
        (n, 6) [rad], the start included; None where the arm does not reach, or would have to
        change its branch on the way.
    """
    path, whole = _along(kinematics, start, shift, pitch)
    return path if whole else None


def straight_as_far(
    kinematics: Kinematics, start: Array, shift: Vector3, pitch: float = PITCH
) -> Array:
    """The same as far as the arm reaches, (n, 6) [rad]; the start alone where it does not."""
    return _along(kinematics, start, shift, pitch)[0]


def _along(
    kinematics: Kinematics, start: Array, shift: Vector3, pitch: float
) -> tuple[Array, bool]:
    count = max(1, math.ceil(math.dist((0.0, 0.0, 0.0), shift) / pitch))
    frame = kinematics.frames(start)[6]
    good, path = line_path(
        frame, np.array(shift), count, start, kinematics.dims, kinematics.lower, kinematics.upper
    )
    return path[:good], bool(good == count + 1)


def moved(pose: Pose, shift: Vector3) -> Pose:
    """A pose shifted in the frame that it leads to [m]."""
    x, y, z = (a + b for a, b in zip(pose.translation, shift, strict=True))
    return Pose((x, y, z), pose.rotation)
