"""Perception without a picture: the boxes that the cameras would see, a little off.

It stands in for the camera behind the port `Sight` (`--perception truth`): what is hidden is not
told, poses are noisy, and some boxes are detected but not recognised.
"""

import asyncio
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.domain import CameraMount, Detection, Perceived, Recognition
from depal.executive.clock import Clock
from depal.geometry import Blockers, OrientedBox, Pose
from depal.ports import View
from depal.simulation.model import pallet_parts
from depal.simulation.referee import PALLET, Referee
from depal.simulation.witness import name_of
from depal.simulation.world import World

Floats = npt.NDArray[np.float64]

GRID = 8
"""A face is sampled by a grid of this many points along both edges."""

BEFORE = 0.001
"""Sample points lie so far before the face [m]."""

STEEP = 1e-3
"""A face seen flatter than this is not seen [m]."""


@dataclass(frozen=True, slots=True)
class SightSettings:
    """How good the perception is, and what it takes.

    Attributes:
        sigma: of the position, in each axis [m].
        turn_sigma: of the yaw [rad].
        cut: errors beyond this many sigmas do not occur.
        share: a box counts as seen when this share of its front or its top is visible.
        unrecognised: share of the boxes that are detected but not recognised.
        exposure: of one look [s].
        first: computing after the first look [s].
        later: computing after each later look [s].
    """

    sigma: float = 0.003
    turn_sigma: float = 0.3 * np.pi / 180
    cut: float = 2.5
    share: float = 0.2
    unrecognised: float = 0.1
    exposure: float = 0.5
    first: float = 1.2
    later: float = 0.5


class TruthSight:
    """A port `Sight` that knows the world."""

    def __init__(self, world: World, clock: Clock, settings: SightSettings | None = None) -> None:
        """The sight of this world, by its cell's cameras."""
        self._world, self._clock = world, clock
        self._settings = settings or SightSettings()
        self._referee = Referee(world)
        self._looks = 0
        shares = np.random.default_rng([world.seed, 3]).random(len(world.cases))
        self._known = shares >= self._settings.unrecognised

    async def look(self) -> View:
        """Looks at the pallet; exposure and computing take the time that is charged for them."""
        settings, number = self._settings, self._looks
        self._looks += 1
        await asyncio.sleep(settings.exposure)
        taken = self._clock.now()
        self._world.advance(taken)
        boxes = self.perceived(number)
        await asyncio.sleep(settings.later if number else settings.first)
        return View(taken, boxes)

    def perceived(self, number: int) -> tuple[Perceived, ...]:
        """What look `number` finds in the world as it stands."""
        random = np.random.default_rng([self._world.seed, 4, number])
        visible = self.visible_boxes()
        found: list[Perceived] = []
        for case in self._world.cases:
            error = self._error(random)  # drawn for every box, so that none depends on another
            if case.index not in visible:
                continue
            shape = OrientedBox(_shifted(self._world.box(case.index), error), case.shape.size)
            name = name_of(case.index)
            known = bool(self._known[case.index])
            found.append(Recognition(name, shape, case.gtin) if known else Detection(name, shape))
        return tuple(found)

    def visible_boxes(self) -> frozenset[int]:
        """The boxes on the pallet of which enough is visible from any camera."""
        boxes = [c.index for c in self._world.cases if self._referee.where(c.index) == PALLET]
        if not boxes:
            return frozenset()
        solids = _solids(self._world)
        cameras = self._world.layout.cameras
        return frozenset(
            box for box in boxes if any(self._share(box, camera, solids) for camera in cameras)
        )

    def _share(self, box: int, camera: CameraMount, solids: Blockers) -> bool:
        """Whether enough of a box's front or top is visible from a camera."""
        pose = self._world.box(box)
        half = np.array(self._world.cases[box].shape.size) / 2
        eye = np.array(camera.cell_from_camera.translation)
        for normal, axis in _front_and_top(pose):
            points = _face_points(pose, half, normal, axis)
            if float((eye - points[0]) @ normal) < STEEP:
                continue
            seen = ~solids.between(np.broadcast_to(eye, points.shape), points)
            seen &= _in_picture(points, camera)
            if seen.mean() >= self._settings.share:
                return True
        return False

    def _error(self, random: np.random.Generator) -> Floats:
        """Shift along x, y, z [m] and turn about z [rad]."""
        settings = self._settings
        cut = settings.cut
        draws = random.standard_normal(64)
        kept = draws[np.abs(draws) <= cut][:4]
        scale = np.array([settings.sigma] * 3 + [settings.turn_sigma])
        return np.asarray(kept * scale)


def _solids(world: World) -> Blockers:
    """Everything that can stand in the way."""
    layout, flange = world.layout, world.flange()
    parts = layout.tool.folded_shapes if world.suction.folded else layout.tool.shapes
    boxes = [OrientedBox(world.box(case.index), case.shape.size) for case in world.cases]
    boxes += [*pallet_parts(layout.pallet), *(part.seen_from(flange) for part in parts)]
    boxes += [
        panel.seen_from(storage.cell_from_storage)
        for storage in layout.storages
        if world.bays[storage.id] is not None
        for panel in storage.panels
    ]
    return Blockers.of(boxes, _arm(world))


def _arm(world: World) -> Floats:
    """The arm's capsules in the cell, (k, 7)."""
    rows = []
    model, data = world.model, world.data
    bodies = [model.mj.body("base").id, *model.arm_bodies.tolist()]
    for shape in world.layout.robot.shapes:
        turn = data.xmat[bodies[shape.link]].reshape(3, 3)
        ends = [
            data.xpos[bodies[shape.link]] + turn @ np.array(end) for end in (shape.start, shape.end)
        ]
        rows.append([*ends[0], *ends[1], shape.radius])
    return np.array(rows, dtype=float).reshape(-1, 7)


def _front_and_top(pose: Pose) -> list[tuple[Floats, int]]:
    """Outward normals, with their axes, of the side that faces the robot most and of the top."""
    axes = np.array(pose.rotation)
    up = int(np.abs(axes[2]).argmax())
    robot = -np.array([*pose.translation[:2], 0.0])
    towards = axes.T @ robot
    towards[up] = 0.0
    front = int(np.abs(towards).argmax())
    return [
        (axes[:, front] * (1.0 if towards[front] >= 0 else -1.0), front),
        (axes[:, up] * (1.0 if axes[2, up] >= 0 else -1.0), up),
    ]


def _face_points(pose: Pose, half: Floats, normal: Floats, axis: int) -> Floats:
    """A grid of points just before a face, (GRID^2, 3) in the cell [m]."""
    steps = (np.arange(GRID) + 0.5) / GRID * 2 - 1
    u, v = np.meshgrid(steps, steps)
    local = np.zeros((GRID * GRID, 3))
    first, second = [k for k in range(3) if k != axis]
    local[:, first], local[:, second] = u.ravel() * half[first], v.ravel() * half[second]
    points = local @ np.array(pose.rotation).T + np.array(pose.translation)
    return np.ascontiguousarray(points + normal * (half[axis] + BEFORE))


def _in_picture(points: Floats, camera: CameraMount) -> npt.NDArray[np.bool_]:
    """Which points the picture's frame holds."""
    seen = camera.cell_from_camera.inverse
    local = points @ np.array(seen.rotation).T + np.array(seen.translation)
    width, height = camera.depth_size
    reach = np.tan(camera.vertical_view / 2)
    depth = np.maximum(local[:, 2], STEEP)
    inside = (np.abs(local[:, 1]) <= depth * reach) & (local[:, 2] > STEEP)
    return np.asarray(inside & (np.abs(local[:, 0]) <= depth * reach * width / height))


def _shifted(pose: Pose, error: Floats) -> Pose:
    """A pose that is a little off."""
    x, y, z, turn = error.tolist()
    turned = Pose.from_yaw((0.0, 0.0, 0.0), turn) @ Pose(rotation=pose.rotation)
    a, b, c = pose.translation
    return Pose((a + x, b + y, c + z), turned.rotation)
