"""From triangles to a picture with depth: a z-buffer in plain software, the same everywhere."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.simulation.imaging.atlas import Atlas
from depal.simulation.imaging.kernels import cover, paint
from depal.simulation.imaging.lens import Lens, Light
from depal.simulation.imaging.mesh import Mesh

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """What a lens sees.

    Attributes:
        colour: (h, w, 3) RGB.
        nearest: (h, w) 1 / depth [1/m]; 0 where nothing stands.
        triangles: (h, w) the triangle of the mesh, -1 where nothing stands.
        mesh: what was drawn.
    """

    colour: npt.NDArray[np.uint8]
    nearest: Floats
    triangles: npt.NDArray[np.int32]
    mesh: Mesh

    @property
    def depth(self) -> Floats:
        """(h, w) along the optical axis [m]; infinite where nothing stands."""
        with np.errstate(divide="ignore"):
            return 1.0 / self.nearest

    @property
    def parts(self) -> npt.NDArray[np.int64]:
        """(h, w) the part of the mesh, -1 where nothing stands."""
        return np.asarray(np.append(self.mesh.parts, -1)[self.triangles])


def render(
    mesh: Mesh,
    atlas: Atlas,
    lens: Lens,
    light: Light | None = None,
    sky: tuple[int, int, int] = (255, 255, 255),
) -> Picture:
    """Draws triangles.

    Args:
        mesh: in the cell frame.
        atlas: its textures.
        lens: who looks.
        light: what shines.
        sky: the colour where nothing stands.

    Returns:
        Colour, depth and part of every pixel; of two surfaces at the same depth the first is seen.
    """
    width, height = lens.size
    camera_from_cell = lens.cell_from_camera.inverse
    turn, shift = np.array(camera_from_cell.rotation), np.array(camera_from_cell.translation)
    corners = mesh.corners @ turn.T + shift
    nearest = np.zeros((height, width))
    triangles = np.full((height, width), -1, dtype=np.int32)
    cover(corners, lens.values, nearest, triangles, 0)
    colour = np.empty((height, width, 3), dtype=np.uint8)
    colour[:] = sky
    fields = fields_of(mesh, corners, atlas, (light or Light()).on(mesh.normals))
    paint(triangles, nearest, fields, mesh.skins, atlas.table, atlas.texels, lens.values, colour)
    return Picture(colour, nearest, triangles, mesh)


def fields_of(mesh: Mesh, corners: Floats, atlas: Atlas, bright: Floats) -> Floats:
    """u, v and brightness as linear functions of the place; and texels per metre.

    Args:
        mesh: triangles.
        corners: theirs in the camera's frame, (n, 3, 3) [m].
        atlas: their textures.
        bright: brightness at the corners, (n, 3).

    Returns:
        (n, 4, 4) as `paint` takes them.
    """
    values = np.concatenate((mesh.uv, bright[..., None]), axis=2)
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normal = np.cross(a, b)
    square = np.maximum((normal * normal).sum(axis=1), 1e-30)
    along = (values[:, 1] - values[:, 0])[:, :, None] * np.cross(b, normal)[:, None, :]
    across = (values[:, 2] - values[:, 0])[:, :, None] * np.cross(normal, a)[:, None, :]
    fields = np.zeros((len(corners), 4, 4))
    fields[:, :3, :3] = (along + across) / square[:, None, None]
    fields[:, :3, 3] = values[:, 0] - np.einsum("nij,nj->ni", fields[:, :3, :3], corners[:, 0])
    du, dv = mesh.uv[:, 1] - mesh.uv[:, 0], mesh.uv[:, 2] - mesh.uv[:, 0]
    sizes = atlas.table[mesh.skins, 0, 1:].prod(axis=1)
    texels = np.abs(du[:, 0] * dv[:, 1] - du[:, 1] * dv[:, 0]) * sizes
    fields[:, 3, 0] = np.sqrt(texels / np.sqrt(square))
    return fields
