"""From what people write about a pose to the pose."""

import math

from depal.geometry import Matrix3, Pose, Vector3

_QUARTER = 90.0
_UPRIGHT = 1e-6
"""A line of sight whose horizontal part is shorter looks straight up or down."""


def radians(degrees: float) -> float:
    """An angle [rad]."""
    return math.radians(degrees)


def turned(at: Vector3, *, roll: float = 0.0, pitch: float = 0.0, yaw: float = 0.0) -> Pose:
    """A pose from a place [m] and turns about the fixed x, then y, then z axis [deg].

    Quarter turns are exact, so that a file's right angles stay right angles.
    """
    (cr, sr), (cp, sp), (cy, sy) = map(_cos_sin, (roll, pitch, yaw))
    rotation: Matrix3 = (
        (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        (-sp, cp * sr, cp * cr),
    )
    return Pose(at, rotation)


def looking(at: Vector3, target: Vector3) -> Pose:
    """The pose of a lens: z towards a target, x right, y down in the picture [m].

    One that looks straight up or down has the cell's x at the top of its picture.
    """
    forward = _unit((target[0] - at[0], target[1] - at[1], target[2] - at[2]))
    up: Vector3 = (0.0, 0.0, 1.0)
    if math.hypot(forward[0], forward[1]) < _UPRIGHT:
        up = (1.0, 0.0, 0.0)
    right = _unit(_cross(forward, up))
    down = _cross(forward, right)
    rows = tuple(zip(right, down, forward, strict=True))
    return Pose(at, (rows[0], rows[1], rows[2]))


def _cos_sin(degrees: float) -> tuple[float, float]:
    quarters, rest = divmod(degrees, _QUARTER)
    if rest == 0:
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[int(quarters) % 4]
    angle = math.radians(degrees)
    return math.cos(angle), math.sin(angle)


def _cross(a: Vector3, b: Vector3) -> Vector3:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _unit(vector: Vector3) -> Vector3:
    length = math.hypot(*vector)
    return (vector[0] / length, vector[1] / length, vector[2] / length)
