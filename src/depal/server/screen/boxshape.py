"""A box in the three-dimensional picture: moved and marked anew, and drawn anew only if it must."""

import math

from nicegui import ui
from nicegui.elements.scene.scene_object3d import Object3D

from depal.server.cellstate import Solid
from depal.server.screen.panels.marks import SHAPES, TINTS, Mark
from depal.server.screen.plan import Drawn

STILL, SAME = 0.003, 0.01
"""Nearer than that a box has not moved, and its size is the same [m]."""

RIM = 0.015
"""The outline of a marked box is so much larger [m]."""

LABEL = (
    "font:600 14px/1.2 Roboto,system-ui,sans-serif;padding:1px 6px;border-radius:4px;"
    "border:1.5px solid {line};background:{fill};color:{text};white-space:nowrap"
)


def label_look(line: str, fill: str, text: str) -> str:
    """The style of a name in the picture."""
    return LABEL.format(line=line, fill=fill, text=text)


def turn_of(yaw: float) -> list[list[float]]:
    """A rotation about z, by rows."""
    c, s = math.cos(yaw), math.sin(yaw)
    return [[round(c, 5), round(-s, 5), 0.0], [round(s, 5), round(c, 5), 0.0], [0.0, 0.0, 1.0]]


class BoxShape:
    """Solid, edges, and a mark where it has one."""

    def __init__(self, scene: ui.scene, drawn: Drawn) -> None:
        """Draws it.

        Args:
            scene: the picture.
            drawn: the box.
        """
        self._scene, self._drawn = scene, drawn
        tint = TINTS[drawn.mark]
        with scene.group() as self._group:
            self._solid = scene.box(*drawn.solid.size).material(tint.fill)
            self._edges = scene.box(*drawn.solid.size, wireframe=True).material(tint.line)
        self._sign: Object3D | None = None
        self._place(drawn.solid)
        self._show_sign()

    def becomes(self, drawn: Drawn) -> bool:
        """The same box as it is now.

        Returns:
            False where it has another size and must be drawn anew.
        """
        before = self._drawn
        if math.dist(before.solid.size, drawn.solid.size) > SAME:
            return False
        if drawn.mark is not before.mark or drawn.name != before.name:
            tint = TINTS[drawn.mark]
            self._solid.material(tint.fill)
            self._edges.material(tint.line)
            self._drawn = Drawn(drawn.name, before.solid, drawn.mark)
            self._show_sign()
        moved = math.dist(before.solid.centre, drawn.solid.centre) > STILL
        if moved or abs(before.solid.yaw - drawn.solid.yaw) > SAME:
            self._drawn = drawn
            self._place(drawn.solid)
        return True

    def delete(self) -> None:
        """It stands there no more."""
        self._group.delete()

    def _place(self, solid: Solid) -> None:
        self._group.move(*solid.centre).rotate_R(turn_of(solid.yaw))

    def _show_sign(self) -> None:
        if self._sign is not None:
            self._sign.delete()
            self._sign = None
        drawn = self._drawn
        if drawn.mark is Mark.PLAIN:
            return
        tint, (x, y, z) = TINTS[drawn.mark], drawn.solid.size
        with self._group, self._scene.group() as self._sign:
            rim = self._scene.box(x + RIM, y + RIM, z + RIM, wireframe=True)
            rim.material(tint.line)
            word = f"{SHAPES[drawn.mark]} {drawn.name}".strip()
            look = label_look(tint.line, tint.fill, tint.text)
            self._scene.text(word, look).move(-x / 2, 0.0, z / 4)
