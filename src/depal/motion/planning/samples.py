"""Random numbers and random configurations in kernels; the same seed gives the same bytes."""

import math

import numpy as np
import numpy.typing as npt

from depal.geometry import kernel, loop_kernel
from depal.motion.collision.values import Array
from depal.motion.kinematics import link_frames

Stream = npt.NDArray[np.int64]
"""(2,) the state of a stream of random numbers."""

FIRST, SECOND = 2147483563, 2147483399

OUTWARD = 0.7
"""The share of level samples that look outward, as the arm reaches."""

SWING = 0.4
"""So far do those look aside, either way [rad]."""


@kernel
def stream_of(seed: int) -> Stream:
    """A stream of random numbers, already away from its seed."""
    stream = np.array([1 + seed % (FIRST - 1), 1 + (seed * 7 + 12345) % (SECOND - 1)], np.int64)
    for _ in range(8):
        uniform(stream)
    return stream


@loop_kernel
def uniform(stream: Stream) -> float:
    """The next number in (0, 1): two multiplicative generators combined (L'Ecuyer 1988)."""
    stream[0] = 40014 * stream[0] % FIRST
    stream[1] = 40692 * stream[1] % SECOND
    return float(((stream[0] - stream[1]) % (FIRST - 1) + 1) / FIRST)


@kernel
def level_sample(lower: Array, upper: Array, levels: Array, dims: Array, stream: Stream) -> Array:
    """A random configuration; the wrist turned so that the flange has one of the orientations.

    Args:
        lower: (6,) [rad].
        upper: (6,) [rad].
        levels: (k, 3, 3) orientations of the flange, each free to turn about the vertical; none
            for samples without a condition.
        dims: (7,) of the arm's geometry [m].
        stream: of random numbers.
    """
    q = np.empty(6)
    for axis in range(6):
        q[axis] = lower[axis] + (upper[axis] - lower[axis]) * uniform(stream)
    if len(levels) == 0:
        return q
    level = levels[min(int(uniform(stream) * len(levels)), len(levels) - 1)]
    turn = math.pi * (2 * uniform(stream) - 1)
    if uniform(stream) < OUTWARD:
        turn = -q[0] + SWING * (2 * uniform(stream) - 1)
    frames = np.empty((7, 3, 4))
    q[3], q[4], q[5] = 0.0, 0.0, 0.0
    link_frames(q, dims, frames)
    c, s = math.cos(turn), math.sin(turn)
    m = np.zeros((3, 3))  # the flange's orientation, seen from link 3
    for column in range(3):
        x = c * level[0, column] - s * level[1, column]
        y = s * level[0, column] + c * level[1, column]
        z = level[2, column]
        for row in range(3):
            m[row, column] = frames[2, 0, row] * x + frames[2, 1, row] * y + frames[2, 2, row] * z
    flip = 1.0 if 2 * uniform(stream) < 1.0 else -1.0
    q[4] = math.atan2(flip * math.hypot(m[1, 0], m[2, 0]), m[0, 0])
    q[3] = -math.atan2(flip * m[1, 0], -flip * m[2, 0])
    q[5] = -math.atan2(flip * m[0, 1], flip * m[0, 2])
    for axis in range(3, 6):
        wound = q[axis] + 2 * math.pi * (int(3 * uniform(stream)) - 1)  # axes 4 and 6 turn twice
        if lower[axis] <= wound <= upper[axis]:
            q[axis] = wound
        q[axis] = min(max(q[axis], lower[axis]), upper[axis])
    return q
