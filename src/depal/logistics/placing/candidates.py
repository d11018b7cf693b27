"""Spots worth trying: pushed in until something is met, tight against neighbours, flush on top."""

from typing import NamedTuple

from depal.geometry import loop_kernel
from depal.logistics.placing.bearing import bears
from depal.logistics.placing.feasible import NOWHERE, deepest, lands
from depal.logistics.placing.scene import EPS, Array, Load, Rules, Scene

SIDES_PER_BOX = 7
"""Ways to stand beside or upon one box."""

CAPACITY = 4096
"""No more candidates are listed; 15 boxes give some hundreds."""

STEP = 0.08
"""How far apart the spots are that are less deep than could be [m]."""

STEPS = 4
"""How many of them there are."""

SKIP = 1e9
"""A side that does not exist."""


class Weights(NamedTuple):
    """What makes a spot good; the smallest sum is best. Chosen with `measure_fill`.

    Attributes:
        lost: per share of the place's volume that nothing can use any more.
        shallow: per metre between the outward face and the back.
        high: per metre above the floor.
        front: for what is lost in front of the box, as a share of the same behind it.
        narrow: gaps narrower than this are of no use [m].
        wide: gaps wider than this are of full use [m].
        flat: room lower than this is of no use [m].
        tall: room higher than this is of full use [m].
    """

    lost: float = 1.00
    shallow: float = 0.50
    high: float = 0.03
    front: float = 0.60
    narrow: float = 0.10
    wide: float = 0.35
    flat: float = 0.10
    tall: float = 0.15


@loop_kernel
def side_at(scene: Scene, load: Load, rules: Rules, z: float, index: int) -> float:
    """The y of the box's middle for one way to stand: at a wall, beside or upon a box [m]."""
    c, half = rules.clearance, load.width / 2
    reach_left, reach_right = half, -half
    for t in range(len(load.tool)):
        reach_left = max(reach_left, load.tool[t, 2])
        reach_right = min(reach_right, load.tool[t, 1])
    walls = (
        scene.width / 2 - c - half,
        -scene.width / 2 + c + half,
        scene.width / 2 - c - reach_left,
        -scene.width / 2 + c - reach_right,
    )
    if index < len(walls):
        return float(walls[index])
    k, way = (index - len(walls)) // SIDES_PER_BOX, (index - len(walls)) % SIDES_PER_BOX
    right, left, top = scene.low[k, 1], scene.high[k, 1], scene.high[k, 2]
    beside, upon = top > z + EPS, abs(top - z) <= rules.level
    if way <= 3 and beside:  # noqa: PLR2004 - the four ways to stand beside it
        sides = (right - c - half, left + c + half, right - c - reach_left, left + c - reach_right)
        return float(sides[way])
    if way > 3 and upon:  # noqa: PLR2004 - the three to stand upon it
        flush = (right + half, left - half, (right + left) / 2)
        return float(flush[way - 4])
    return SKIP


@loop_kernel
def depth_at(scene: Scene, load: Load, z: float, near: float, index: int) -> float:
    """The x of the outward face for one way to stand: all the way in, flush, or less deep [m]."""
    if index <= STEPS:
        return near - index * STEP
    k, way = (index - STEPS - 1) // 2, (index - STEPS - 1) % 2
    if abs(scene.high[k, 2] - z) > EPS:
        return NOWHERE
    return float(scene.low[k, 0] if way == 0 else scene.high[k, 0] - load.depth)


@loop_kernel
def shared(scene: Scene, low: tuple[float, ...], high: tuple[float, ...]) -> float:
    """How much of a region boxes take [m^3]."""
    volume = 0.0
    for k in range(len(scene.low)):
        part = 1.0
        for axis in range(3):
            over = min(scene.high[k, axis], high[axis]) - max(scene.low[k, axis], low[axis])
            part *= max(over, 0.0)
        volume += part
    return volume


@loop_kernel
def gap_beside(scene: Scene, load: Load, x: float, y: float, z: float, sign: float) -> float:
    """How far the next wall or box is to one side [m]."""
    edge = sign * y + load.width / 2
    gap = scene.width / 2 - edge
    for k in range(len(scene.low)):
        if (
            scene.low[k, 0] < x + load.depth - EPS
            and scene.high[k, 0] > x + EPS
            and scene.low[k, 2] < z + load.height - EPS
            and scene.high[k, 2] > z + EPS
        ):
            start = scene.low[k, 1] if sign > 0 else -scene.high[k, 1]
            if start >= edge - EPS:
                gap = min(gap, start - edge)
    return gap


@loop_kernel
def useless(gap: float, none: float, every: float) -> float:
    """The share of boxes that do not fit into a gap: all below `none`, none above `every`."""
    return min(max((every - gap) / (every - none), 0.0), 1.0)


@loop_kernel
def cost(scene: Scene, load: Load, weights: Weights, x: float, y: float, z: float) -> float:
    """How much a spot spoils: room lost behind, below, beside and above it, and height."""
    d, w, h = load.depth, load.width, load.height
    right, left, far, top = y - w / 2, y + w / 2, x + d, z + h
    behind = (scene.depth - far) * w * h
    behind -= shared(scene, (far, right, z), (scene.depth, left, top))
    below = d * w * z - shared(scene, (x, right, 0.0), (far, left, z))
    beside = 0.0
    for sign in (-1.0, 1.0):
        gap = gap_beside(scene, load, x, y, z, sign)
        beside += gap * d * h * useless(gap, weights.narrow, weights.wide)
    room = scene.height - top
    over = room * d * w * useless(room, weights.flat, weights.tall)
    front = x * w * h * useless(x, weights.narrow, weights.wide)
    volume = scene.depth * scene.width * scene.height
    lost = (behind + below + beside + over + weights.front * front) / volume
    return weights.lost * lost + weights.shallow * (scene.depth - far) + weights.high * z


@loop_kernel
def is_repeated(scene: Scene, level: int) -> bool:
    """Whether the floor or the top of a box before this one is as high."""
    z = scene.high[level, 2]
    if z <= EPS:
        return True
    for other in range(level):  # noqa: SIM110 - a kernel has no generators
        if abs(scene.high[other, 2] - z) <= EPS:
            return True
    return False


@loop_kernel
def list_spots(scene: Scene, load: Load, rules: Rules, weights: Weights, out: Array) -> int:
    """Lists every candidate that is possible.

    Args:
        scene: the place.
        load: the box.
        rules: the margins.
        weights: what is good.
        out: (CAPACITY, 4) receives x of the outward face, y of the middle, z of the bottom [m]
            and the cost of each.

    Returns:
        How many there are.
    """
    n, found = len(scene.low), 0
    for level in range(-1, n):
        if level >= 0 and is_repeated(scene, level):
            continue
        z = 0.0 if level < 0 else scene.high[level, 2]
        for side in range(4 + SIDES_PER_BOX * n):
            y = side_at(scene, load, rules, z, side)
            if y == SKIP:
                continue
            near = deepest(scene, load, rules, y, z)
            if near == NOWHERE:
                continue
            for way in range(1 + STEPS + (2 * n if level >= 0 else 0)):
                x = depth_at(scene, load, z, near, way)
                if x < -EPS or x > near + EPS or not lands(scene, load, rules, x, y, z):
                    continue
                if not bears(scene, load, rules, x, y, z):
                    continue
                if found == len(out):
                    return found
                out[found, 0], out[found, 1], out[found, 2] = max(x, 0.0), y, z
                out[found, 3] = cost(scene, load, weights, x, y, z)
                found += 1
    return found
