"""What a motion asks of the suction, as rows that are linear in the path's acceleration.

Along a path q(s) the wrench at the cups is w0 + w1 s'' + w2 s'^2, and the box holds where every row
of `grasping.cone` says so.
"""

from typing import NamedTuple

import numpy as np

from depal.geometry import kernel, loop_kernel
from depal.motion.grasping.cone import cone_rows
from depal.motion.grasping.holding import G, Holding
from depal.motion.timing.legs import Floats


class Load(NamedTuple):
    """A held box, or nothing, as arrays; the face's frame is the plane of touch, x out of it.

    Attributes:
        rows: (k, 6) on force and moment on the cups by the box, in the face's frame: each at most
            1 where the box holds; no rows where nothing is held.
        face: (3, 3) `flange_from_face`.
        centre: (3,) of mass, in the flange's frame [m].
        lever: (3,) from the middle of the cups to the centre of mass, in the face's frame [m].
        inertia: (3, 3) about the centre of mass, in the face's frame [kg m^2].
        mass: [kg].
    """

    rows: Floats
    face: Floats
    centre: Floats
    lever: Floats
    inertia: Floats
    mass: float


NOTHING = Load(np.zeros((0, 6)), np.eye(3), np.zeros(3), np.zeros(3), np.zeros((3, 3)), 0.0)
"""No box is held."""


def load_of(holding: Holding) -> Load:
    """A held box for the timing."""
    face = holding.flange_from_face
    return Load(
        cone_rows(holding),
        np.ascontiguousarray(face),
        holding.centre,
        face.T @ (holding.centre - holding.middle),
        np.ascontiguousarray(face.T @ holding.inertia @ face),
        holding.mass,
    )


@loop_kernel
def _cross(ax: float, ay: float, az: float, b: Floats, out: Floats) -> None:
    """Adds a x b."""
    out[0] += ay * b[2] - az * b[1]
    out[1] += az * b[0] - ax * b[2]
    out[2] += ax * b[1] - ay * b[0]


@loop_kernel
def flange_rates(q1: Floats, q2: Floats, frames: Floats, rates: Floats, work: Floats) -> None:
    """How the flange moves along a path: its velocity over s', its acceleration over s'', s'^2.

    Args:
        q1: (6,) first derivative of the path.
        q2: (6,) second derivative of the path.
        frames: (7, 3, 4) of the links and the flange at this point.
        rates: (4, 3) receives w, v, b, a: turning and moving are w s', v s'; their accelerations
            w s'' + b s'^2 and v s'' + a s'^2, in the cell frame.
        work: (3, 3) scratch.
    """
    for row in range(4):
        for k in range(3):
            rates[row, k] = 0.0
    axis, arm, turned = work[0], work[1], work[2]
    for i in range(6):
        # Axes turn about -z, y, y, -x, y, -x of their links.
        column = 2 if i == 0 else (0 if i in (3, 5) else 1)
        sign = 1.0 if column == 1 else -1.0
        for k in range(3):
            axis[k] = sign * frames[i, k, column]
        # The angular acceleration that the turning of the links before gives this axis.
        for k in range(3):
            arm[k] = axis[k] * q1[i]
        _cross(rates[0, 0], rates[0, 1], rates[0, 2], arm, rates[2])
        for k in range(3):
            rates[0, k] += arm[k]
            rates[2, k] += axis[k] * q2[i]
            arm[k] = frames[i + 1, k, 3] - frames[i, k, 3]
            turned[k] = 0.0
        _cross(rates[0, 0], rates[0, 1], rates[0, 2], arm, turned)
        _cross(rates[2, 0], rates[2, 1], rates[2, 2], arm, rates[3])
        _cross(rates[0, 0], rates[0, 1], rates[0, 2], turned, rates[3])
        for k in range(3):
            rates[1, k] += turned[k]


@loop_kernel
def _wrench(
    load: Load,
    turn: Floats,
    acceleration: Floats,
    angular: Floats,
    spin: Floats,
    work: Floats,
    out: Floats,
) -> None:
    """Force and moment on the cups by the box, in the face's frame.

    Args:
        load: the box.
        turn: (3, 3) `cell_from_face`.
        acceleration: (3,) of its centre, gravity taken off [m/s^2].
        angular: (3,) acceleration [rad/s^2].
        spin: (3,) angular velocity [rad/s].
        work: (4, 3) scratch.
        out: (6,).
    """
    a, alpha, omega, momentum = work[0], work[1], work[2], work[3]
    for k in range(3):
        a[k], alpha[k], omega[k] = 0.0, 0.0, 0.0
        for row in range(3):
            a[k] += turn[row, k] * acceleration[row]
            alpha[k] += turn[row, k] * angular[row]
            omega[k] += turn[row, k] * spin[row]
        a[k] *= -load.mass
    for k in range(3):
        momentum[k] = 0.0
        out[k] = a[k]
        out[3 + k] = 0.0
        for column in range(3):
            momentum[k] += load.inertia[k, column] * omega[column]
            out[3 + k] -= load.inertia[k, column] * alpha[column]
    _cross(-omega[0], -omega[1], -omega[2], momentum, out[3:])
    _cross(load.lever[0], load.lever[1], load.lever[2], a, out[3:])


@kernel
def wrenches(load: Load, frames: Floats, rates: Floats, out: Floats) -> None:
    """The wrench at the cups along a path.

    Args:
        load: the box.
        frames: (7, 3, 4) at this point.
        rates: (4, 3) of `flange_rates`.
        out: (3, 6) receives what stands, what goes with s'', and what goes with s'^2.
    """
    work, turn = np.empty((4, 3)), np.zeros((3, 3))
    arm, moved, still, up = np.zeros(3), np.zeros(3), np.zeros(3), np.zeros(3)
    up[2] = G
    for row in range(3):
        for k in range(3):
            arm[row] += frames[6, row, k] * load.centre[k]
            for column in range(3):
                turn[row, column] += frames[6, row, k] * load.face[k, column]
    spin, push, angular = rates[0], np.zeros(3), rates[2]
    _wrench(load, turn, up, still, still, work, out[0])
    _cross(spin[0], spin[1], spin[2], arm, moved)
    for k in range(3):
        push[k] = rates[3, k]
    _cross(angular[0], angular[1], angular[2], arm, push)
    _cross(spin[0], spin[1], spin[2], moved, push)
    _wrench(load, turn, push, angular, spin, work, out[2])
    for k in range(3):
        moved[k] += rates[1, k]
    _wrench(load, turn, moved, spin, still, work, out[1])
