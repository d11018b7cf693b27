"""Whether the straight joint line between two configurations is free.

Between two checks no point moves further than a step: how far each axis moves anything is known
from where everything is at a check, and changes by no more than the step itself until the next.
"""

import math

import numpy as np
import numpy.typing as npt

from depal.geometry import kernel, loop_kernel
from depal.motion.collision.checking import Case, hits
from depal.motion.collision.values import Array

PROBES = 8
"""An edge is looked at in so many parts first: what is in the way shows early."""

BLOCK = 4
"""After so many checks it is worked out anew how far things are from the axes."""

_COLUMN = (2, 1, 1, 0, 1, 0)
"""Which column of its link's frame each axis turns about."""


@loop_kernel
def _from_axis(frames: Array, axis: int, point: Array) -> float:
    """How far a point is from an axis [m]."""
    column = _COLUMN[axis]
    away, along = 0.0, 0.0
    for row in range(3):
        off = point[row] - frames[axis, row, 3]
        away += off * off
        along += off * frames[axis, row, column]
    return math.sqrt(max(0.0, away - along * along))


@loop_kernel
def travel(case: Case, frames: Array, ends: Array, work: Array, turn: Array, slack: float) -> float:
    """How far any point moves at the most while the axes turn [m].

    Args:
        case: the arm, the hand and the scene.
        frames: (7, 3, 4) of the links, from the last check.
        ends: (m, 2, 3) of the capsules, from the last check.
        work: (t, 4, 3) of the hand's solids, from the last check.
        turn: (6,) how far each axis turns [rad].
        slack: by so much anything may have come away from an axis meanwhile [m].
    """
    arm, half = case.arm, case.hand.half
    total = 0.0
    for axis in range(6):
        if turn[axis] == 0.0:
            continue
        furthest = 0.0
        for part in range(len(half)):
            ball = math.sqrt(half[part, 0] ** 2 + half[part, 1] ** 2 + half[part, 2] ** 2)
            furthest = max(furthest, _from_axis(frames, axis, work[part, 0]) + ball)
        for c in range(len(arm.link)):
            if arm.link[c] > axis:
                for end in range(2):
                    out = _from_axis(frames, axis, ends[c, end]) + arm.radius[c]
                    furthest = max(furthest, out)
        total += abs(turn[axis]) * (furthest + slack)
    return total


@kernel
def edge_is_free(case: Case, q0: Array, q1: Array, step: float) -> bool:
    """Whether the straight joint line between two configurations is free.

    Args:
        case: the arm, the hand and the scene.
        q0: (6,) [rad].
        q1: (6,) [rad].
        step: no point moves further between two checks [m].
    """
    frames, ends = np.empty((7, 3, 4)), np.empty((len(case.arm.link), 2, 3))
    work, hit = np.empty((len(case.hand.centre), 4, 3)), np.zeros(2, np.int64)
    turn, q = q1 - q0, np.empty(6)
    for probe in range(1, PROBES + 1):
        # Half way first, then the quarters, then the eighths; the end last.
        part = ((probe * 5) % PROBES) / PROBES if probe < PROBES else 1.0
        if _hits_at(case, q0, turn, part, q, frames, ends, work, hit):
            return False
    done, way = 0.0, 0.0
    count = 0
    while done < 1.0:
        if _hits_at(case, q0, turn, done, q, frames, ends, work, hit):
            return False
        if count % BLOCK == 0:
            way = travel(case, frames, ends, work, turn, 2 * BLOCK * step)
        if way * (1.0 - done) <= step:
            return True  # the end is checked already
        done += step / way
        count += 1
    return True


@loop_kernel
def _hits_at(  # noqa: PLR0913, PLR0917 - scratch is handed through
    case: Case,
    q0: Array,
    turn: Array,
    part: float,
    q: Array,
    frames: Array,
    ends: Array,
    work: Array,
    hit: npt.NDArray[np.int64],
) -> bool:
    for axis in range(6):
        q[axis] = q0[axis] + part * turn[axis]
    return bool(hits(case, q, frames, ends, work, hit))
