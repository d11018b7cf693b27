"""Whether a box can be pushed to a spot and stands there: the kernels."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from depal.domain import Place
from depal.geometry import loop_kernel
from depal.logistics.placing.values import Held, Margins, Standing

Array = npt.NDArray[np.float64]

EPS = 1e-6
"""Closer than this is equal [m]."""

NOWHERE = -1.0
"""A depth for what cannot be pushed in at all."""


class Scene(NamedTuple):
    """A compartment and its boxes as arrays.

    Attributes:
        low: (n, 3) smallest coordinates of each box [m].
        high: (n, 3) greatest ones [m].
        mass: (n,) [kg]; not a number where unknown.
        depth: of the compartment [m].
        width: of its opening [m].
        height: its clear height [m].
        reach: how deep behind the opening an outward face may be [m].
    """

    low: Array
    high: Array
    mass: Array
    depth: float
    width: float
    height: float
    reach: float


class Load(NamedTuple):
    """The held box as arrays.

    Attributes:
        depth: of the box along the way in [m].
        width: [m].
        height: [m].
        mass: [kg]; not a number where unknown.
        tool: (m, 5) reach, right, left, low, high of what comes in with it [m].
    """

    depth: float
    width: float
    height: float
    mass: float
    tool: Array


class Rules(NamedTuple):
    """`Margins` for the kernels."""

    clearance: float
    lift: float
    skim: float
    above: float
    level: float
    support: float
    heavier: float


def scene_of(place: Place, boxes: tuple[Standing, ...], max_depth: float) -> Scene:
    """A compartment and what stands in it, for the kernels."""
    low = np.array([box.corner for box in boxes], dtype=np.float64).reshape(-1, 3)
    size = np.array([box.size for box in boxes], dtype=np.float64).reshape(-1, 3)
    mass = np.array([math.nan if box.mass is None else box.mass for box in boxes], dtype=np.float64)
    width, height = place.opening
    return Scene(low, low + size, mass, place.depth, width, height, max_depth)


def load_of(held: Held) -> Load:
    """A held box, for the kernels."""
    rows = [(part.reach, part.right, part.left, part.low, part.high) for part in held.tool]
    tool = np.array(rows, dtype=np.float64).reshape(-1, 5)
    return Load(*held.size, math.nan if held.mass is None else held.mass, tool)


def rules_of(margins: Margins) -> Rules:
    """Margins, for the kernels."""
    return Rules(
        clearance=margins.clearance,
        lift=margins.lift,
        skim=margins.skim,
        above=margins.above,
        level=margins.level,
        support=margins.support,
        heavier=margins.heavier,
    )


@loop_kernel
def first_in_the_way(scene: Scene, right: float, left: float, low: float, high: float) -> float:
    """How far straight in something of that cross-section gets before a box [m]."""
    limit = scene.depth
    for k in range(len(scene.low)):
        if (
            scene.low[k, 0] < limit
            and scene.low[k, 1] < left - EPS
            and scene.high[k, 1] > right + EPS
            and scene.low[k, 2] < high - EPS
            and scene.high[k, 2] > low + EPS
        ):
            limit = scene.low[k, 0]
    return limit


@loop_kernel
def deepest(scene: Scene, load: Load, rules: Rules, y: float, z: float) -> float:
    """How deep the box's outward face gets when it is pushed straight in, raised by the lift.

    Args:
        scene: the place.
        load: the box, with the tool.
        rules: the margins.
        y: of the box's middle [m].
        z: of its bottom once it stands [m].

    Returns:
        The greatest x of the outward face [m]; `NOWHERE` where it does not get in.
    """
    side = load.width / 2 + rules.clearance
    bottom = z + rules.lift - rules.skim
    top = z + rules.lift + load.height + rules.above
    if top > scene.height + EPS or abs(y) + side > scene.width / 2 + EPS:
        return NOWHERE
    near = first_in_the_way(scene, y - side, y + side, bottom, top) - rules.clearance - load.depth
    near = min(near, scene.reach)
    for t in range(len(load.tool)):
        right = y + load.tool[t, 1] - rules.clearance
        left = y + load.tool[t, 2] + rules.clearance
        low = z + load.tool[t, 3] - rules.above
        high = z + load.tool[t, 4] + rules.lift + rules.above
        limit = 0.0
        if (
            max(left, -right) <= scene.width / 2 + EPS
            and low >= -EPS
            and high <= scene.height + EPS
        ):
            limit = first_in_the_way(scene, right, left, low, high) - rules.clearance
        near = min(near, limit - load.tool[t, 0])
    return near if near >= -EPS else NOWHERE


@loop_kernel
def lands(scene: Scene, load: Load, rules: Rules, x: float, y: float, z: float) -> bool:
    """Whether nothing keeps the raised box from going down to its spot, and it is carried.

    Args:
        scene: the place.
        load: the box.
        rules: the margins.
        x: of the outward face [m].
        y: of the middle [m].
        z: of the bottom [m].
    """
    c, half = rules.clearance, load.width / 2
    carried = 0.0
    for k in range(len(scene.low)):
        over_x = min(scene.high[k, 0], x + load.depth) - max(scene.low[k, 0], x)
        over_y = min(scene.high[k, 1], y + half) - max(scene.low[k, 1], y - half)
        if over_x <= EPS - c or over_y <= EPS - c:
            continue
        gap = z - scene.high[k, 2]
        if gap < -EPS:
            if scene.low[k, 2] < z + rules.lift + load.height + rules.above - EPS:
                return False
        elif gap <= rules.level + EPS and over_x > 0 and over_y > 0:
            if load.mass > rules.heavier * scene.mass[k]:
                return False
            carried += over_x * over_y
    base = load.depth * load.width
    return z <= EPS or carried >= rules.support * base - EPS * EPS


@loop_kernel
def stands(scene: Scene, load: Load, rules: Rules, x: float, y: float, z: float) -> bool:
    """Whether the box can be pushed in to there and stands; see `lands` for the arguments."""
    return (
        x >= -EPS
        and x <= deepest(scene, load, rules, y, z) + EPS
        and lands(scene, load, rules, x, y, z)
    )
