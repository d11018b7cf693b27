"""Whether a pile stays where it is when a box comes on top of it.

Weights go down from box to box, to each that carries by its share of the area that it carries,
in the middle of that area. A box tips where the centre of all that presses on it, and of its own
weight, is not between the areas that carry it.
"""

import math

from depal.geometry import loop_kernel
from depal.logistics.placing.scene import DENSITY, EPS, Load, Rules, Scene

DIRECTIONS = 16
"""In so many directions something must carry beyond the centre of pressure."""

BEYOND = 0.01
"""How far beyond, at the least [m]."""


@loop_kernel
def press(
    scene: Scene, rules: Rules, low: tuple[float, ...], high: tuple[float, ...], weight: float
) -> None:
    """Lets a weight press on the boxes below a region, evenly over what carries.

    Args:
        scene: the place; its `pressing` is changed.
        rules: the margins.
        low: the smallest x, y, z of the region [m].
        high: the greatest x, y of it [m].
        weight: [kg].
    """
    area = 0.0
    for sharing in (False, True):
        for k in range(len(scene.low)):
            left, right = max(low[0], scene.low[k, 0]), min(high[0], scene.high[k, 0])
            front, back = max(low[1], scene.low[k, 1]), min(high[1], scene.high[k, 1])
            if left >= right or front >= back or not carries(scene, rules, k, low[2]):
                continue
            part = (right - left) * (back - front)
            if sharing:
                share = weight * part / area
                scene.pressing[k, 0] += share
                scene.pressing[k, 1] += share * (left + right) / 2
                scene.pressing[k, 2] += share * (front + back) / 2
            else:
                area += part


@loop_kernel
def carries(scene: Scene, rules: Rules, k: int, z: float) -> bool:
    """Whether a box's top is what carries at a height [m]."""
    gap = z - scene.high[k, 2]
    return bool(gap >= -EPS and gap <= rules.level + EPS)


@loop_kernel
def is_balanced(scene: Scene, rules: Rules, i: int, x: float, y: float) -> bool:
    """Whether a point is between the areas that carry a box.

    Args:
        scene: the place.
        rules: the margins.
        i: the box.
        x: of the centre of pressure [m].
        y: of it [m].
    """
    for direction in range(DIRECTIONS):
        angle = 2 * math.pi * direction / DIRECTIONS
        c, s = math.cos(angle), math.sin(angle)
        beyond = -1.0
        for k in range(len(scene.low)):
            left = max(scene.low[i, 0], scene.low[k, 0])
            right = min(scene.high[i, 0], scene.high[k, 0])
            front = max(scene.low[i, 1], scene.low[k, 1])
            back = min(scene.high[i, 1], scene.high[k, 1])
            if left < right and front < back and carries(scene, rules, k, scene.low[i, 2]):
                furthest = max(c * (left - x), c * (right - x))
                furthest += max(s * (front - y), s * (back - y))
                beyond = max(beyond, furthest)
        if beyond < BEYOND:
            return False
    return True


@loop_kernel
def bears(scene: Scene, load: Load, rules: Rules, x: float, y: float, z: float) -> bool:
    """Whether every box below stays balanced when the box comes to a spot.

    Args:
        scene: the place.
        load: the box.
        rules: the margins.
        x: of the outward face [m].
        y: of the middle [m].
        z: of the bottom [m].
    """
    if z <= EPS:
        return True
    weight = load.mass
    if math.isnan(weight):
        weight = DENSITY * load.depth * load.width * load.height
    scene.pressing[:] = 0.0
    low = (x, y - load.width / 2, z)
    press(scene, rules, low, (x + load.depth, y + load.width / 2), weight)
    for place in range(len(scene.order)):
        i = scene.order[place]
        if scene.low[i, 2] <= EPS:
            continue
        own, above = scene.weight[i], scene.pressing[i, 0]
        total = own + above
        centre_x = own * (scene.low[i, 0] + scene.high[i, 0]) / 2 + scene.pressing[i, 1]
        centre_y = own * (scene.low[i, 1] + scene.high[i, 1]) / 2 + scene.pressing[i, 2]
        if above > 0 and not is_balanced(scene, rules, i, centre_x / total, centre_y / total):
            return False
        bottom = (scene.low[i, 0], scene.low[i, 1], scene.low[i, 2])
        press(scene, rules, bottom, (scene.high[i, 0], scene.high[i, 1]), total)
    return True
