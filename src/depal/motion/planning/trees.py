"""RRT-Connect (Kuffner, LaValle 2000) over the axes' angles, compiled, with seeded samples.

Distances are times: the axis that takes longest at full speed. Samples hold the tool level where a
held box has to stay upright, for at random hardly any does.
"""

import numpy as np
import numpy.typing as npt

from depal.geometry import kernel
from depal.motion.collision.checking import Case
from depal.motion.collision.edges import edge_is_free
from depal.motion.collision.values import Array
from depal.motion.planning.axes import Axes, span
from depal.motion.planning.samples import level_sample, stream_of

Integers = npt.NDArray[np.int64]

TRAPPED, ADVANCED, REACHED = 0, 1, 2

REACH = 0.6
"""A branch grows by this much at once [s at full speed]."""


@kernel
def nearest(tree: Array, count: int, q: Array, speed: Array) -> int:
    """The row of a tree that is nearest to a configuration."""
    best, least = 0, 1e18
    for k in range(count):
        distance = span(tree[k], q, speed)
        if distance < least:
            best, least = k, distance
    return best


@kernel
def extend(
    case: Case, axes: Axes, tree: Array, parent: Integers, count: int, q: Array
) -> tuple[int, int]:
    """Grows a tree towards a configuration by one step; how it ended, and the new count."""
    near = nearest(tree, count, q, axes.speed)
    distance = span(tree[near], q, axes.speed)
    if distance <= REACH:
        new, ended = q.copy(), REACHED
    else:
        new, ended = tree[near] + (q - tree[near]) * (REACH / distance), ADVANCED
    if count >= len(tree) or not edge_is_free(case, tree[near], new, axes.step):
        return TRAPPED, count
    tree[count] = new
    parent[count] = near
    return ended, count + 1


@kernel
def grow_trees(
    case: Case,
    axes: Axes,
    levels: Array,
    start: Array,
    goals: Array,
    iterations: int,
    seed: int,
) -> Array:
    """A path from a start to one of some goals.

    Args:
        case: what must not be touched.
        axes: of the arm.
        levels: (k, 3, 3) see `level_sample`.
        start: (6,) free [rad].
        goals: (g, 6) free [rad].
        iterations: samples that are tried at the most.
        seed: of the samples.

    Returns:
        (n, 6) from the start to a goal; no rows where none was found.
    """
    stream = stream_of(seed)
    room = 2 * iterations + len(goals) + 64
    trees = np.empty((2, room, 6))
    parents = np.full((2, room), -1, np.int64)
    counts = np.array([1, len(goals)])
    trees[0, 0] = start
    trees[1, : len(goals)] = goals
    for k in range(iterations):
        one = k % 2
        other = 1 - one
        q = level_sample(axes.lower, axes.upper, levels, case.dims, stream)
        ended, counts[one] = extend(case, axes, trees[one], parents[one], counts[one], q)
        if ended == TRAPPED:
            continue
        new = trees[one, counts[one] - 1].copy()
        while True:
            ended, counts[other] = extend(
                case, axes, trees[other], parents[other], counts[other], new
            )
            if ended != ADVANCED:
                break
        if ended == REACHED:
            ends = np.array([counts[0] - 1, counts[1] - 1])
            return _joined(trees, parents, ends)
    return np.empty((0, 6))


@kernel
def _joined(trees: Array, parents: Integers, ends: Integers) -> Array:
    forward = 0
    k = ends[0]
    while k >= 0:
        forward += 1
        k = parents[0, k]
    backward = 0
    k = parents[1, ends[1]]  # its end is the same configuration
    while k >= 0:
        backward += 1
        k = parents[1, k]
    path = np.empty((forward + backward, 6))
    k, row = ends[0], forward - 1
    while k >= 0:
        path[row] = trees[0, k]
        k, row = parents[0, k], row - 1
    k, row = parents[1, ends[1]], forward
    while k >= 0:
        path[row] = trees[1, k]
        k, row = parents[1, k], row + 1
    return path
