"""The loads that a grasp carries, as a cone of planes.

The pull and the peel limits of `domain.cup_group` are planes already; the round friction cone is
replaced by a polyhedron inside it, so a load within the planes always holds.
"""

import itertools
import math

import numpy as np

from depal.motion.grasping.holding import Floats, G, Holding

RESERVE = 0.02
"""At rest this share of what is counted on stays free, or nothing could ever move."""


def cone_rows(holding: Holding) -> Floats:
    """Rows on (force, moment) that are at most 1 only where the box holds, (k, 6)."""
    counted = holding.pull / holding.safety
    group = holding.group
    corners = _outermost(group.tension_from_moment)
    peel = np.zeros((len(corners), 6))
    peel[:, 0] = 1.0 / counted
    peel[:, 4:] = corners / counted
    directions, inside = round_directions()
    shear = np.zeros((len(directions), 6))
    shear[:, 0] = 1.0 / counted
    shear[:, 1:4] = directions / (group.friction * inside * counted)
    shear[:, 3] /= group.arm
    return np.concatenate((peel, shear))


def round_directions() -> tuple[Floats, float]:
    """Directions on a sphere, (42, 3), and the share of it that their planes keep.

    The corners of an icosahedron and the middles of its edges. The polyhedron whose planes touch a
    ball in these directions lies in a ball that is larger by one over the share.
    """
    golden = (1 + math.sqrt(5)) / 2
    signs = (-1.0, 1.0)
    corners = np.array(
        [
            np.roll((0.0, a, b * golden), turn)
            for turn, a, b in itertools.product(range(3), signs, signs)
        ]
    )
    pairs = list(itertools.combinations(corners, 2))
    edges = [a + b for a, b in pairs if math.isclose(math.dist(a, b), 2.0, rel_tol=1e-6)]
    directions = np.concatenate((corners, np.array(edges)))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    # What is furthest from all directions is the middle of a face of the icosahedron.
    (a, b), third = next(
        (pair, c)
        for pair in pairs
        for c in corners
        if all(
            math.isclose(math.dist(p, q), 2.0, rel_tol=1e-6)
            for p, q in itertools.combinations((*pair, c), 2)
        )
    )
    middle = a + b + third
    return directions, float((directions @ middle).max() / np.linalg.norm(middle))


def _outermost(points: Floats) -> Floats:
    """The corners of the convex hull of points in the plane, (k, 2)."""
    order = np.lexsort((points[:, 1], points[:, 0]))
    hull: list[Floats] = []
    for ordered in (order, order[::-1]):
        half: list[Floats] = []
        for row in ordered:
            while len(half) > 1 and _turn(half[-2], half[-1], points[row]) <= 0.0:
                half.pop()
            half.append(points[row])
        hull += half[:-1]
    return np.array(hull)


def _turn(a: Floats, b: Floats, c: Floats) -> float:
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def greatest_lean(holding: Holding, up: Floats) -> float:
    """How far a held box may lean in any direction and still be held at rest [rad].

    Args:
        holding: the box.
        up: (3,) the direction in the flange's frame that points up when it does not lean.

    Returns:
        At most pi; negative where it does not hold upright either.
    """
    face = holding.flange_from_face
    lever = face.T @ (holding.centre - holding.middle)
    force = -holding.mass * G * face.T  # on the cups, over the direction that is up
    load = np.concatenate((force, np.cross(lever[:, None], force, axis=0)))
    rows = cone_rows(holding) @ load
    # Leaning by t in the worst direction a row is a cos t + b sin t = r cos(t - d).
    a = rows @ up
    b = np.sqrt(np.maximum((rows**2).sum(axis=1) - a**2, 0.0))
    r, d = np.hypot(a, b), np.arctan2(b, a)
    allowed = 1.0 - RESERVE
    beyond = np.arccos(np.minimum(allowed / np.maximum(r, 1e-12), 1.0))
    leans = np.where(r <= allowed, math.pi, np.where(a > allowed, -1.0, d - beyond))
    return float(leans.min())
