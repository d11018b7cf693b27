"""One camera before one scene in one run: from the places of all things to a frame."""

from typing import NamedTuple

import cv2
import numpy as np
import numpy.typing as npt
from scipy.spatial.transform import Rotation

from depal.domain import CameraMount
from depal.geometry import Pose
from depal.ports import Frame
from depal.simulation.imaging.backdrop import (
    Backdrop,
    backdrop,
    in_view,
    planes_of,
    region_of,
    seen_from,
)
from depal.simulation.imaging.deep import disparities
from depal.simulation.imaging.depth_noise import DEPTH, DepthSensor
from depal.simulation.imaging.exposure import Looks, Sun, expose
from depal.simulation.imaging.ground import shade_ground
from depal.simulation.imaging.hall import RunLight
from depal.simulation.imaging.kernels import cover
from depal.simulation.imaging.lens import Lens
from depal.simulation.imaging.mesh import Mesh
from depal.simulation.imaging.raster import fields_of
from depal.simulation.imaging.scene import CellScene, Moment
from depal.simulation.imaging.sensor import Grain
from depal.simulation.imaging.severity import Severity
from depal.simulation.imaging.shadows import carried_by, sun_lens, sun_map
from depal.simulation.imaging.wear import WEAR, Wear, Worn
from depal.simulation.snapshot import Snapshot

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]
Bytes = npt.NDArray[np.uint8]
Owners = npt.NDArray[np.int32]


class Before(NamedTuple):
    """The moving triangles before a camera: in the cell, their boxes' faces, in its own frame."""

    mesh: Mesh
    faces: Ints
    corners: Floats


class CameraModel:
    """What one camera makes of a scene in one run.

    Attributes:
        mount: where it stands.
        severity: how far it is from ideal.
        lens: of the depth picture.
        bias: every depth is wrong by this share; whoever uses the camera does not know it.
    """

    def __init__(
        self,
        scene: CellScene,
        mount: CameraMount,
        seed: int,
        severity: Severity = Severity.NORMAL,
        wear: Wear | None = None,
    ) -> None:
        """A camera before a scene.

        Args:
            scene: what it sees.
            mount: where it stands.
            seed: of all that is random in this run.
            severity: how far it is from ideal.
            wear: of the scene's boxes in this run, where another camera has drawn it.
        """
        self.mount, self.severity = mount, severity
        self._scene, self._seed = scene, seed
        self._colour_lens, self.lens = (
            Lens.looking(mount.cell_from_camera, size, mount.vertical_view)
            for size in (mount.colour_size, mount.depth_size)
        )
        own = int.from_bytes(mount.name.encode()[:6].ljust(6), "big")
        self._own = own
        self._light = RunLight.drawn(severity, seed, own)
        self._sun = sun_lens(self._light.light)
        self._wear = wear or Wear(scene.shapes, WEAR[severity], seed)
        self._sensor = DepthSensor(self.lens, DEPTH[severity], (seed, own))
        self.bias = self._sensor.bias
        settings = self._light.settings
        self._grain = Grain(mount.colour_size, settings.grain, settings.blur, (seed, own))
        self._columns, self._rows = _nearest_pixels(self._colour_lens, self.lens)
        ends = np.array([self._columns[[0, -1]], self._rows[[0, -1]]])
        self._wider = bool(np.any((ends < 0) | (ends >= np.array([mount.colour_size]).T)))
        width, height = mount.colour_size
        self._owner = np.empty((height, width), dtype=np.int32)  # filled anew for each picture
        self._nearest = np.empty((height, width), dtype=np.float32)
        self._colour = np.empty((height, width, 3), dtype=np.uint8)
        self._still: tuple[tuple[str, ...], Backdrop] | None = None

    def at(self, mount: CameraMount) -> "CameraModel":
        """The same camera in another place, before the same scene."""
        return CameraModel(self._scene, mount, self._seed, self.severity, self._wear)

    def frame(self, snapshot: Snapshot, taken: float, number: int) -> Frame:
        """A picture of a moment; the same for the same seed, moment and number.

        Args:
            snapshot: where everything is.
            taken: when [s].
            number: of this picture in the run.
        """
        return self._taken(snapshot, taken, number)[0]

    def shot(self, snapshot: Snapshot, taken: float, number: int) -> tuple[Frame, Ints]:
        """The same, and the part that each pixel of the depth picture truly sees, -1 for none."""
        frame, owner, parts = self._taken(snapshot, taken, number)
        return frame, np.append(parts, -1)[owner]

    def _taken(self, snapshot: Snapshot, taken: float, number: int) -> tuple[Frame, Owners, Ints]:
        """The picture, the triangle of each of its depths, and the part of each triangle."""
        behind, moment = self._backdrop(snapshot), self._scene.moving(snapshot)
        before = self._in_view(moment)
        worn = self._worn(snapshot)
        colour = self._exposed(behind, moment, before, worn)
        random = np.random.default_rng([self._seed, 7, self._own, number])
        deep = self._deep(behind, before.corners)
        planes = np.concatenate((behind.planes, planes_of(before.corners)))
        faces = np.concatenate((np.full(len(behind.planes), -1), before.faces))
        frame = Frame(
            taken,
            self._grain.sensed(colour, random),
            self._depth(deep, planes, faces, worn, random),
            self._colour_lens.k,
            self.lens.k,
            self.mount.cell_from_camera,
        )
        return frame, deep, np.concatenate((behind.mesh.parts, before.mesh.parts))

    def _in_view(self, moment: Moment) -> Before:
        """Those of the moving triangles that either picture can show."""
        corners = seen_from(moment.mesh.corners, self._colour_lens)
        chosen = in_view(corners, self._colour_lens)
        if self._wider:
            chosen |= in_view(corners, self.lens)
        return Before(moment.mesh.chosen(chosen), moment.faces[chosen], corners[chosen])

    def _exposed(self, behind: Backdrop, moment: Moment, before: Before, worn: Worn) -> Bytes:
        """The sharp picture; the triangles that its pixels see are left in `_owner`."""
        lens, first = self._colour_lens, len(behind.planes)
        nearest, owner, colour = self._nearest, self._owner, self._colour
        np.copyto(nearest, behind.nearest)
        np.copyto(owner, behind.owner)
        np.copyto(colour, behind.colour)
        cover(before.corners, lens.values, nearest, owner, first)
        sun = self._sunlight(behind, moment, before.mesh)
        flat, bare = colour.reshape(-1, 3), behind.colour.reshape(-1, 3)
        most = sun.most.ravel()
        shade_ground(behind.ground, owner.ravel(), first, sun.nearest, most, bare, flat)
        region = region_of(before.corners, lens)
        expose(owner, nearest, region, first, self._looks(before), sun, worn, colour)
        return colour

    def _sunlight(self, behind: Backdrop, moment: Moment, mesh: Mesh) -> Sun:
        """The light's picture, and what shadows do to the triangles of a mesh."""
        stands = self._sun.cell_from_camera
        if stands not in moment.lit:
            moment.lit[stands] = sun_map([moment.mesh], self._sun, behind.sun)
        lit = moment.lit[stands]
        most = np.asarray(cv2.dilate(lit, np.ones((3, 3), dtype=np.uint8)), dtype=np.float64)
        way = carried_by(self._sun, self._colour_lens)
        return Sun(self._sun.values, way, lit, most, self._light.in_shadow(mesh, self._sun))

    def _backdrop(self, snapshot: Snapshot) -> Backdrop:
        """The still things of this moment; painted anew only when a trolley comes or goes."""
        there = tuple(name for name, trolley in snapshot.bays.items() if trolley is not None)
        if self._still is None or self._still[0] != there:
            mesh = self._scene.still(snapshot)
            drawn = backdrop(mesh, self._scene.atlas, self._colour_lens, self._light)
            self._still = (there, drawn)
        return self._still[1]

    def _deep(self, behind: Backdrop, corners: Floats) -> Owners:
        """The triangles that the depth picture sees: the colour picture's, where that has them."""
        if not self._wider:
            return np.ascontiguousarray(self._owner[self._rows[:, None], self._columns])
        width, height = self.lens.size
        nearest = np.zeros((height, width), dtype=np.float32)
        deep = np.full((height, width), -1, dtype=np.int32)
        still = seen_from(behind.mesh.corners, self.lens)
        cover(still, self.lens.values, nearest, deep, 0)
        cover(corners, self.lens.values, nearest, deep, len(behind.mesh.parts))
        return deep

    def _worn(self, snapshot: Snapshot) -> Worn:
        turns = Rotation.from_quat(snapshot.boxes[:, 3:], scalar_first=True).as_matrix()
        poses = [
            Pose.from_arrays(at, turn)
            for at, turn in zip(snapshot.boxes[:, :3], turns, strict=True)
        ]
        seen = self.mount.cell_from_camera.inverse
        return self._wear.seen_from([seen @ pose for pose in poses], self.mount.cell_from_camera)

    def _looks(self, before: Before) -> Looks:
        atlas, faces = self._scene.atlas, before.faces
        fields = fields_of(before.mesh, before.corners, atlas, self._light.on(before.mesh))
        printed = faces >= 0
        fields[printed, :2, 3] += self._wear.shifts[faces[printed]]
        return Looks(
            fields,
            before.mesh.skins,
            faces,
            atlas.table,
            atlas.texels,
            self._colour_lens.values,
            self._light.gains,
        )

    def _depth(
        self, owner: Owners, planes: Floats, faces: Ints, worn: Worn, random: np.random.Generator
    ) -> npt.NDArray[np.float32]:
        disparity = np.empty(owner.shape, dtype=np.float32)
        holes = np.empty(owner.shape, dtype=np.bool_)
        errors = DEPTH[self.severity]
        limits = np.array([self._sensor.scale, errors.flattest, errors.glare])
        disparities(owner, planes, faces, worn, self.lens.values, limits, disparity, holes)
        return self._sensor.measured(disparity, holes, random)


def _nearest_pixels(colour: Lens, depth: Lens) -> tuple[Ints, Ints]:
    """The colour picture's column and row that lie nearest to each of the depth picture's.

    Both look the same way; where the depth picture is wider they lie outside of the colour's.
    """
    found = []
    for axis in range(2):
        rays = (np.arange(depth.size[axis]) - depth.centre[axis]) / depth.focal[axis]
        pixels = np.rint(rays * colour.focal[axis] + colour.centre[axis])
        found.append(pixels.astype(np.int64))
    return found[0], found[1]
