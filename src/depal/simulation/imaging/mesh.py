"""Triangles with textures, and the shapes that a cell is made of."""

import math
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from depal.geometry import Pose, Vector3

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]

SIDES = ("+x", "-x", "+y", "-y", "+z", "-z")
"""The faces of a box in its own frame, in the order in which they are given."""

AROUND = 28
"""A capsule has so many facets around."""

RINGS = 7
"""A capsule's round end has so many rings."""

# Outward normal, direction to the right and down of somebody who looks at the face from outside.
_FACES = (
    ((1, 0, 0), (0, 1, 0), (0, 0, -1)),
    ((-1, 0, 0), (0, -1, 0), (0, 0, -1)),
    ((0, 1, 0), (-1, 0, 0), (0, 0, -1)),
    ((0, -1, 0), (1, 0, 0), (0, 0, -1)),
    ((0, 0, 1), (1, 0, 0), (0, -1, 0)),
    ((0, 0, -1), (1, 0, 0), (0, 1, 0)),
)


@dataclass(frozen=True, slots=True, eq=False)
class Mesh:
    """Triangles, anticlockwise as seen from outside.

    Attributes:
        corners: (n, 3, 3) [m].
        normals: (n, 3, 3) outward unit normals at the corners, for the light.
        uv: (n, 3, 2) where the corners lie in the texture, 0 .. 1 from its left and its top.
        skins: (n,) which texture.
        parts: (n,) which body or thing each belongs to, as pictures tell it.
    """

    corners: Floats
    normals: Floats
    uv: Floats
    skins: Ints
    parts: Ints

    def moved(self, pose: Pose) -> "Mesh":
        """The same triangles carried by a pose."""
        turn = np.array(pose.rotation)
        corners = self.corners @ turn.T + np.array(pose.translation)
        return replace(self, corners=corners, normals=self.normals @ turn.T)

    def placed(self, rotations: Floats, translations: Floats) -> "Mesh":
        """Each part carried by its own pose: rotations (parts, 3, 3), translations (parts, 3)."""
        corners, normals = np.empty_like(self.corners), np.empty(self.normals.shape)
        ends = np.flatnonzero(np.diff(self.parts, append=-1)) + 1
        start = 0
        for end in ends.tolist():  # runs of one part: faster than a product for each triangle
            part, run = int(self.parts[start]), slice(start, end)
            turn = rotations[part].T
            corners[run] = (self.corners[run].reshape(-1, 3) @ turn + translations[part]).reshape(
                -1, 3, 3
            )
            normals[run] = (self.normals[run].reshape(-1, 3) @ turn).reshape(-1, 3, 3)
            start = end
        return replace(self, corners=corners, normals=normals)

    def of_part(self, part: int) -> "Mesh":
        """The same as one part."""
        return replace(self, parts=np.full(len(self.parts), part))

    def without(self, parts: Ints) -> "Mesh":
        """The triangles of all other parts."""
        return self.chosen(~np.isin(self.parts, parts))

    def only(self, parts: Ints) -> "Mesh":
        """The triangles of these parts."""
        return self.chosen(np.isin(self.parts, parts))

    def chosen(self, kept: npt.NDArray[np.bool_] | Ints) -> "Mesh":
        """The triangles that are kept, by a mask or their numbers."""
        return Mesh(
            self.corners[kept],
            self.normals[kept],
            self.uv[kept],
            self.skins[kept],
            self.parts[kept],
        )


def joined(meshes: list[Mesh]) -> Mesh:
    """All triangles of some meshes."""
    return Mesh(
        np.concatenate([mesh.corners for mesh in meshes]),
        np.concatenate([mesh.normals for mesh in meshes]),
        np.concatenate([mesh.uv for mesh in meshes]),
        np.concatenate([mesh.skins for mesh in meshes]),
        np.concatenate([mesh.parts for mesh in meshes]),
    )


def rectangle(pose: Pose, size: tuple[float, float], skin: int, part: int = 0) -> Mesh:
    """A rectangle in the pose's plane of x (to the right) and y (down); seen against its z."""
    (a, b), h = (size[0] / 2, size[1] / 2), 0.0
    square = np.array([(-a, -b, h), (-a, b, h), (a, b, h), (a, -b, h)])
    texture = np.array([(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.0)])
    halves = np.array([(0, 1, 2), (0, 2, 3)])
    normals = np.broadcast_to(np.array((0.0, 0.0, -1.0)), (2, 3, 3))
    flat = Mesh(square[halves], normals, texture[halves], np.full(2, skin), np.full(2, part))
    return flat.moved(pose)


def face_pose(size: Vector3, side: int, out: float = 0.0) -> Pose:
    """`box_from_face`: middle of a face, x to the right, y down and z inwards as one looks at it.

    Args:
        size: of the box [m].
        side: index into `SIDES`.
        out: how far before the face [m].
    """
    normal, right, down = (np.array(axis, dtype=float) for axis in _FACES[side])
    middle = normal * (np.abs(normal) @ np.array(size) / 2 + out)
    return Pose.from_arrays(middle, np.column_stack((right, down, -normal)))


def face_size(size: Vector3, side: int) -> tuple[float, float]:
    """Width and height of a face as one looks at it [m]."""
    _, right, down = (np.abs(np.array(axis, dtype=float)) for axis in _FACES[side])
    return float(right @ np.array(size)), float(down @ np.array(size))


def cuboid(size: Vector3, skins: tuple[int, ...], part: int = 0) -> Mesh:
    """A box around the origin; six textures in the order of `SIDES`, or one for all."""
    each = skins * 6 if len(skins) == 1 else skins
    return joined(
        [
            rectangle(face_pose(size, side), face_size(size, side), each[side], part)
            for side in range(6)
        ]
    )


def capsule(start: Vector3, end: Vector3, radius: float, skin: int, part: int = 0) -> Mesh:
    """A segment with a radius, as rings between its two poles."""
    a, b = np.array(start, dtype=float), np.array(end, dtype=float)
    length = float(np.linalg.norm(b - a))
    w = (b - a) / length if length > 0 else np.array((0.0, 0.0, 1.0))
    u = np.cross(w, np.eye(3)[int(np.abs(w).argmin())])
    u /= np.linalg.norm(u)
    v = np.cross(w, u)
    turn = np.linspace(0.0, 2 * math.pi, AROUND + 1)
    rise = np.linspace(0.0, math.pi / 2, RINGS)
    angles = np.concatenate((rise - math.pi / 2, rise))
    along = np.repeat((0.0, length), RINGS)
    ring = np.cos(turn)[:, None] * u + np.sin(turn)[:, None] * v
    out = np.cos(angles)[:, None, None] * ring + np.sin(angles)[:, None, None] * w
    points = a + along[:, None, None] * w + radius * out
    lower, upper = (slice(None, -1), slice(1, None))
    quads = [(lower, lower), (lower, upper), (upper, upper), (upper, lower)]
    at = np.stack([points[i, j] for i, j in quads], axis=2).reshape(-1, 4, 3)
    normals = np.stack([out[i, j] for i, j in quads], axis=2).reshape(-1, 4, 3)
    halves = np.array([(0, 1, 2), (0, 2, 3)])
    corners, normals = at[:, halves].reshape(-1, 3, 3), normals[:, halves].reshape(-1, 3, 3)
    count = len(corners)
    uv = np.full((count, 3, 2), 0.5)
    return Mesh(corners, normals, uv, np.full(count, skin), np.full(count, part))
