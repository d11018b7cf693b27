"""RRT-Connect (Kuffner, LaValle 2000) over the axes' angles, compiled, with seeded samples.

Distances are times: the axis that takes longest at full speed. Samples hold the tool level where a
held box has to stay upright, for at random hardly any does.
"""

import math

import numpy as np

from depal.geometry import kernel, loop_kernel
from depal.motion.collision.checking import Case, edge_is_free
from depal.motion.collision.values import Array
from depal.motion.kinematics import link_frames

TRAPPED, ADVANCED, REACHED = 0, 1, 2

REACH = 0.6
"""A branch grows by this much at once [s at full speed]."""


@loop_kernel
def span(a: Array, b: Array, speed: Array) -> float:
    """The time of the straight joint line between two configurations at full speed [s]."""
    most = 0.0
    for axis in range(6):
        most = max(most, abs(a[axis] - b[axis]) / speed[axis])
    return most


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
    case: Case,
    reach: Array,
    step: float,
    speed: Array,
    tree: Array,
    parent: Array,
    count: int,
    q: Array,
) -> tuple[int, int]:
    """Grows a tree towards a configuration by one step; how it ended, and the new count."""
    near = nearest(tree, count, q, speed)
    distance = span(tree[near], q, speed)
    if distance <= REACH:
        new, ended = q.copy(), REACHED
    else:
        new, ended = tree[near] + (q - tree[near]) * (REACH / distance), ADVANCED
    if count >= len(tree) or not edge_is_free(case, tree[near], new, reach, step):
        return TRAPPED, count
    tree[count] = new
    parent[count] = near
    return ended, count + 1


@kernel
def level_sample(lower: Array, upper: Array, levels: Array, dims: Array) -> Array:
    """A random configuration; the wrist turned so that the flange has one of the orientations.

    Args:
        lower: (6,) [rad].
        upper: (6,) [rad].
        levels: (k, 3, 3) orientations of the flange, each free to turn about the vertical; none
            for samples without a condition.
        dims: (7,) of the arm's geometry [m].
    """
    q = np.empty(6)
    for axis in range(6):
        q[axis] = lower[axis] + (upper[axis] - lower[axis]) * np.random.random()
    if len(levels) == 0:
        return q
    level = levels[np.random.randint(len(levels))]
    turn = 2 * math.pi * np.random.random() - math.pi
    if np.random.random() < 0.7:  # mostly outward, as the arm reaches
        turn = -q[0] + 0.8 * (np.random.random() - 0.5)
    frames = np.empty((7, 3, 4))
    q[3], q[4], q[5] = 0.0, 0.0, 0.0
    link_frames(q, dims, frames)
    c, s = math.cos(turn), math.sin(turn)
    m = np.zeros((3, 3))
    for column in range(3):
        wanted0 = c * level[0, column] - s * level[1, column]
        wanted1 = s * level[0, column] + c * level[1, column]
        wanted2 = level[2, column]
        for row in range(3):
            m[row, column] = (
                frames[2, 0, row] * wanted0
                + frames[2, 1, row] * wanted1
                + frames[2, 2, row] * wanted2
            )
    bend = math.hypot(m[1, 0], m[2, 0])
    flip = 1.0 if np.random.random() < 0.5 else -1.0
    q[4] = math.atan2(flip * bend, m[0, 0])
    q[3] = -math.atan2(flip * m[1, 0], -flip * m[2, 0])
    q[5] = -math.atan2(flip * m[0, 1], flip * m[0, 2])
    for axis in range(3, 6):
        q[axis] = min(max(q[axis], lower[axis]), upper[axis])
    return q


@kernel
def grow_trees(
    case: Case,
    reach: Array,
    step: float,
    speed: Array,
    lower: Array,
    upper: Array,
    levels: Array,
    start: Array,
    goals: Array,
    iterations: int,
    seed: int,
) -> Array:
    """A path from a start to one of some goals.

    Args:
        case: what must not be touched.
        reach: (6,) bound of what each axis moves [m].
        step: of the checks along edges [m].
        speed: (6,) of the axes [rad/s].
        lower: (6,) [rad].
        upper: (6,) [rad].
        levels: (k, 3, 3) see `level_sample`.
        start: (6,) free [rad].
        goals: (g, 6) free [rad].
        iterations: samples that are tried at the most.
        seed: of the samples.

    Returns:
        (n, 6) from the start to a goal; no rows where none was found.
    """
    np.random.seed(seed)
    room = 2 * iterations + len(goals) + 64
    trees = np.empty((2, room, 6))
    parents = np.full((2, room), -1, np.int64)
    counts = np.array([1, len(goals)])
    trees[0, 0] = start
    trees[1, : len(goals)] = goals
    for k in range(iterations):
        one = k % 2
        other = 1 - one
        q = level_sample(lower, upper, levels, case.dims)
        ended, counts[one] = extend(
            case, reach, step, speed, trees[one], parents[one], counts[one], q
        )
        if ended == TRAPPED:
            continue
        new = trees[one, counts[one] - 1].copy()
        while True:
            ended, counts[other] = extend(
                case, reach, step, speed, trees[other], parents[other], counts[other], new
            )
            if ended != ADVANCED:
                break
        if ended == REACHED:
            ends = np.array([counts[0] - 1, counts[1] - 1])
            return _joined(trees, parents, ends)
    return np.empty((0, 6))


@kernel
def _joined(trees: Array, parents: Array, ends: Array) -> Array:
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


@kernel
def shorten(
    case: Case, reach: Array, step: float, speed: Array, path: Array, tries: int, seed: int
) -> Array:
    """A path with its detours cut off: straight joint lines between random points of it."""
    np.random.seed(seed)
    points = path.copy()
    for _ in range(tries):
        n = len(points)
        if n < 3:  # noqa: PLR2004 - nothing to cut
            return points
        lengths = np.zeros(n)
        for k in range(1, n):
            lengths[k] = lengths[k - 1] + span(points[k - 1], points[k], speed)
        total = lengths[n - 1]
        s, e = total * np.random.random(), total * np.random.random()
        if s > e:
            s, e = e, s
        i = min(max(np.searchsorted(lengths, s, side="right") - 1, 0), n - 2)
        j = min(max(np.searchsorted(lengths, e, side="right") - 1, 0), n - 2)
        if i == j:
            continue
        a = _between(points, lengths, i, s)
        b = _between(points, lengths, j, e)
        if span(a, b, speed) > 0.999 * (e - s):
            continue
        if not edge_is_free(case, a, b, reach, step):
            continue
        cut = np.empty((i + 1 + 2 + n - 1 - j, 6))
        cut[: i + 1] = points[: i + 1]
        cut[i + 1] = a
        cut[i + 2] = b
        cut[i + 3 :] = points[j + 1 :]
        points = cut
    return points


@kernel
def _between(points: Array, lengths: Array, k: int, s: float) -> Array:
    part = lengths[k + 1] - lengths[k]
    u = (s - lengths[k]) / part if part > 0.0 else 0.0
    return points[k] + (points[k + 1] - points[k]) * u
