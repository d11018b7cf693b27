"""Whether a box can be pushed to a spot and stands there: the kernels."""

from depal.geometry import loop_kernel
from depal.logistics.placing.bearing import bears
from depal.logistics.placing.scene import EPS, Load, Rules, Scene

NOWHERE = -1.0
"""A depth for what cannot be pushed in at all."""


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
        and bears(scene, load, rules, x, y, z)
    )
