"""The cell in three dimensions: what stands is drawn once, what moves is moved."""

import math
from collections.abc import Iterable

from nicegui import ui
from nicegui.elements.scene.scene_object3d import Object3D

from depal.domain import Capsule, CellLayout
from depal.geometry import OrientedBox, Pose, Vector3
from depal.server.cellstate import CellState
from depal.server.screen.boxshape import BoxShape, label_look, turn_of
from depal.server.screen.grip import Grip
from depal.server.screen.panels.marks import TINTS, Mark
from depal.server.screen.plan import Drawn, pile_of
from depal.server.screen.posture import LinkPose, Turn, posture
from depal.server.screen.words import Words, place_name

ZONE = "#c2410c"
FLOOR, WOOD, STEEL, ARM, JOINT, FIXED = (
    "#d3d7db", "#b9a88c", "#9aa1a8", "#7d868f", "#59626b", "#8b9299",
)  # fmt: skip
BACKGROUND = "#e6e9ec"

LINKS = 7
"""The base and six more; after them comes the tool."""

EYE, AIM = (-2.3, -1.7, 4.5), (0.75, 0.0, 0.35)
"""Where one looks from, and at what [m]."""


def rows(turn: Iterable[Iterable[float]]) -> list[list[float]]:
    """As the browser wants it."""
    return [[round(value, 5) for value in row] for row in turn]


class CellScene:
    """The picture, kept like the cell."""

    def __init__(self, layout: CellLayout, words: Words) -> None:
        """Draws what never moves."""
        self._layout, self._words = layout, words
        self._boxes: dict[str, BoxShape] = {}
        self._held: tuple[str, Object3D] | None = None
        self._grip = Grip()
        self._joints: tuple[float, ...] | None = None
        camera = ui.scene.perspective_camera(fov=42)
        with ui.scene(
            400, 300, grid=False, camera=camera, background_color=BACKGROUND, click_events=[]
        ) as self.element:
            self._draw_still()
            self._links = [self._draw_link(number) for number in range(LINKS + 1)]
        self.element.move_camera(*EYE, *AIM, duration=0)
        self._pose(posture(layout.robot, ()))

    def show(self, state: CellState) -> None:
        """Makes the picture as the cell is."""
        poses = posture(self._layout.robot, state.joints)
        self._show_boxes(state)
        if state.joints and state.joints != self._joints:
            self._joints = state.joints
            self._pose(poses)
        self._show_held(state, poses)

    # What never moves

    def _draw_still(self) -> None:
        (left, low), (right, high) = self._layout.floor
        middle = ((left + right) / 2, (low + high) / 2, -0.02)
        size = (right - left, high - low, 0.04)
        self._block(middle, size, turn_of(0.0), FLOOR)
        pallet = self._layout.pallet
        length, width, deck = pallet.size
        centre = pallet.cell_from_pallet.apply((length / 2, width / 2, -deck / 2))
        turn = rows(pallet.cell_from_pallet.rotation)
        self._block(centre, (length, width, deck), turn, WOOD, edges="#8f7f63")
        for storage in self._layout.storages:
            for panel in storage.panels:
                self._panel(storage.cell_from_storage, panel)
            before = storage.cell_from_storage.apply((-0.15, 0.0, 0.05))
            label = label_look("#9aa1a8", "#f4f5f6", "#3a4148")
            self.element.text(place_name(storage.id, self._words), label).move(*before)
        for fixture in self._layout.fixtures:
            self._block(fixture.centre, fixture.size, rows(fixture.pose.rotation), FIXED)
        for zone in self._layout.zones:
            outline = self.element.box(*zone.solid.size, wireframe=True).material(ZONE)
            outline.move(*zone.solid.centre).rotate_R(rows(zone.solid.pose.rotation))

    def _panel(self, pose: Pose, panel: OrientedBox) -> None:
        turn = _times(pose.rotation, panel.pose.rotation)
        solid = self._block(
            pose.apply(panel.centre), panel.size, rows(turn), STEEL, edges="#7b838b"
        )
        solid.material(STEEL, 0.16)

    def _block(
        self, centre: Vector3, size: Vector3, turn: list[list[float]], fill: str, edges: str = ""
    ) -> Object3D:
        solid = self.element.box(*size).material(fill).move(*centre).rotate_R(turn)
        if edges:
            outline = self.element.box(*size, wireframe=True).material(edges)
            outline.move(*centre).rotate_R(turn)
        return solid

    # The arm

    def _draw_link(self, number: int) -> Object3D:
        """The base, links 1 to 6, and the tool on the flange."""
        with self.element.group() as group:
            for capsule in self._layout.robot.shapes:
                if capsule.link == number:
                    self._capsule(capsule)
            if number == LINKS:
                for part in self._layout.tool.shapes:
                    self._block(part.centre, part.size, rows(part.pose.rotation), JOINT)
        return group

    def _capsule(self, capsule: Capsule) -> None:
        start, end, radius = capsule.start, capsule.end, capsule.radius
        for place in {start, end}:
            self.element.sphere(radius, 20, 14).material(ARM).move(*place)
        length = math.dist(start, end)
        if length < radius / 10:
            return
        axis = tuple((b - a) / length for a, b in zip(start, end, strict=True))
        middle = tuple((a + b) / 2 for a, b in zip(start, end, strict=True))
        tube = self.element.cylinder(radius, radius, length, 20).material(ARM)
        tube.move(*middle).rotate_R(rows(_along(axis)))

    def _pose(self, poses: Iterable[LinkPose]) -> None:
        """All links in one message."""
        calls: list[list[object]] = []
        for group, pose in zip(self._links, poses, strict=True):
            group.x, group.y, group.z = (round(value, 4) for value in pose.origin)
            group.R = rows(pose.turn)
            calls.append(["move", group.id, group.x, group.y, group.z])
            calls.append(["rotate", group.id, group.R])
        self.element.run_method("run_methods", calls)

    # The boxes

    def _show_boxes(self, state: CellState) -> None:
        wanted = {f"pile {drawn.name}": drawn for drawn in pile_of(state)}
        for box in state.standing:
            wanted[f"place {box.box}"] = Drawn("", box.solid, Mark.PLAIN)
        for key in [key for key in self._boxes if key not in wanted]:
            self._boxes.pop(key).delete()
        for key, drawn in wanted.items():
            shape = self._boxes.get(key)
            if shape is not None and shape.becomes(drawn):
                continue
            self._boxes[key] = BoxShape(self.element, drawn)
            if shape is not None:
                shape.delete()

    def _show_held(self, state: CellState, poses: tuple[LinkPose, ...]) -> None:
        """A box in the gripper hangs on the flange as it did when it was taken."""
        held = self._grip.follow(state, poses[-1])
        if self._held is not None and (held is None or self._held[0] != held.box):
            self._held[1].delete()
            self._held = None
        if held is None or self._held is not None:
            return
        flange = self._links[-1]
        tint = TINTS[Mark.TARGET]
        with flange, self.element.group() as group:
            self.element.box(*held.size).material(tint.fill)
            self.element.box(*held.size, wireframe=True).material(tint.line)
            look = label_look(tint.line, tint.fill, tint.text)
            self.element.text(held.box, look).move(0.0, 0.0, held.size[2] / 2)
        group.move(*held.origin).rotate_R(rows(held.turn))
        self._held = (held.box, group)


def _times(a: Turn, b: Turn) -> Turn:
    found = [
        tuple(sum(a[row][k] * b[k][column] for k in range(3)) for column in range(3))
        for row in range(3)
    ]
    return found[0], found[1], found[2]  # type: ignore[return-value]


def _along(axis: Iterable[float]) -> Turn:
    """A rotation that carries y, a cylinder's axis, to a direction."""
    x, y, z = axis
    other = (1.0, 0.0, 0.0) if abs(x) < abs(y) + abs(z) else (0.0, 0.0, 1.0)
    side = _cross((x, y, z), other)
    length = math.hypot(*side)
    u = (side[0] / length, side[1] / length, side[2] / length)
    v = _cross(u, (x, y, z))
    return (u[0], x, v[0]), (u[1], y, v[1]), (u[2], z, v[2])


def _cross(a: Vector3, b: Vector3) -> Vector3:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
