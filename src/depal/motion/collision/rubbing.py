"""How deep a held box seems to reach into what stands around it."""

import numpy as np

from depal.geometry import kernel
from depal.motion.collision.checking import Case, place_solid
from depal.motion.collision.overlap import boxes_meet
from depal.motion.collision.values import Array
from depal.motion.kinematics import link_frames

FINEST = 0.001
"""Depths are told to this [m]."""


@kernel
def overlaps(case: Case, q: Array, deepest: float) -> Array:
    """By how much the held box must shrink on every side to be clear of each solid, (n,) [m].

    Args:
        case: the hand's last solid is the held box.
        q: (6,) [rad].
        deepest: it is not told apart beyond this [m].
    """
    frames, held = np.empty((7, 3, 4)), np.empty((4, 3))
    link_frames(q, case.dims, frames)
    last = len(case.hand.centre) - 1
    place_solid(frames[6], case.hand.centre[last], case.hand.rotation[last], held)
    scene = case.scene
    found = np.zeros(len(scene.centre))
    for k in range(len(scene.centre)):
        while found[k] < deepest and boxes_meet(
            held[0],
            held[1:4],
            case.hand.half[last],
            scene.centre[k],
            scene.rotation[k],
            scene.half[k],
            -found[k],
        ):
            found[k] += FINEST
    return found
