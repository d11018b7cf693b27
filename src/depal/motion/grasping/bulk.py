"""A held box of which the size is not known for sure: the room that it may take in the hand."""

from dataclasses import replace

import numpy as np

from depal.domain import Approach, Grasp
from depal.geometry import Pose, Vector3

EXACT: Vector3 = (0.0, 0.0, 0.0)
"""Of a box whose size is known."""


def held_axis(grasp: Grasp, size: Vector3) -> int:
    """The axis of a box that its held face is normal to.

    Args:
        grasp: how it is held.
        size: of the box along its own axes [m].
    """
    if grasp.approach is not Approach.HORIZONTAL:
        return 2
    at = np.abs(np.array(grasp.box_from_flange.translation[:2]))
    return int(np.argmax(at - np.array(size[:2]) / 2))


def resized(grasp: Grasp, old: Vector3, new: Vector3) -> Grasp:
    """A grasp of a box of which somebody has told the true size: the held face stays in place.

    Args:
        grasp: as it was planned.
        old: the size that was believed [m].
        new: the true one, along the same axes [m].
    """
    at = np.array(grasp.box_from_flange.translation)
    axis = held_axis(grasp, old)
    at[axis] += np.sign(at[axis]) * (new[axis] - old[axis]) / 2
    return replace(grasp, box_from_flange=Pose.from_arrays(at, grasp.box_from_flange.rotation))


def swollen(grasp: Grasp, size: Vector3, beyond: Vector3) -> tuple[Grasp, Vector3]:
    """The smallest box around all that a held one can be, and the same grasp of it.

    The held face is where the cups are; every other face may be farther out.

    Args:
        grasp: of the box as it is believed.
        size: as it is believed, along its own axes [m].
        beyond: how much longer it may be along each axis, at either end [m].
    """
    if beyond == EXACT:
        return grasp, size
    more = 2 * np.array(beyond)
    more[held_axis(grasp, size)] /= 2
    a, b, c = (np.array(size) + more).tolist()
    return resized(grasp, size, (a, b, c)), (a, b, c)
