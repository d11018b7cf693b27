"""A whole cell as triangles, at any moment of its world."""

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from depal.domain import CellLayout, Tool
from depal.domain.robot import LINKS
from depal.geometry import OrientedBox, Pose
from depal.simulation.cases import Case
from depal.simulation.imaging import furniture
from depal.simulation.imaging.atlas import Atlas, AtlasBuilder
from depal.simulation.imaging.mesh import SIDES, Mesh, capsule, cuboid, joined
from depal.simulation.imaging.prints import PrintedBoxes
from depal.simulation.snapshot import Snapshot
from depal.simulation.world import World

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]

CUP_LENGTH = 0.03
"""A bellows reaches so far from its plate to the plane of touch [m]."""


@dataclass(frozen=True, slots=True, eq=False)
class Moment:
    """What moves, at one moment.

    Attributes:
        mesh: boxes, arm and tool in the cell frame.
        faces: (n,) the box's face `6 i + side` of each triangle, negative for arm and tool.
        lit: the light's picture of all things, by where the light stands; whoever needs it first
            draws it.
    """

    mesh: Mesh
    faces: Ints
    lit: dict[Pose, Floats] = field(default_factory=dict)


class CellScene:
    """Everything in a cell, its boxes printed; made once, then asked for any moment.

    Attributes:
        atlas: all textures.
        boxes: how many boxes there are; box i is part i in pictures.
        shapes: where the boxes stand in the beginning.
        walls: backs and sides of the storages.
    """

    def __init__(self, layout: CellLayout, cases: tuple[Case, ...]) -> None:
        """Draws the prints of all cases."""
        self.boxes = len(cases)
        self.shapes = [case.shape for case in cases]
        self._layout = layout
        builder = AtlasBuilder()
        prints = PrintedBoxes(builder)
        meshes = [prints.mesh(case.gtin, case.shape.size, i) for i, case in enumerate(cases)]
        arm = self.boxes
        self._unfolded, self._folded = arm + len(LINKS), arm + len(LINKS) + 1
        meshes += _arm(layout, builder, arm)
        dark, rubber = builder.plain((62, 66, 74)), builder.plain((38, 40, 44))
        for folded, part in ((False, self._unfolded), (True, self._folded)):
            meshes += _tool(layout.tool, dark, rubber, part, folded=folded)
        still = self._folded + 1
        meshes += _still(layout, builder, still)
        skins = {"trolley": builder.plain((150, 166, 186)), "shelf": builder.plain((172, 178, 176))}
        self._bays: dict[str, range] = {}
        self._parts, walls = still + 1, list[furniture.Wall]()
        for shelf in layout.storages:
            mesh, sides = furniture.storage(shelf, skins[shelf.kind.value], self._parts)
            self._bays[shelf.id] = range(self._parts, self._parts + 1 + len(sides))
            self._parts = self._bays[shelf.id].stop
            meshes.append(mesh)
            walls += sides
        self.walls = tuple(walls)
        self._mesh = joined(meshes)
        self._faces = _faces(self._mesh, self.boxes)
        self._moment: tuple[tuple[bytes, ...], Moment] | None = None
        self.atlas: Atlas = builder.build()

    def at(self, snapshot: Snapshot) -> Mesh:
        """Everything that is there at that moment, in the cell frame."""
        return self._placed(self._mesh.without(self._gone(snapshot)), snapshot)

    def moving(self, snapshot: Snapshot) -> "Moment":
        """Boxes, arm and tool at that moment; kept for the next camera that asks."""
        gone = self._gone(snapshot)
        key = (snapshot.boxes.tobytes(), snapshot.arm.tobytes(), gone.tobytes())
        if self._moment is None or self._moment[0] != key:
            kept = ~np.isin(self._mesh.parts, gone) & (self._mesh.parts <= self._folded)
            mesh = self._placed(self._mesh.chosen(kept), snapshot)
            self._moment = (key, Moment(mesh, self._faces[kept]))
        return self._moment[1]

    def still(self, snapshot: Snapshot) -> Mesh:
        """All the rest of what is there at that moment."""
        return self._mesh.without(self._gone(snapshot)).without(np.arange(self._folded + 1))

    def _gone(self, snapshot: Snapshot) -> Ints:
        """The parts that are not there."""
        gone = [*snapshot.removed, self._unfolded if snapshot.folded else self._folded]
        for name, trolley in snapshot.bays.items():
            if trolley is None:
                gone += self._bays[name]
        return np.array(gone)

    def _placed(self, mesh: Mesh, snapshot: Snapshot) -> Mesh:
        turns = np.broadcast_to(np.eye(3), (self._parts, 3, 3)).copy()
        shifts = np.zeros((self._parts, 3))
        moving = np.concatenate((snapshot.boxes, snapshot.arm, snapshot.arm[-1:]))
        turns[: len(moving)] = rotations(moving[:, 3:])
        shifts[: len(moving)] = moving[:, :3]
        return mesh.placed(turns, shifts)

    def mobile(self, mesh: Mesh) -> Mesh:
        """Of a moment's triangles the boxes, the arm and the tool alone."""
        return mesh.without(np.arange(self._folded + 1, self._parts))


class Stage:
    """The scene of a world, drawn when somebody first looks; reader and camera share it."""

    def __init__(self, world: World) -> None:
        """Nothing is drawn yet."""
        self.world = world
        self._scene: CellScene | None = None

    @property
    def scene(self) -> CellScene:
        """Everything in the world's cell."""
        if self._scene is None:
            self._scene = CellScene(self.world.layout, self.world.cases)
        return self._scene

    def now(self) -> Mesh:
        """The world as it stands."""
        return self.scene.at(self.snapshot())

    def snapshot(self) -> Snapshot:
        """Where everything is now."""
        return self.world.snapshot()


def rotations(quaternions: Floats) -> Floats:
    """(n, 3, 3) of unit quaternions (n, 4), w first."""
    w, x, y, z = quaternions.T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.asarray(np.array(rows).transpose(2, 0, 1))


def _faces(mesh: Mesh, boxes: int) -> Ints:
    """The box's face `6 i + side` of each triangle, negative for what is no box's."""
    normal = mesh.normals.mean(axis=1)
    axis = np.abs(normal).argmax(axis=1)
    behind = np.take_along_axis(normal, axis[:, None], axis=1)[:, 0] < 0.0
    return np.where(mesh.parts < boxes, mesh.parts * len(SIDES) + 2 * axis + behind, -1)


def _arm(layout: CellLayout, builder: AtlasBuilder, part: int) -> list[Mesh]:
    orange, grey = builder.plain((232, 122, 44)), builder.plain((74, 78, 86))
    last = len(LINKS) - 1
    return [
        capsule(
            shape.start,
            shape.end,
            shape.radius,
            grey if shape.link in {0, last} else orange,
            part + shape.link,
        )
        for shape in layout.robot.shapes
    ]


def _tool(tool: Tool, skin: int, rubber: int, part: int, *, folded: bool) -> list[Mesh]:
    shapes = tool.folded_shapes if folded else tool.shapes
    meshes = [cuboid(shape.size, (skin,), part).moved(shape.pose) for shape in shapes]
    radius = tool.suction.cup_radius * 0.8
    for name in [module.name for module in tool.modules]:
        module = tool.module(name, folded=folded)
        meshes += [
            capsule((-CUP_LENGTH, y, z), (-radius, y, z), radius, rubber, part).moved(
                module.flange_from_face
            )
            for y, z in module.cups
        ]
    return meshes


def _still(layout: CellLayout, builder: AtlasBuilder, part: int) -> list[Mesh]:
    ground, line = builder.plain((222, 221, 216)), builder.plain((226, 190, 70))
    wood, metal = builder.plain((196, 164, 118)), builder.plain((96, 100, 108))
    fixtures: list[OrientedBox] = list(layout.fixtures)
    return [
        furniture.floor(layout, ground, line, part),
        furniture.pallet(layout.pallet, wood, part),
        *(furniture.solid(shape, metal, part) for shape in fixtures),
        *furniture.fiducials(layout.fiducials, builder, part),
    ]
