"""The first bit of a motion from where the arm has come to rest a little too near to something."""

import numpy as np

from depal.motion.collision import Checker, Margins
from depal.motion.collision.values import Array

SLIGHT = 0.005
"""So much nearer than the margins say the arm may stand [m]; what stands nearer has no way out."""

STEPS = (0.001, 0.002, 0.004, 0.008)
"""How far the axes turn at the most, the least first [rad]."""

DIRECTIONS = 96
"""So many ways to turn them are tried."""


def escaped(checker: Checker, start: Array) -> Array | None:
    """The nearest free configuration to one that may be a little too near to something.

    Servos and the errors of poses bring an arm to rest beside where it was to be. On the way to
    the free configuration, nothing comes nearer than a little more than at the start.

    Args:
        checker: what must not be touched.
        start: (6,) [rad].

    Returns:
        (6,) [rad]; the start itself where it is free, None where there is none near.
    """
    if checker.free(start):
        return start
    tight = checker.with_margins(Margins(*(margin - SLIGHT for margin in checker.case.margins)))
    if not tight.free(start):
        return None
    drawn = np.random.default_rng(0).uniform(-1.0, 1.0, (DIRECTIONS, len(start)))
    for step in STEPS:
        for direction in drawn:
            near = start + step * direction
            if checker.free(near) and tight.edge_free(start, near):
                return np.asarray(near)
    return None
