"""Forward and inverse kinematics of ortho-parallel arms with a spherical wrist, closed form.

The convention is `domain.robot.ArmGeometry`'s. The inverse splits at the wrist's centre: a planar
two-link problem for axes 1 to 3 (front and back, elbow up and down), then the wrist's three angles
(flipped or not): eight branches (Brandstoetter, Angerer, Hofbaur 2014).
"""

import math

import numpy as np
import numpy.typing as npt

from depal.domain import Joints, Robot
from depal.errors import CellError, Problem
from depal.geometry import Pose, kernel, loop_kernel

Array = npt.NDArray[np.float64]

SINGULAR = 1e-12
"""Below this sine of axis 5 axes 4 and 6 turn about the same line."""

STRETCHED = 1e-12
"""A fully stretched arm is in reach, whatever rounding says of its cosine."""


@loop_kernel
def link_frames(q: Array, dims: Array, out: Array) -> None:
    """Where every link's frame and the flange's are.

    Args:
        q: (6,) [rad].
        dims: (7,) a1, a2, b, c1, c2, c3, c4 [m].
        out: (7, 3, 4) receives rotation and origin of links 1 to 6, then of the flange, as rows
            [R | p] in the cell frame.
    """
    c1, s1 = math.cos(q[0]), math.sin(q[0])
    # Link 1: Rz(-q1)
    out[0, 0, 0], out[0, 0, 1], out[0, 0, 2] = c1, s1, 0.0
    out[0, 1, 0], out[0, 1, 1], out[0, 1, 2] = -s1, c1, 0.0
    out[0, 2, 0], out[0, 2, 1], out[0, 2, 2] = 0.0, 0.0, 1.0
    for row in range(3):
        out[0, row, 3] = 0.0
    _next_y(out, 0, q[1], dims[0], 0.0, dims[3])
    _next_y(out, 1, q[2], dims[4], 0.0, 0.0)
    _next_x(out, 2, -q[3], 0.0, dims[2], -dims[1])
    _next_y(out, 3, q[4], dims[5], 0.0, 0.0)
    _next_x(out, 4, -q[5], 0.0, 0.0, 0.0)
    for row in range(3):
        for column in range(3):
            out[6, row, column] = out[5, row, column]
        out[6, row, 3] = out[5, row, 3] + out[5, row, 0] * dims[6]


@loop_kernel
def _next_y(out: Array, k: int, angle: float, x: float, y: float, z: float) -> None:
    """Link k + 1 from link k: a shift, then a turn about y."""
    c, s = math.cos(angle), math.sin(angle)
    for row in range(3):
        rx, ry, rz = out[k, row, 0], out[k, row, 1], out[k, row, 2]
        out[k + 1, row, 3] = out[k, row, 3] + rx * x + ry * y + rz * z
        out[k + 1, row, 0] = rx * c - rz * s
        out[k + 1, row, 1] = ry
        out[k + 1, row, 2] = rx * s + rz * c


@loop_kernel
def _next_x(out: Array, k: int, angle: float, x: float, y: float, z: float) -> None:
    """Link k + 1 from link k: a shift, then a turn about x."""
    c, s = math.cos(angle), math.sin(angle)
    for row in range(3):
        rx, ry, rz = out[k, row, 0], out[k, row, 1], out[k, row, 2]
        out[k + 1, row, 3] = out[k, row, 3] + rx * x + ry * y + rz * z
        out[k + 1, row, 0] = rx
        out[k + 1, row, 1] = ry * c + rz * s
        out[k + 1, row, 2] = rz * c - ry * s


@loop_kernel
def solve_branches(flange: Array, dims: Array, near4: float, out: Array) -> int:
    """Every branch for a pose of the flange, angles in (-pi, pi], limits not looked at.

    Args:
        flange: (3, 4) rows [R | p] in the cell frame.
        dims: (7,) a1, a2, b, c1, c2, c3, c4 [m]; b is 0.
        near4: axis 4 where the wrist is singular [rad].
        out: (8, 6) receives the branches.

    Returns:
        How many there are; 0 out of reach.
    """
    a1, a2, c1, c2, c3, c4 = dims[0], dims[1], dims[3], dims[4], dims[5], dims[6]
    wx = flange[0, 3] - c4 * flange[0, 0]
    wy = flange[1, 3] - c4 * flange[1, 0]
    wz = flange[2, 3] - c4 * flange[2, 0]
    radius = math.hypot(wx, wy)
    heading = math.atan2(wy, wx)
    fore = math.hypot(c3, a2)
    fore_angle = math.atan2(a2, c3)
    found = 0
    for back in range(2):
        q1 = -heading if back == 0 else -heading + (math.pi if heading > 0 else -math.pi)
        r = (radius if back == 0 else -radius) - a1
        h = wz - c1
        distance = math.hypot(r, h)
        cosine = (c2 * c2 + distance * distance - fore * fore) / (2 * c2 * distance)
        if not abs(cosine) <= 1.0 + STRETCHED:  # no number where the wrist is on axis 2 itself
            continue
        spread = math.acos(min(max(cosine, -1.0), 1.0))
        down = math.atan2(-h, r)
        for elbow in range(2):
            q2 = down - spread if elbow == 0 else down + spread
            q3 = math.atan2(-(h + c2 * math.sin(q2)), r - c2 * math.cos(q2)) - fore_angle - q2
            found = _wrist(flange, q1, q2, q3, near4, out, found)
    return found


@loop_kernel
def _wrist(
    flange: Array, q1: float, q2: float, q3: float, near4: float, out: Array, found: int
) -> int:
    """Both wrist branches for the first three axes."""
    c1, s1 = math.cos(q1), math.sin(q1)
    c, s = math.cos(q2 + q3), math.sin(q2 + q3)
    # Rows of (Rz(-q1) Ry(q2 + q3))^T, times the flange's rotation.
    x0, x1, x2 = c * c1, -c * s1, -s
    y0, y1 = s1, c1
    z0, z1, z2 = s * c1, -s * s1, c
    m00 = x0 * flange[0, 0] + x1 * flange[1, 0] + x2 * flange[2, 0]
    m10 = y0 * flange[0, 0] + y1 * flange[1, 0]
    m11 = y0 * flange[0, 1] + y1 * flange[1, 1]
    m20 = z0 * flange[0, 0] + z1 * flange[1, 0] + z2 * flange[2, 0]
    m21 = z0 * flange[0, 1] + z1 * flange[1, 1] + z2 * flange[2, 1]
    m12 = y0 * flange[0, 2] + y1 * flange[1, 2]
    m22 = z0 * flange[0, 2] + z1 * flange[1, 2] + z2 * flange[2, 2]
    bend = math.hypot(m10, m20)
    if bend < SINGULAR:
        q5 = 0.0 if m00 > 0 else math.pi
        _put(out, found, q1, q2, q3, near4, q5, _roll(m11, m21, m12, m22, near4))
        return found + 1
    q5, q4 = math.atan2(bend, m00), -math.atan2(m10, -m20)
    _put(out, found, q1, q2, q3, q4, q5, _roll(m11, m21, m12, m22, q4))
    q4 += math.pi
    _put(out, found + 1, q1, q2, q3, q4, -q5, _roll(m11, m21, m12, m22, q4))
    return found + 2


@loop_kernel
def _roll(m11: float, m21: float, m12: float, m22: float, q4: float) -> float:
    """Axis 6 once axis 4 is chosen: so it makes up for what rounding did to axis 4.

    Near the wrist's singularity axis 4 is known badly, and axis 6 alone would be as well.
    """
    c, s = math.cos(q4), math.sin(q4)
    return math.atan2(c * m12 - s * m22, c * m11 - s * m21)


@loop_kernel
def _put(
    out: Array, k: int, q1: float, q2: float, q3: float, q4: float, q5: float, q6: float
) -> None:
    values = (q1, q2, q3, q4, q5, q6)
    for axis in range(6):
        value = values[axis]
        out[k, axis] = value - 2 * math.pi * math.floor((value + math.pi) / (2 * math.pi))


@loop_kernel
def keep_within(
    branches: Array, count: int, near: Array, lower: Array, upper: Array, out: Array
) -> int:
    """The branches that the axes' limits allow, each axis by the turn that is nearest to `near`.

    Args:
        branches: (8, 6) [rad].
        count: how many of them there are.
        near: (6,) [rad].
        lower: (6,) [rad].
        upper: (6,) [rad].
        out: (8, 6) receives them.

    Returns:
        How many are left.
    """
    kept = 0
    for k in range(count):
        good = True
        for axis in range(6):
            value = branches[k, axis]
            best, best_off = 0.0, math.inf
            for turn in range(-1, 2):
                angle = value + 2 * math.pi * turn
                if angle < lower[axis] - 1e-9 or angle > upper[axis] + 1e-9:
                    continue
                off = abs(angle - near[axis])
                if off < best_off:
                    best, best_off = angle, off
            if best_off == math.inf:
                good = False
                break
            out[kept, axis] = best
        if good:
            kept += 1
    return kept


@kernel
def solve_near(flange: Array, near: Array, dims: Array, lower: Array, upper: Array) -> Array:
    """Every configuration within the limits that reaches a pose, (k, 6); see `keep_within`."""
    branches, kept = np.empty((8, 6)), np.empty((8, 6))
    count = solve_branches(flange, dims, near[3], branches)
    return kept[: keep_within(branches, count, near, lower, upper, kept)].copy()


class Kinematics:
    """The kinematics of one arm.

    Attributes:
        dims: (7,) a1, a2, b, c1, c2, c3, c4 [m].
        lower: (6,) limits [rad].
        upper: (6,) limits [rad].
    """

    def __init__(self, robot: Robot) -> None:
        """Of an arm.

        Raises:
            CellError: its forearm is offset sideways, which has no closed form here.
        """
        g = robot.geometry
        if g.b != 0.0:
            problem = Problem("robot.geometry.b", f"{g.b} m", "0: no sideways offset")
            raise CellError(robot.name, [problem])
        self.dims = np.array([g.a1, g.a2, g.b, g.c1, g.c2, g.c3, g.c4])
        self.lower = np.array(robot.limits.lower)
        self.upper = np.array(robot.limits.upper)

    def frames(self, joints: Joints | Array) -> Array:
        """(7, 3, 4) rows [R | p] of links 1 to 6 and the flange, in the cell frame [m]."""
        out = np.empty((7, 3, 4))
        link_frames(np.asarray(joints, dtype=np.float64), self.dims, out)
        return out

    def flange(self, joints: Joints | Array) -> Pose:
        """`cell_from_flange`."""
        frame = self.frames(joints)[6]
        return Pose.from_arrays(frame[:, 3], frame[:, :3])

    def solve(self, cell_from_flange: Pose, near: Joints | Array | None = None) -> Array:
        """Every configuration within the limits that brings the flange to a pose.

        Args:
            cell_from_flange: the pose.
            near: of all turns of an axis the one nearest to this is taken [rad]; zeros if left out.

        Returns:
            (k, 6) [rad], at most 8 rows; none where the pose is out of reach.
        """
        reference = np.zeros(6) if near is None else np.asarray(near, dtype=np.float64)
        return solve_near(rows_of(cell_from_flange), reference, self.dims, self.lower, self.upper)

    def jacobian(self, joints: Joints | Array) -> Array:
        """(6, 6) of the flange's origin: velocity over turning rate in the cell frame, by axis."""
        frames = self.frames(joints)
        tip = frames[6, :, 3]
        out = np.empty((6, 6))
        for axis in range(6):
            column = _AXIS_COLUMN[axis]
            direction = _AXIS_SIGN[axis] * frames[axis, :, column]
            out[:3, axis] = np.cross(direction, tip - frames[axis, :, 3])
            out[3:, axis] = direction
        return out


_AXIS_COLUMN = (2, 1, 1, 0, 1, 0)
_AXIS_SIGN = (-1.0, 1.0, 1.0, -1.0, 1.0, -1.0)


def rows_of(pose: Pose) -> Array:
    """(3, 4) rows [R | p] of a pose."""
    return np.column_stack((np.array(pose.rotation), np.array(pose.translation)))
