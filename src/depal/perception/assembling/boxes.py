"""Boxes put together from the faces that were found."""

import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from depal.domain import Gtin, Product
from depal.geometry import OrientedBox, Pose
from depal.perception.assembling.edges import Lying
from depal.perception.assembling.pairing import paired
from depal.perception.assembling.sizing import Seen, Sized, sized
from depal.perception.faces import Face, Facing, SeenBox
from depal.perception.rasters.region import Region

SIDEWAYS, DEPTH, TURN = 0.003, 0.004, math.radians(0.7)
"""Standard deviations of a face's middle in its plane and square to it [m], and of its yaw."""

NAMED = 0.6
"""With a print the place in the plane is known to this share of that."""

GUESSED = 0.04
"""Standard deviation of an edge that nobody has seen [m]."""

CARRIES = 0.05
"""A box stands on something that it overlaps by at least so much along x and y [m]."""


def boxes_of(
    faces: Sequence[Face], region: Region, products: Sequence[Product]
) -> tuple[SeenBox, ...]:
    """One box for each front, each top, and each two that belong together.

    Args:
        faces: found in one look, none overlapping another of its kind.
        region: where they were looked for.
        products: what may be there, the likeliest first; none where nobody knows.
    """
    region_from_cell = region.cell_from_region.inverse
    lying = [Lying.of(face, region_from_cell) for face in faces]
    fronts = [each for each in lying if each.face.facing is Facing.FRONT]
    tops = [each for each in lying if each.face.facing is Facing.TOP]
    pairs = paired(fronts, tops)
    rest = set(range(len(fronts))) - {front for front, _ in pairs}
    left = set(range(len(tops))) - {top for _, top in pairs}
    found = [_box(fronts[i], tops[j], region, products, lying) for i, j in pairs]
    found += [_box(fronts[i], None, region, products, lying) for i in sorted(rest)]
    found += [_box(None, tops[j], region, products, lying) for j in sorted(left)]
    return tuple(found)


def _box(
    front: Lying | None,
    top: Lying | None,
    region: Region,
    products: Sequence[Product],
    all_: Sequence[Lying],
) -> SeenBox:
    parts = [each for each in (front, top) if each is not None]
    gtin, name = _named(parts), _supposed(parts)
    main = front or top
    if main is None:
        raise ValueError("a box has at least one face")
    width = float(np.mean([each.width for each in parts]))
    seen = Seen(top.other if top else None, width, front.other if front else None)
    standing = () if front else _standing(parts[0], all_, region.ground)
    size = sized(seen, products, gtin or name, standing)
    pose = _pose(front, top, size)
    score = 1.0 - float(np.prod([1.0 - each.face.score for each in parts]))
    return SeenBox(
        OrientedBox(region.cell_from_region @ pose, (size.depth, size.width, size.height)),
        score,
        _covariance(region.cell_from_region, front, top, size),
        tuple(each.face for each in parts),
        gtin,
        size.certain,
    )


def _named(parts: Sequence[Lying]) -> Gtin | None:
    """The product that a print says for certain, where no other contradicts."""
    names = {each.face.name.gtin for each in parts if each.face.name and each.face.name.certain}
    return next(iter(names)) if len(names) == 1 else None


def _supposed(parts: Sequence[Lying]) -> Gtin | None:
    """The product that the best print says, certain or not."""
    names = [each.face.name for each in parts if each.face.name is not None]
    return max(names, key=lambda name: name.score).gtin if names else None


def _standing(top: Lying, others: Sequence[Lying], ground: float) -> tuple[float, ...]:
    """The heights that a box under this top may have."""
    heights = [top.z - ground]
    for other in others:
        if other.face.facing is Facing.TOP and other.z < top.z - CARRIES:
            heights.append(top.z - other.z)
        if other.face.facing is Facing.FRONT:
            heights.append(top.z - other.front_edge[2])
    return tuple(each for each in heights if each > CARRIES)


def _pose(front: Lying | None, top: Lying | None, size: Sized) -> Pose:
    """`region_from_box`: the middle, from the edges that were seen."""
    if top is not None:
        yaw = top.yaw
    elif front is not None:
        yaw = front.yaw
    else:
        raise ValueError("a box has at least one face")
    c, s = math.cos(yaw), math.sin(yaw)
    half = size.depth / 2
    if front is not None and top is not None:
        y = (front.y + half * s + top.y) / 2
        x = (front.x + half * c + top.x) / 2
        z = top.z - size.height / 2
        z = (front.z + z) / 2
    elif front is not None:
        x, y, z = front.x + half * c, front.y + half * s, front.z
    elif top is not None:
        x, y, z = top.x, top.y, top.z - size.height / 2
    return Pose.from_yaw((x, y, z), yaw)


def _covariance(
    cell_from_region: Pose, front: Lying | None, top: Lying | None, size: Sized
) -> npt.NDArray[np.float64]:
    """(6, 6) in the cell frame."""
    named = any(each is not None and each.face.name is not None for each in (front, top))
    side = SIDEWAYS * (NAMED if named else 1.0)
    guess = 0.0 if size.certain else GUESSED
    x = math.hypot(DEPTH if front else side, 0.0 if top else guess / 2)
    z = math.hypot(side if front else DEPTH, 0.0 if front else guess / 2)
    turn = TURN if top else 2 * TURN
    turned = np.array(cell_from_region.rotation)
    out = np.zeros((6, 6))
    out[:3, :3] = turned @ np.diag([x**2, side**2, z**2]) @ turned.T
    out[3:, 3:] = turned @ np.diag([(TURN / 3) ** 2, (TURN / 3) ** 2, turn**2]) @ turned.T
    return out
