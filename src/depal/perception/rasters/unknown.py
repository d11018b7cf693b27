"""Where to look for boxes in a picture of which nobody said where its pallet stands."""

import math
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from depal.geometry import Pose
from depal.perception.rasters.region import Region
from depal.ports import Frame

Floats = npt.NDArray[np.float64]

SOME = 4000
"""So many points of a picture are enough to find planes."""

TRIES = 400
"""So many planes through three points are tried."""

THICK = 0.02
"""Points so near to a plane belong to it [m]."""

LARGE = 0.08
"""A plane that matters holds this share of the points."""

BELOW = 0.03
"""Of the points at most this share may lie under the ground: noise, and edges."""

TILTED = math.cos(math.radians(20))
"""The ground is no more tilted than this."""

UPRIGHT: Pose = Pose(rotation=((0.0, 0.0, 1.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0)))
"""`cell_from_camera` of a camera that stands upright and looks along x."""


@dataclass(frozen=True, slots=True)
class Surroundings:
    """A frame with a place to look for boxes.

    Attributes:
        frame: with a pose, the given one or one that suits what is seen.
        region: where boxes may be.
        posed: whether the pose was given.
    """

    frame: Frame
    region: Region
    posed: bool


def surroundings_of(frame: Frame, *, posed: bool) -> Surroundings:
    """Finds the region that a picture shows.

    Where the pose is known, up is known; the ground is the lowest large plane. Where it is not,
    the largest plane that faces the camera is taken for a front.

    Args:
        frame: with depth.
        posed: whether its pose is to be believed.
    """
    random = np.random.default_rng(0)
    if not posed:
        frame = replace(frame, cell_from_camera=UPRIGHT)
    points = _points(frame, random)
    pose = frame.cell_from_camera
    turn = np.array(pose.rotation)
    cell = points @ turn.T + np.array(pose.translation)
    if posed:
        up, base = _ground(cell, random)
        away = _away(turn, up)
    else:
        away = _facing(cell, random)
        up = np.array([0.0, 0.0, 1.0]) - away[2] * away
        up /= np.linalg.norm(up)
        base = float(np.percentile(cell @ up, 0.5))
    axes = np.column_stack((away, np.cross(up, away), up))
    local = cell @ axes
    low, high = np.percentile(local, (0.5, 99.5), axis=0)
    low[2] = base
    origin = axes @ np.array([low[0], (low[1] + high[1]) / 2, low[2]])
    deep, wide, tall = np.maximum(high - low, 0.1).tolist()
    region = Region(Pose.from_arrays(origin, axes), (deep, wide, tall + THICK), 0.0)
    return Surroundings(frame, region, posed)


def _points(frame: Frame, random: np.random.Generator) -> Floats:
    """(n, 3) some points of the picture, in the camera's frame [m]."""
    rows, columns = np.nonzero(frame.depth > 0.0)
    if not rows.size:
        return np.array([[0.0, 0.0, 1.0]])
    chosen = random.permutation(len(rows))[:SOME]
    z = frame.depth[rows[chosen], columns[chosen]].astype(float)
    k = frame.depth_k
    x = (columns[chosen] - k[0][2]) / k[0][0] * z
    y = (rows[chosen] - k[1][2]) / k[1][1] * z
    return np.column_stack((x, y, z))


def _planes(points: Floats, random: np.random.Generator) -> tuple[Floats, Floats]:
    """(k, 3) unit normals and (k,) offsets of planes through three points each."""
    corners = points[random.integers(0, len(points), (TRIES, 3))]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normals, axis=1)
    good = length > 1e-4  # noqa: PLR2004
    normals = normals[good] / length[good, None]
    return normals, (normals * corners[good, 0]).sum(axis=1)


def _ground(points: Floats, random: np.random.Generator) -> tuple[Floats, float]:
    """The unit normal of the ground, and its height along it [m]."""
    normals, offsets = _planes(points, random)
    flip = np.sign(normals[:, 2])
    normals, offsets = normals * flip[:, None], offsets * flip
    heights = points @ normals.T - offsets
    held, under = (np.abs(heights) < THICK).mean(axis=0), (heights < -THICK).mean(axis=0)
    fits = (normals[:, 2] > TILTED) & (held > LARGE) & (under < BELOW)
    if not fits.any():
        return np.array([0.0, 0.0, 1.0]), float(np.percentile(points[:, 2], 0.5))
    best = int(np.where(fits, held, 0.0).argmax())
    return normals[best], float(offsets[best])


def _facing(points: Floats, random: np.random.Generator) -> Floats:
    """The direction into the largest plane that faces the viewer, who looks along x."""
    normals, offsets = _planes(points, random)
    flip = np.sign(normals[:, 0])
    normals, offsets = normals * flip[:, None], offsets * flip
    held = (np.abs(points @ normals.T - offsets) < THICK).mean(axis=0)
    held = np.where(normals[:, 0] > math.cos(math.radians(40)), held, 0.0)
    if held.max(initial=0.0) < LARGE:
        return np.array([1.0, 0.0, 0.0])
    return np.asarray(normals[int(held.argmax())])


def _away(turn: Floats, up: Floats) -> Floats:
    """The horizontal direction in which a camera looks, or in which its picture's top lies."""
    forward = turn[:, 2] - (turn[:, 2] @ up) * up
    if np.linalg.norm(forward) < math.sin(math.radians(30)):
        forward = -turn[:, 1] + (turn[:, 1] @ up) * up
    return np.asarray(forward / np.linalg.norm(forward))
