"""Soft shadows: what the light does not see, by a picture of depths from the light's side."""

import math

import numpy as np
import numpy.typing as npt

from depal.geometry import Vector3, loop_kernel
from depal.simulation.imaging.kernels import cover
from depal.simulation.imaging.lens import Lens, Light, aimed
from depal.simulation.imaging.mesh import Mesh
from depal.simulation.imaging.raster import Picture

Floats = npt.NDArray[np.float64]

SIDE = 1024
"""The light's picture has so many pixels along each side."""

AWAY = 60.0
"""The light stands so far away [m]."""

SPREAD = 1
"""An edge of a shadow is soft over so many of the light's pixels, to either side."""

BEHIND = 0.04
"""What lies less than this behind the first surface is lit [m]."""


def add_shadows(picture: Picture, lens: Lens, light: Light, middle: Vector3, radius: float) -> None:
    """Darkens what stands in the shadow of something else.

    Args:
        picture: as drawn by this lens in this light; its colours are changed.
        lens: who looks.
        light: what shines; only its direct part is kept off.
        middle: of the region that throws shadows [m].
        radius: of the region [m].
    """
    sun = sun_lens(light, middle, radius, SIDE)
    nearest = sun_map([picture.mesh], sun)
    lit = light.on(picture.mesh.normals).mean(axis=1)
    around = Light(light.towards, 0.0, light.above, light.below)
    kept = around.on(picture.mesh.normals).mean(axis=1) / np.maximum(lit, 1e-9)
    lenses = np.stack((lens.values, sun.values))
    carried = carried_by(sun, lens)
    _darken(picture.nearest, picture.triangles, kept, lenses, carried, nearest, picture.colour)


def sun_lens(
    light: Light, middle: Vector3 = (1.7, 0.0, 0.7), radius: float = 2.0, side: int = 640
) -> Lens:
    """The light's view of a region, with its radius [m] and so many pixels along each side."""
    towards = np.array(light.towards) / np.linalg.norm(light.towards)
    x, y, z = (np.array(middle) + AWAY * towards).tolist()
    view = 2 * math.atan(radius / AWAY)
    return Lens.looking(aimed((x, y, z), middle), (side, side), view, 1.0)


def sun_map(meshes: list[Mesh], sun: Lens, before: Floats | None = None) -> Floats:
    """1 / depth [1/m] of what the light sees first, (side, side); over a map of other things."""
    sun_from_cell = sun.cell_from_camera.inverse
    turn, shift = np.array(sun_from_cell.rotation), np.array(sun_from_cell.translation)
    side = sun.size[0]
    nearest = np.zeros((side, side)) if before is None else before.copy()
    owner = np.empty((side, side), dtype=np.int32)
    for mesh in meshes:
        cover(mesh.corners @ turn.T + shift, sun.values, nearest, owner, 0)
    return nearest


def carried_by(sun: Lens, lens: Lens) -> Floats:
    """(3, 4) from the lens's frame to the light's."""
    way = sun.cell_from_camera.inverse @ lens.cell_from_camera
    return np.column_stack((np.array(way.rotation), np.array(way.translation)))


@loop_kernel
def _darken(
    nearest: Floats,
    triangles: npt.NDArray[np.int32],
    kept: Floats,
    lenses: Floats,
    carried: Floats,
    map_: Floats,
    colour: npt.NDArray[np.uint8],
) -> None:
    """Every pixel's share of shadow, over a small square of the light's picture.

    Args:
        nearest: (h, w) 1 / depth [1/m].
        triangles: (h, w) the triangle, negative where none is.
        kept: (n,) the share of its brightness that a triangle keeps in the shadow.
        lenses: (2, 5) values of the viewer's lens and of the light's.
        carried: (3, 4) from the viewer's frame to the light's.
        map_: (SIDE, SIDE) 1 / depth from the light [1/m].
        colour: (h, w, 3) RGB; updated.
    """
    height, width = nearest.shape
    a, s = lenses[0], lenses[1]
    side = map_.shape[0] - 1
    for row in range(height):
        ry = (row - a[3]) / a[1]
        for column in range(width):
            t = triangles[row, column]
            if t < 0 or kept[t] > 0.999:  # noqa: PLR2004
                continue
            rx, z = (column - a[2]) / a[0], 1.0 / nearest[row, column]
            x = (carried[0, 0] * rx + carried[0, 1] * ry + carried[0, 2]) * z + carried[0, 3]
            y = (carried[1, 0] * rx + carried[1, 1] * ry + carried[1, 2]) * z + carried[1, 3]
            d = (carried[2, 0] * rx + carried[2, 1] * ry + carried[2, 2]) * z + carried[2, 3]
            u, v = int(s[0] * x / d + s[2] + 0.5), int(s[1] * y / d + s[3] + 0.5)
            limit, hidden, count = 1.0 / (d - BEHIND), 0, 0
            for j in range(max(v - SPREAD, 0), min(v + SPREAD, side) + 1):
                for i in range(max(u - SPREAD, 0), min(u + SPREAD, side) + 1):
                    count += 1
                    hidden += map_[j, i] > limit
            if hidden:
                factor = 1.0 - (1.0 - kept[t]) * hidden / count
                for c in range(3):
                    colour[row, column, c] = int(colour[row, column, c] * factor)
