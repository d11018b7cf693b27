"""What a face that was found tells of the other face of its box.

A front and a top share an edge, and the note knows the third: so each says where the other is to
be looked for, and a rectangle there is likelier than one that nothing speaks for.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import permutations

import numpy as np
import numpy.typing as npt

from depal.geometry import Pose, Vector3
from depal.perception.detecting.expected import Expected
from depal.perception.detecting.kernels import agreeing
from depal.perception.faces import Face, Facing, Raster, Rectangle
from depal.perception.proposals.candidates import Candidates

Floats = npt.NDArray[np.float64]

FITS = 0.014
"""Edges of a found face are those of an expected one within this [m]."""

NEAR = 0.020
"""What is implied belongs to a candidate whose sides are all within this of its own [m]."""

DEEP = 0.02
"""And whose depth differs by less [m]."""

SPEAKS = 3.0
"""A face that is surely there speaks so much for the other one of its box [logarithm of odds]."""


@dataclass(frozen=True, slots=True)
class Implied:
    """A face that should be there.

    Attributes:
        rectangle: where, in the plane of the raster that would show it.
        chance: that the face is there which says so.
    """

    rectangle: Rectangle
    chance: float


def implied_by(
    faces: Sequence[Face], raster: Raster, expected: Expected, region_from_cell: Pose
) -> tuple[Implied, ...]:
    """What faces of one kind tell of those of the other.

    Args:
        faces: fronts, or tops.
        raster: that shows the others.
        expected: what the boxes may measure; of other sizes nothing is known.
        region_from_cell: the frame in which boxes stand with their front towards -x.
    """
    out = []
    for face in faces:
        for size in boxes_with(face, expected):
            pose = _other(region_from_cell @ face.cell_from_face, face, size)
            here = raster.cell_from_raster.inverse @ region_from_cell.inverse @ pose
            depth, width, height = size
            edges = (width, depth) if face.facing is Facing.FRONT else (width, height)
            u, v, away = here.translation
            turn = math.atan2(here.rotation[1][0], here.rotation[0][0])
            out.append(Implied(Rectangle(u, v, *edges, turn, away), face.score))
    return tuple(out)


def boxes_with(face: Face, expected: Expected) -> tuple[Vector3, ...]:
    """Depth, width and height of the expected boxes that have such a face [m], each once."""
    found = set[Vector3]()
    for size in expected.sizes:
        ways = permutations(size) if not expected.standing else (size, (size[1], size[0], size[2]))
        for depth, width, height in ways:
            other = height if face.facing is Facing.FRONT else depth
            if max(abs(face.size[0] - width), abs(face.size[1] - other)) < FITS:
                found.add((depth, width, height))
    return tuple(sorted(found))


def spoken_for(candidates: Candidates, implied: Sequence[Implied]) -> Floats:
    """(n,) how much speaks for candidates because their boxes' other faces were found.

    Args:
        candidates: of one raster.
        implied: on the same.

    Returns:
        To be added to the logarithm of their odds.
    """
    if not implied or not len(candidates):
        return np.zeros(len(candidates))
    rows = [each.rectangle for each in implied]
    places = np.array([(r.u, r.v, r.width, r.height, r.turn, r.depth) for r in rows])
    agreed = np.empty((len(candidates), len(places)))
    chances = np.array([each.chance for each in implied])
    agreeing(candidates.values, places, chances, NEAR, agreed)
    apart = np.abs(candidates.values[:, None, 5] - places[None, :, 5])
    agreed[~(apart < DEEP)] = 0.0
    return np.asarray(SPEAKS * np.maximum(agreed.max(axis=1), 0.0))


def _other(region_from_face: Pose, face: Face, size: Vector3) -> Pose:
    """Where the other face of a box of this size lies, in the region's frame."""
    depth, _, height = size
    x, y, z = region_from_face.translation
    along = np.array(region_from_face.rotation)[:, 0]
    c, s = -along[1], along[0]
    norm = math.hypot(c, s)
    c, s = c / norm, s / norm
    if face.facing is Facing.FRONT:
        turn = ((s, -c, 0.0), (-c, -s, 0.0), (0.0, 0.0, -1.0))
        return Pose((x + depth / 2 * c, y + depth / 2 * s, z + height / 2), turn)
    turn = ((s, 0.0, c), (-c, 0.0, s), (0.0, -1.0, 0.0))
    return Pose((x - depth / 2 * c, y - depth / 2 * s, z - height / 2), turn)
