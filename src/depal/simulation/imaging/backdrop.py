"""What does not move in a camera's picture, painted once."""

from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from depal.simulation.imaging.atlas import Atlas
from depal.simulation.imaging.ground import Ground, find_ground
from depal.simulation.imaging.hall import RunLight
from depal.simulation.imaging.kernels import cover, paint
from depal.simulation.imaging.lens import Lens
from depal.simulation.imaging.mesh import Mesh
from depal.simulation.imaging.raster import fields_of
from depal.simulation.imaging.shadows import carried_by, sun_lens, sun_map

Floats = npt.NDArray[np.float64]
Bytes = npt.NDArray[np.uint8]

WALL = (176, 178, 181)
"""Behind everything, out of the depths' reach."""


EDGE_ON = 1e-15
"""A triangle whose plane passes nearer to the lens shows nothing [m^3]."""


@dataclass(frozen=True, slots=True, eq=False)
class Backdrop:
    """The still triangles of a cell before one camera.

    Attributes:
        mesh: in the cell frame.
        planes: (m, 3) of its triangles, as `planes_of` tells.
        nearest: (h, w) 1 / depth [1/m].
        owner: (h, w) index of the triangle, -1 where none stands.
        colour: (h, w, 3) without shadows, in the camera's colours.
        sun: (side, side) 1 / depth from the light [1/m].
        ground: where shadows can fall.
    """

    mesh: Mesh
    planes: Floats
    nearest: npt.NDArray[np.float32]
    owner: npt.NDArray[np.int32]
    colour: Bytes
    sun: Floats
    ground: Ground


def backdrop(mesh: Mesh, atlas: Atlas, lens: Lens, run: RunLight) -> Backdrop:
    """Paints what is still.

    Args:
        mesh: in the cell frame.
        atlas: its textures.
        lens: of the colour picture.
        run: the light.
    """
    width, height = lens.size
    corners = seen_from(mesh.corners, lens)
    nearest = np.zeros((height, width), dtype=np.float32)
    owner = np.full((height, width), -1, dtype=np.int32)
    cover(corners, lens.values, nearest, owner, 0)
    colour = np.empty((height, width, 3), dtype=np.uint8)
    colour[:] = WALL
    fields = fields_of(mesh, corners, atlas, run.on(mesh))
    paint(owner, nearest, fields, mesh.skins, atlas.table, atlas.texels, lens.values, colour)
    levels = np.arange(256)[:, None] * run.gains
    table = np.clip(levels, 0, 255).astype(np.uint8).reshape(256, 1, 3)
    colour = np.asarray(cv2.LUT(colour, table), dtype=np.uint8)
    light = sun_lens(run.light)
    sun = sun_map([mesh, *run.casters()], light)
    ground = _ground(owner, nearest, run.in_shadow(mesh, light), lens, light)
    return Backdrop(mesh, planes_of(corners), nearest, owner, colour, sun, ground)


def _ground(
    owner: npt.NDArray[np.int32],
    nearest: npt.NDArray[np.float32],
    kept: Floats,
    lens: Lens,
    light: Lens,
) -> Ground:
    """The pixels that the light's picture holds and that lose something in the shadow."""
    pixels, places = (np.empty(owner.size, dtype=np.int32) for _ in range(2))
    limits, left = (np.empty(owner.size, dtype=np.float32) for _ in range(2))
    ground = Ground(pixels, places, limits, left)
    lenses = np.stack((lens.values, light.values))
    count = find_ground(
        owner, nearest, kept, lenses, carried_by(light, lens), light.size[0], ground
    )
    return Ground(
        pixels[:count].copy(), places[:count].copy(), limits[:count].copy(), left[:count].copy()
    )


def seen_from(corners: Floats, lens: Lens) -> Floats:
    """Corners (n, 3, 3) from the cell in the camera's frame."""
    camera_from_cell = lens.cell_from_camera.inverse
    turn, shift = np.array(camera_from_cell.rotation), np.array(camera_from_cell.translation)
    return np.asarray(corners @ turn.T + shift)


def planes_of(corners: Floats) -> Floats:
    """(n, 3) whose product with a ray (x, y, 1) is 1 / depth on the triangle's plane [1/m]."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    offsets = (normals * corners[:, 0]).sum(axis=1, keepdims=True)
    edge_on = np.abs(offsets) < EDGE_ON
    return np.asarray(normals / np.where(edge_on, EDGE_ON, offsets))


def region_of(corners: Floats, lens: Lens) -> npt.NDArray[np.int64]:
    """First and last row, first and last column of the picture that triangles can fall on."""
    width, height = lens.size
    if not len(corners) or corners[..., 2].min() < lens.near:
        full = (0, height - 1, 0, width - 1) if len(corners) else (0, -1, 0, -1)
        return np.array(full, dtype=np.int64)
    x = corners[..., 0] / corners[..., 2] * lens.focal[0] + lens.centre[0]
    y = corners[..., 1] / corners[..., 2] * lens.focal[1] + lens.centre[1]
    low, high = np.array([y.min(), x.min()]), np.array([y.max(), x.max()])
    ends = np.array([height - 1, width - 1])
    first = np.clip(np.floor(low) - 1, 0, ends)
    last = np.clip(np.ceil(high) + 1, 0, ends)
    return np.array([first[0], last[0], first[1], last[1]], dtype=np.int64)


def in_view(corners: Floats, lens: Lens) -> npt.NDArray[np.bool_]:
    """(n,) the triangles that turn their outside to the lens and are not beside its picture."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    kept = (normals * corners[:, 0]).sum(axis=1) < 0.0
    x, y, z = corners[..., 0], corners[..., 1], corners[..., 2]
    (fx, fy), (cx, cy), (width, height) = lens.focal, lens.centre, lens.size
    for out in (
        x * fx < -(cx + 1) * z,
        x * fx > (width - cx) * z,
        y * fy < -(cy + 1) * z,
        y * fy > (height - cy) * z,
        z < lens.near,
    ):
        kept &= ~out.all(axis=1)
    return np.asarray(kept)
