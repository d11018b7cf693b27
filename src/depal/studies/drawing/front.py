"""The front elevation: boxes as the robot sees them, +y to the left, z up."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

from depal.geometry import Vector3
from depal.studies.drawing.lettering import SMALL, write
from depal.studies.drawing.palette import LINE
from depal.studies.drawing.view import Array

MIDDLE = replace(SMALL, across="center")

RULER = 0.85
"""The room that the rulers take at the left and below [in]."""

MARK_GAP = 0.7
"""Between two numbers of a ruler, at least [in]."""

Spot = tuple[float, float]
"""A point of the picture [m]: across to the right, up."""


@dataclass(frozen=True, slots=True)
class SeenBox:
    """A box in front of the robot; the frame's x points away from the robot.

    Attributes:
        label: its name; a number at its end becomes an index, as in "b4".
        centre: its centre [m].
        size: its edges along x, y, z [m].
        before: its score before the request [m], where it has been scored.
        after: its score after the request [m], where it has been scored.
    """

    label: str
    centre: Vector3
    size: Vector3
    before: float | None = None
    after: float | None = None

    @property
    def near(self) -> float:
        """The x of its front side [m]."""
        return self.centre[0] - self.size[0] / 2


@dataclass(frozen=True, slots=True)
class Face:
    """A rectangle of the picture [m].

    Attributes:
        left: its left side.
        bottom: its lower side.
        width: across.
        height: up.
    """

    left: float
    bottom: float
    width: float
    height: float

    @property
    def right(self) -> float:
        """Its right side."""
        return self.left + self.width

    @property
    def top(self) -> float:
        """Its upper side."""
        return self.bottom + self.height

    @property
    def middle(self) -> Spot:
        """Its centre."""
        return self.left + self.width / 2, self.bottom + self.height / 2

    def holds(self, other: "Face") -> bool:
        """Whether another rectangle lies inside."""
        across = self.left <= other.left and other.right <= self.right
        return across and self.bottom <= other.bottom and other.top <= self.top

    def clearance(self, points: Array) -> Array:
        """How deep inside points (n, 2) lie, (n,); negative: how far outside."""
        beyond_x = np.maximum(self.left - points[:, 0], points[:, 0] - self.right)
        beyond_y = np.maximum(self.bottom - points[:, 1], points[:, 1] - self.top)
        outside = np.hypot(np.maximum(beyond_x, 0.0), np.maximum(beyond_y, 0.0))
        depth: Array = np.where(outside > 0.0, -outside, -np.maximum(beyond_x, beyond_y))
        return depth


def face_of(box: SeenBox, step: float = 0.0) -> Face:
    """The front side of a box in the picture.

    Args:
        box: the box.
        step: how far it is moved to the right and up, so that what stands behind shows [m].
    """
    _, y, z = box.centre
    _, width, height = box.size
    return Face(step - y - width / 2, step + z - height / 2, width, height)


def around(faces: Sequence[Face]) -> Face:
    """The smallest rectangle that holds all of them; there is at least one."""
    left, bottom = min(face.left for face in faces), min(face.bottom for face in faces)
    right, top = max(face.right for face in faces), max(face.top for face in faces)
    return Face(left, bottom, right - left, top - bottom)


def roomiest(face: Face, covers: Sequence[Face], cells: int = 41) -> tuple[Spot, float]:
    """The point of a rectangle with the most free room around it.

    Args:
        face: the rectangle.
        covers: rectangles that hide parts of it.
        cells: how finely it is searched, across and up; odd, so that the middle is tried.

    Returns:
        The point, and the radius of the circle that fits there [m]; not positive where all of
        it is hidden.
    """
    across = np.linspace(face.left, face.right, cells)
    up = np.linspace(face.bottom, face.top, cells)
    points = np.stack(np.meshgrid(across, up), axis=-1).reshape(-1, 2)
    room = face.clearance(points)
    for cover in covers:
        room = np.minimum(room, -cover.clearance(points))
    from_middle = np.hypot(*(points - face.middle).T)
    best = int(np.argmax(room - 1e-3 * from_middle))
    return (float(points[best, 0]), float(points[best, 1])), float(room[best])


def rulers(axes: Axes, load: Face, scale: float) -> None:
    """A ground line with y and a side line with z, for the nearest plane.

    Args:
        axes: a bare picture in metres.
        load: what the rulers measure.
        scale: of the picture [in/m].
    """
    gap, tick = 0.1 / scale, 0.05 / scale
    floor, side = load.bottom - gap, load.left - gap
    every = next((step for step in (0.1, 0.2, 0.5, 1.0) if step * scale > MARK_GAP), 2.0)
    lines = [((load.left, floor), (load.right, floor)), ((side, load.bottom), (side, load.top))]
    for across in _marks(load.left, load.right, every):
        lines.append(((across, floor), (across, floor - tick)))
        write(axes, (across, floor - 3.2 * tick), _number(-across), MIDDLE)
    for up in _marks(load.bottom, load.top, every):
        lines.append(((side, up), (side - tick, up)))
        write(axes, (side - 1.8 * tick, up), _number(up), replace(SMALL, across="right"))
    axes.add_collection(LineCollection(lines, colors=[LINE], linewidths=1.0, zorder=1))
    middle = (load.left + load.right) / 2
    write(axes, (middle, floor - 7.2 * tick), "y [m], positive to the robot's left", MIDDLE)
    at = side - 6.0 * tick - 0.12 / scale, (load.bottom + load.top) / 2
    write(axes, at, "z [m]", replace(SMALL, across="right"))


def _marks(start: float, end: float, every: float) -> list[float]:
    """The multiples of a step from start to end [m]."""
    first, last = math.ceil(start / every - 1e-6), math.floor(end / every + 1e-6)
    return [number * every for number in range(first, last + 1)]


def _number(value: float) -> str:
    """A length on a ruler [m]."""
    rounded = round(value, 1) + 0.0
    return f"{rounded:.1f}".replace("-", "\N{MINUS SIGN}")
