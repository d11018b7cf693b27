"""Two looks at a box that has not moved, averaged by their covariances."""

import math
from dataclasses import replace

import numpy as np

from depal.geometry import OrientedBox, Pose
from depal.perception.faces import SeenBox
from depal.perception.memory.anchors import yaw_of

LOOKS = 8
"""So many looks at a box count together at the most: then the oldest are forgotten."""

FREE = [0, 1, 2, 5]
"""Of the covariance's axes those in which an upright box is free: x, y, z, yaw."""


def fused(before: SeenBox, seen: SeenBox, looks: int) -> SeenBox:
    """The box by both, weighted by how well each is known.

    Args:
        before: the average of the looks so far.
        seen: the new look; its axes are next to the others.
        looks: how many are averaged so far.

    Returns:
        The average with its covariance; never better known than `LOOKS` such looks would tell.
    """
    old, new = _block(before), _block(seen)
    if looks >= LOOKS:
        old = old * max(1.0, float((np.diag(new) / LOOKS / np.diag(old)).min()))
    gain = old @ np.linalg.inv(old + new)
    state = _state(before.shape)
    step = _state(seen.shape) - state
    step[3] = math.atan2(math.sin(step[3]), math.cos(step[3]))
    x, y, z, yaw = (state + gain @ step).tolist()
    covariance = np.array(seen.covariance, dtype=float)
    covariance[np.ix_(FREE, FREE)] = (np.eye(4) - gain) @ old
    share = 1.0 / (min(looks, LOOKS) + 1)
    a, b, c = (
        np.array(before.shape.size) * (1 - share) + np.array(seen.shape.size) * share
    ).tolist()
    return replace(
        seen,
        shape=OrientedBox(Pose.from_yaw((x, y, z), yaw), (a, b, c)),
        score=max(seen.score, before.score * (1 - share) + seen.score * share),
        covariance=covariance,
        faces=seen.faces or before.faces,
    )


def _block(box: SeenBox) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    least = np.diag([1e-10, 1e-10, 1e-10, 1e-12])  # nothing is known without an error
    return np.array(box.covariance[np.ix_(FREE, FREE)] + least)


def _state(shape: OrientedBox) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    return np.array([*shape.centre, yaw_of(shape)])
