"""Solid things in perspective, each hiding what lies behind it: a small depth buffer.

Drawings of a cell need no camera model and no textures, only sides in flat light with their
edges; a few thousand triangles take about a second.
"""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.geometry import OrientedBox
from depal.studies.drawing.palette import Colour

Array = npt.NDArray[np.float64]

_LIGHT = np.array((-0.45, 0.35, 0.82))
_AROUND = 24
_NEAR = 0.05


@dataclass(frozen=True, slots=True, eq=False)
class Mesh:
    """Triangles of one colour.

    Attributes:
        triangles: (n, 3, 3) [m], in the cell frame.
        sides: which side of the thing each belongs to; edges are drawn between sides, (n,).
        colour: of the thing.
    """

    triangles: Array
    sides: npt.NDArray[np.int64]
    colour: Colour


def box_mesh(box: OrientedBox, colour: Colour) -> Mesh:
    """The six sides of a box."""
    corners = box.corners
    quads = (
        (0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)
    )  # fmt: skip
    triangles = [corners[[a, *pair]] for a, b, c, d in quads for pair in ((b, c), (c, d))]
    return Mesh(np.array(triangles), np.arange(12) // 2, colour)


def capsule_mesh(start: Array, end: Array, radius: float, colour: Colour) -> Mesh:
    """A segment with a radius, as rings between its two poles; one round side."""
    axis = end - start
    length = float(np.linalg.norm(axis))
    w = axis / length if length > 0 else np.array((0.0, 0.0, 1.0))
    u = np.cross(w, (1.0, 0.0, 0.0) if abs(w[0]) < 0.9 else (0.0, 1.0, 0.0))  # noqa: PLR2004
    u /= np.linalg.norm(u)
    v = np.cross(w, u)
    turn = np.linspace(0, 2 * math.pi, _AROUND, endpoint=False)
    ring = np.cos(turn)[:, None] * u + np.sin(turn)[:, None] * v
    rise = np.linspace(-math.pi / 2, 0, 6)
    rings = [start + radius * (math.sin(r) * w + math.cos(r) * ring) for r in rise]
    rings += [end + radius * (-math.sin(r) * w + math.cos(r) * ring) for r in rise[::-1]]
    triangles = []
    for low, high in itertools.pairwise(rings):
        low_next, high_next = np.roll(low, -1, axis=0), np.roll(high, -1, axis=0)
        triangles += [np.stack((low, low_next, high), 1), np.stack((low_next, high_next, high), 1)]
    joined = np.concatenate(triangles)
    return Mesh(joined, np.zeros(len(joined), dtype=np.int64), colour)


@dataclass(frozen=True, slots=True, eq=False)
class Perspective:
    """A pinhole view.

    Attributes:
        eye: where it is [m].
        target: what is in the middle of the picture [m].
        width: of the picture [pixel].
        height: of the picture [pixel].
        focal: from the eye to the picture, in pixels.
        middle: where in the picture the target is, right and down [pixel].
    """

    eye: tuple[float, float, float]
    target: tuple[float, float, float]
    width: int
    height: int
    focal: float
    middle: tuple[float, float]

    def project(self, points: npt.ArrayLike) -> Array:
        """Points of the cell, (..., 3) [m], as right, down [pixel] and distance [m], (..., 3)."""
        forward = np.subtract(self.target, self.eye)
        forward = forward / np.linalg.norm(forward)
        right = np.cross(forward, (0.0, 0.0, 1.0))
        right /= np.linalg.norm(right)
        axes = np.stack((right, np.cross(forward, right), forward))
        seen = (np.asarray(points, dtype=float) - np.array(self.eye)) @ axes.T
        ahead = np.maximum(seen[..., 2:], _NEAR)
        flat = seen[..., :2] / ahead * self.focal + self.middle
        return np.concatenate((flat, ahead), axis=-1)


def shaded(view: Perspective, meshes: Sequence[Mesh], paper: Colour) -> Array:
    """The picture of some things.

    Args:
        view: from where.
        meshes: what is there.
        paper: the colour of nothing.

    Returns:
        Red, green, blue in [0, 1], (height, width, 3).
    """
    depth = np.zeros((view.height, view.width))  # one over the distance: linear in the picture
    label = np.full((view.height, view.width), -1, dtype=np.int64)
    triangles = np.concatenate([mesh.triangles for mesh in meshes])
    flat = view.project(triangles)
    for number in range(len(triangles)):
        _fill(flat[number], number, depth, label)
    light, owner, side = _looks(meshes, triangles)
    colours = np.concatenate([np.tile(mesh.colour, (len(mesh.sides), 1)) for mesh in meshes])
    colours = np.vstack((colours * light[:, None], paper))
    picture: Array = colours[label]
    key = np.append(owner * 8 + side, -1)[label]
    edge = np.zeros(key.shape, dtype=bool)
    edge[:, 1:] |= key[:, 1:] != key[:, :-1]
    edge[1:] |= key[1:] != key[:-1]
    picture[edge] *= 0.45
    return picture


def _looks(
    meshes: Sequence[Mesh], triangles: Array
) -> tuple[Array, npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """How much light falls on each triangle, which thing it is of, and which side of it."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = normals / np.where(lengths > 0, lengths, 1.0)
    owner = np.concatenate([np.full(len(m.sides), i) for i, m in enumerate(meshes)])
    middle = np.array([mesh.triangles.reshape(-1, 3).mean(axis=0) for mesh in meshes])
    outward = np.sign(((triangles.mean(axis=1) - middle[owner]) * normals).sum(axis=1))
    light = 0.74 + 0.26 * (normals * outward[:, None]) @ (_LIGHT / np.linalg.norm(_LIGHT))
    return light, owner, np.concatenate([mesh.sides for mesh in meshes])


def _fill(corners: Array, number: int, depth: Array, label: npt.NDArray[np.int64]) -> None:
    """Fills one triangle where it is nearer than what is there."""
    height, width = depth.shape
    low = np.maximum(np.floor(corners[:, :2].min(axis=0)).astype(int), 0)
    high = np.minimum(np.ceil(corners[:, :2].max(axis=0)).astype(int) + 1, (width, height))
    if (low >= high).any():
        return
    (x0, y0), (x1, y1), (x2, y2) = corners[:, :2]
    area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    if abs(area) < 1e-9:  # noqa: PLR2004 - seen from its edge
        return
    x = np.arange(low[0], high[0])[None, :] + 0.5
    y = np.arange(low[1], high[1])[:, None] + 0.5
    b = ((x - x0) * (y2 - y0) - (x2 - x0) * (y - y0)) / area
    c = ((x1 - x0) * (y - y0) - (x - x0) * (y1 - y0)) / area
    near = (1 - b - c) / corners[0, 2] + b / corners[1, 2] + c / corners[2, 2]
    window = (slice(low[1], high[1]), slice(low[0], high[0]))
    wins = (b >= 0) & (c >= 0) & (b + c <= 1) & (near > depth[window])
    depth[window][wins] = near[wins]
    label[window][wins] = number
