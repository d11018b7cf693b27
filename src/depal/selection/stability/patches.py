"""Where upright boxes touch: corners of contact patches, each with the way in which it pushes.

A box rests on whatever its footprint overlaps at the height of its bottom; the corners of the
overlap polygon are where the force acts, for a force anywhere in the patch is a sum of forces in
its corners. Boxes that stand face to face push each other apart along the face. Poses come from
a camera: what is nearly level, or nearly face to face, touches, and patches may be made smaller
by what the poses are in doubt.
"""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.errors import SettingError
from depal.geometry import footprint_overlap, loop_kernel

Array = npt.NDArray[np.float64]
Indices = npt.NDArray[np.int32]

GROUND = -1
"""The row of what never moves: the deck, and what is assumed below a box that seems to hang."""

ON_TOP, BESIDE = 0, 1
"""Which way a contact pushes: up, or along the faces' normal."""

FIRST, SECOND, WAY = range(3)
PX, PY, PZ, NX, NY = range(5)
X, Y, Z, HALF_LENGTH, HALF_WIDTH, HALF_HEIGHT, COS, SIN = range(8)

_CORNERS = 8
"""Two convex quadrangles share at the most so many corners."""

_SAME = 1e-9
"""Corners closer together are one [m]."""

_ROOM = 24
"""So many corners a box are made room for at first; a pile without gaps has some 15."""


@dataclass(frozen=True, slots=True)
class TouchRule:
    """When two boxes touch, and how much of the contact counts.

    Attributes:
        rise: a box rests on what its bottom is within this of the top of [m].
        gap: boxes stand face to face when their faces are within this of each other [m].
        narrow: contacts no wider than this do not count [m].
        inset: every footprint is smaller by this on each side when it carries or is carried [m].
    """

    rise: float
    gap: float
    narrow: float
    inset: float = 0.0

    def __post_init__(self) -> None:
        """Refuses what is no length."""
        values = (self.rise, self.gap, self.narrow, self.inset)
        for name, value in zip(("rise", "gap", "narrow", "inset"), values, strict=True):
            if not (math.isfinite(value) and value >= 0):
                raise SettingError(f"contact {name}", f"{value!r} m", "a length of 0 m or more")


KNOWN = TouchRule(rise=1e-6, gap=1e-6, narrow=1e-6)
"""For poses that are known: random pallets."""

SEEN = TouchRule(rise=0.02, gap=0.01, narrow=0.01, inset=0.005)
"""For poses from a camera, some millimetres off."""


@dataclass(frozen=True, slots=True, eq=False)
class Touches:
    """Corners of contact patches.

    Attributes:
        bodies: (m, 3) the row that is pushed along the normal, the row that is pushed back
            (GROUND for what never moves), and ON_TOP or BESIDE.
        points: (m, 5) x, y, z of the corner [m], x and y of the normal (0, 0 for ON_TOP, whose
            normal points up).
    """

    bodies: Indices
    points: Array


def touches_of(prisms: Array, rule: TouchRule, deck: float, carried: Indices) -> Touches:
    """Every contact of a pile.

    Args:
        prisms: (n, 8) the boxes.
        rule: when boxes touch.
        deck: the height on which the pile stands [m]; it carries all of a box's bottom.
        carried: (k,) rows that something unseen carries, as the deck would.

    Returns:
        The corners, box by box.
    """
    room = _ROOM * (len(prisms) + 2)
    grounded = np.zeros(len(prisms), np.bool_)
    grounded[carried] = True
    while True:
        bodies, points = np.empty((room, 3), np.int32), np.empty((room, 5))
        polygons = np.empty((2, _CORNERS, 2))
        lengths = np.array([rule.rise, rule.gap, rule.narrow, rule.inset])
        found = _find(prisms, lengths, deck, grounded, polygons, bodies, points)
        if found >= 0:
            return Touches(bodies[:found].copy(), points[:found].copy())
        room *= 4


@loop_kernel
def _find(
    prisms: Array,
    lengths: Array,
    deck: float,
    grounded: npt.NDArray[np.bool_],
    polygons: Array,
    bodies: Indices,
    points: Array,
) -> int:
    """Fills the corners in; how many there are, or -1 where there is no room for them."""
    rise, gap, narrow, inset = lengths
    found = 0
    for a in range(len(prisms)):
        if found + _CORNERS * (len(prisms) + 1) > len(bodies):
            return -1
        bottom = prisms[a, Z] - prisms[a, HALF_HEIGHT]
        if grounded[a] or abs(bottom - deck) <= rise:
            corners = _footprint(prisms, a, inset, polygons)
            found = _stand(a, GROUND, bottom, corners, polygons[0], bodies, points, found)
        for b in range(len(prisms)):
            if b == a:
                continue
            depth = footprint_overlap(prisms, a, b)
            top = prisms[b, Z] + prisms[b, HALF_HEIGHT]
            if depth > narrow and abs(bottom - top) <= rise:
                corners = _clipped(prisms, a, b, inset, polygons)
                found = _stand(a, b, bottom, corners, polygons[0], bodies, points, found)
            elif a < b and abs(depth) <= max(gap, narrow):
                low = max(bottom, prisms[b, Z] - prisms[b, HALF_HEIGHT])
                high = min(prisms[a, Z] + prisms[a, HALF_HEIGHT], top)
                if high - low > max(narrow, rise):
                    found = _lean(prisms, (a, b), (low, high), gap, narrow, bodies, points, found)
    return found


@loop_kernel
def _footprint(prisms: Array, a: int, inset: float, polygons: Array) -> int:
    """The corners of a box's own footprint, smaller by the inset, into polygons[0]."""
    length, width = prisms[a, HALF_LENGTH] - inset, prisms[a, HALF_WIDTH] - inset
    if length <= 0 or width <= 0:
        return 0
    c, s = prisms[a, COS], prisms[a, SIN]
    for corner in range(4):
        u = length if corner in (0, 3) else -length
        v = width if corner < 2 else -width  # noqa: PLR2004 - the first two of four
        polygons[0, corner, 0] = prisms[a, X] + c * u - s * v
        polygons[0, corner, 1] = prisms[a, Y] + s * u + c * v
    return 4


@loop_kernel
def _clipped(prisms: Array, a: int, b: int, inset: float, polygons: Array) -> int:
    """The corners of the common footprint of two boxes, into polygons[0]."""
    count = _footprint(prisms, a, inset, polygons)
    reach = (prisms[b, HALF_LENGTH] - inset, prisms[b, HALF_WIDTH] - inset)
    c, s = prisms[b, COS], prisms[b, SIN]
    for side in range(4):
        # Keeps what lies within the side whose outward normal is (nx, ny).
        sign = 1.0 if side < 2 else -1.0  # noqa: PLR2004 - two sides each way
        nx, ny = (sign * c, sign * s) if side % 2 == 0 else (-sign * s, sign * c)
        limit = nx * prisms[b, X] + ny * prisms[b, Y] + reach[side % 2]
        count = _cut(polygons, count, nx, ny, limit)
    return count


@loop_kernel
def _cut(polygons: Array, count: int, nx: float, ny: float, limit: float) -> int:
    """Keeps of the polygon in polygons[0] what has nx x + ny y <= limit; polygons[1] is scratch."""
    kept = 0
    for corner in range(count):
        x, y = polygons[0, corner, 0], polygons[0, corner, 1]
        after = (corner + 1) % count
        far_x, far_y = polygons[0, after, 0], polygons[0, after, 1]
        here, there = nx * x + ny * y - limit, nx * far_x + ny * far_y - limit
        if here <= _SAME:
            polygons[1, kept, 0], polygons[1, kept, 1] = x, y
            kept += 1
        if (here < -_SAME and there > _SAME) or (here > _SAME and there < -_SAME):
            share = here / (here - there)
            polygons[1, kept, 0] = x + share * (far_x - x)
            polygons[1, kept, 1] = y + share * (far_y - y)
            kept += 1
    for corner in range(kept):
        polygons[0, corner, 0], polygons[0, corner, 1] = (
            polygons[1, corner, 0],
            polygons[1, corner, 1],
        )
    return kept


@loop_kernel
def _stand(
    a: int,
    b: int,
    level: float,
    corners: int,
    polygon: Array,
    bodies: Indices,
    points: Array,
    found: int,
) -> int:
    """Adds the corners on which one box stands on another or on the ground."""
    for corner in range(corners):
        bodies[found, FIRST], bodies[found, SECOND], bodies[found, WAY] = a, b, ON_TOP
        points[found, PX], points[found, PY] = polygon[corner, 0], polygon[corner, 1]
        points[found, PZ], points[found, NX], points[found, NY] = level, 0.0, 0.0
        found += 1
    return found


@loop_kernel
def _lean(
    prisms: Array,
    pair: tuple[int, int],
    heights: tuple[float, float],
    gap: float,
    narrow: float,
    bodies: Indices,
    points: Array,
    found: int,
) -> int:
    """Adds the corners in which two boxes stand face to face, or corner to face."""
    a, b = pair
    owner, other, nx, ny = _facing(prisms, a, b)
    c, s = prisms[owner, COS], prisms[owner, SIN]
    along = abs(nx * c + ny * s) > 0.5  # noqa: PLR2004 - the normal is the owner's length or width
    reach = prisms[owner, HALF_LENGTH] if along else prisms[owner, HALF_WIDTH]
    extent = prisms[owner, HALF_WIDTH] if along else prisms[owner, HALF_LENGTH]
    low, high, corners = math.inf, -math.inf, 0
    for corner in range(4):
        u = prisms[other, HALF_LENGTH] * (1.0 if corner in (0, 3) else -1.0)
        v = prisms[other, HALF_WIDTH] * (1.0 if corner < 2 else -1.0)  # noqa: PLR2004
        dx = prisms[other, X] - prisms[owner, X] + prisms[other, COS] * u - prisms[other, SIN] * v
        dy = prisms[other, Y] - prisms[owner, Y] + prisms[other, SIN] * u + prisms[other, COS] * v
        if nx * dx + ny * dy - reach <= max(gap, narrow):
            tangent = nx * dy - ny * dx
            low, high = min(low, tangent), max(high, tangent)
            corners += 1
    low, high = max(low, -extent), min(high, extent)
    if high < low or (corners > 1 and high - low <= narrow):
        return found
    # The normal points from the owner to the other; it pushes the first of the pair away.
    sign = 1.0 if owner == b else -1.0
    for end in range(1 if corners == 1 else 2):
        tangent = high if end else low
        for level in heights:
            bodies[found, FIRST], bodies[found, SECOND], bodies[found, WAY] = a, b, BESIDE
            points[found, PX] = prisms[owner, X] + reach * nx - tangent * ny
            points[found, PY] = prisms[owner, Y] + reach * ny + tangent * nx
            points[found, PZ], points[found, NX], points[found, NY] = level, sign * nx, sign * ny
            found += 1
    return found


@loop_kernel
def _facing(prisms: Array, a: int, b: int) -> tuple[int, int, float, float]:
    """The face that two boxes share best: whose it is, the other box, and its outward normal."""
    best = (a, b, 1.0, 0.0)
    least = math.inf
    for turn in range(2):
        owner, other = (a, b) if turn == 0 else (b, a)
        c, s = prisms[owner, COS], prisms[owner, SIN]
        dx, dy = prisms[other, X] - prisms[owner, X], prisms[other, Y] - prisms[owner, Y]
        across_c = abs(c * prisms[other, COS] + s * prisms[other, SIN])
        across_s = abs(c * prisms[other, SIN] - s * prisms[other, COS])
        length, width = prisms[other, HALF_LENGTH], prisms[other, HALF_WIDTH]
        for axis in range(2):
            nx, ny = (c, s) if axis == 0 else (-s, c)
            far = nx * dx + ny * dy
            own = prisms[owner, HALF_LENGTH] if axis == 0 else prisms[owner, HALF_WIDTH]
            reach = (
                across_c * length + across_s * width
                if axis == 0
                else across_s * length + across_c * width
            )
            depth = own + reach - abs(far)
            if depth < least - _SAME:
                least = depth
                sign = 1.0 if far >= 0 else -1.0
                best = (owner, other, sign * nx, sign * ny)
    return best
