"""The cell as a picture: everything in it from the front left, high above."""

import math

import cv2
import numpy as np
import numpy.typing as npt

from depal.app.pictures.captions import caption_height, captioned
from depal.domain import CellLayout
from depal.geometry import Vector3
from depal.simulation.cases import Case
from depal.simulation.imaging import furniture
from depal.simulation.imaging.lens import Lens, Light, aimed
from depal.simulation.imaging.mesh import Mesh
from depal.simulation.imaging.raster import Picture, render
from depal.simulation.imaging.scene import CellScene
from depal.simulation.imaging.shadows import add_shadows
from depal.simulation.snapshot import Snapshot

Bytes = npt.NDArray[np.uint8]

FINE = 2
"""Pictures are drawn this much finer and then reduced, which smooths every edge."""

SKY = (243, 244, 246)
"""Behind everything."""

AZIMUTH, RISE = math.radians(36), math.radians(38)
"""Where the viewer stands: from the x axis to the left, and above the floor [rad]."""

AWAY = 2.2
"""How far the viewer stands away, in lengths of the floor."""

FILLED = 0.97
"""How much of the picture the cell fills."""

PANE = (208, 220, 235)
"""Walls between the viewer and what is stored are panes of this colour."""

GLASS = 0.34
"""How much of a pane is seen."""

RIM, SOLID = 0.06, 0.75
"""Faces of a pane that are narrower than this are rims [m]; how much of a rim is seen."""


class CellPainter:
    """Draws one cell at any moment."""

    def __init__(self, layout: CellLayout, cases: tuple[Case, ...]) -> None:
        """Draws the prints of all cases.

        Args:
            layout: the cell.
            cases: its boxes, in the order of the snapshots.
        """
        self._scene = CellScene(layout, cases)
        self._layout = layout
        self._light = Light(towards=(0.5, 0.35, 0.85), direct=0.42, above=0.62, below=0.46)

    def picture(
        self, snapshot: Snapshot, caption: str = "", size: tuple[int, int] = (800, 600)
    ) -> Bytes:
        """The cell at one moment.

        Args:
            snapshot: the moment.
            caption: written below, one or two lines.
            size: width and height [pixel].

        Returns:
            (height, width, 3) RGB.
        """
        bar = caption_height(size, caption)
        room = (size[0], size[1] - bar)
        fine = (room[0] * FINE, room[1] * FINE)
        mesh, lens = self._scene.at(snapshot), viewpoint(self._layout, fine)
        walls = self._in_the_way(lens)
        seen = self._drawn(mesh.without(walls), lens)
        add_shadows(seen, lens, self._light, *_region(self._layout))
        _veil(seen, self._drawn(mesh.only(walls), lens))
        small = cv2.resize(seen.colour, room, interpolation=cv2.INTER_AREA)
        return captioned(np.asarray(small, dtype=np.uint8), caption, bar)

    def _drawn(self, mesh: Mesh, lens: Lens) -> Picture:
        return render(mesh, self._scene.atlas, lens, self._light, SKY)

    def _in_the_way(self, lens: Lens) -> npt.NDArray[np.int64]:
        """All sides of storages, and the backs that turn their outside to the viewer."""
        eye = np.array(lens.cell_from_camera.translation)
        parts = [
            wall.part
            for wall in self._scene.walls
            if not wall.back or (eye - wall.at) @ np.array(wall.outward) > 0.0
        ]
        return np.array(parts, dtype=np.int64)


def _veil(seen: Picture, panes: Picture) -> None:
    """Lays panes over what stands behind them; their rims are seen more than they are."""
    edges = np.roll(panes.mesh.corners, -1, axis=1) - panes.mesh.corners
    rims = np.append(np.linalg.norm(edges, axis=2).min(axis=1) < RIM, False)
    before = panes.nearest > seen.nearest
    rim = before & rims[panes.triangles]
    for pixels, colour, share in (
        (before & ~rim, np.array(PANE), GLASS),
        (rim, panes.colour[rim], SOLID),
    ):
        mixed = seen.colour[pixels] * (1 - share) + colour * share
        seen.colour[pixels] = mixed.astype(np.uint8)


def viewpoint(layout: CellLayout, size: tuple[int, int]) -> Lens:
    """From the pallet's side, left of it and high above; the cell fills the picture."""
    (x0, y0), (x1, y1) = layout.floor
    middle = np.array(((x0 + x1) / 2, (y0 + y1) / 2, 0.0))
    azimuth, rise = AZIMUTH, RISE
    way = np.array((math.cos(azimuth), math.sin(azimuth), math.tan(rise)))
    x, y, z = (middle + way * AWAY * max(x1 - x0, y1 - y0)).tolist()
    a, b, c = middle.tolist()
    pose = aimed((x, y, z), (a, b, c))
    seen = pose.inverse
    edge = furniture.BEYOND
    floor = [(x, y, 0.0) for x in (x0 - edge, x1 + edge) for y in (y0 - edge, y1 + edge)]
    tops = [
        storage.cell_from_storage.apply((depth, side * storage.size[0] / 2, storage.size[2]))
        for storage in layout.storages
        for depth in (0.0, storage.size[1])
        for side in (-1, 1)
    ]
    points = np.array([seen.apply(point) for point in (*floor, *tops)])
    spots = points[:, :2] / points[:, 2:]
    low, high = spots.min(axis=0), spots.max(axis=0)
    focal = float((np.array(size) / (high - low)).min()) * FILLED
    at = (np.array(size) - 1) / 2 - focal * (low + high) / 2
    return Lens(pose, size, (focal, focal), (float(at[0]), float(at[1])))


def _region(layout: CellLayout) -> tuple[Vector3, float]:
    """Middle and radius of what throws shadows [m]."""
    (x0, y0), (x1, y1) = layout.floor
    return ((x0 + x1) / 2, (y0 + y1) / 2, 0.8), math.hypot(x1 - x0, y1 - y0) / 2
