"""What really stands before the cameras, as the referee of perception knows it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from depal.domain import CameraMount, Gtin
from depal.geometry import Blockers, OrientedBox, Pose
from depal.perception.faces import Facing

Floats = npt.NDArray[np.float64]

STEEPEST = math.radians(70)
"""A face that is seen at more than this from its normal is not seen."""

COUNTS = 0.7
"""A face of which less is seen need not be found."""

GRID = 16
"""A face is asked at so many points along both edges whether it is seen."""

BEFORE = 5e-4
"""These points lie so far before the face [m]."""

_SQUARE = np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)])


@dataclass(frozen=True, slots=True)
class TrueFace:
    """A face of a box that stands there.

    Attributes:
        facing: which way it looks.
        box: whose it is: an index.
        cell_from_face: its middle; x along its width, y down (or to the viewer), z into the box.
        size: width and height [m].
        visible: share of it that a camera sees: no box before it, not seen too flatly.
    """

    facing: Facing
    box: int
    cell_from_face: Pose
    size: tuple[float, float]
    visible: float = 1.0

    @property
    def counts(self) -> bool:
        """Whether it must be found."""
        return self.visible >= COUNTS

    @property
    def corners(self) -> Floats:
        """(4, 3) in the cell [m], around the face."""
        return corners_of(self.cell_from_face, self.size)


@dataclass(frozen=True, slots=True)
class TrueBox:
    """A box that stands there.

    Attributes:
        shape: in the cell frame.
        gtin: its product.
        stock: what it is made of and how much is printed on it, in a word.
        known: whether the store has pictures of the product.
        sibling: whether another product of its size differs from it in text or colour alone.
    """

    shape: OrientedBox
    gtin: Gtin
    stock: str = "printed"
    known: bool = True
    sibling: bool = False


@dataclass(frozen=True, slots=True)
class Truth:
    """A scene as it is.

    Attributes:
        boxes: all that stand there.
        faces: the front and the top of every box, with the share that the cameras see.
    """

    boxes: tuple[TrueBox, ...]
    faces: tuple[TrueFace, ...]


def truth_of(boxes: Sequence[TrueBox], cameras: Sequence[CameraMount]) -> Truth:
    """The faces of boxes, each with the share that any of the cameras sees."""
    blockers = Blockers.of(box.shape for box in boxes)
    faces = [face for index, box in enumerate(boxes) for face in front_and_top(index, box.shape)]
    seen = [replace(face, visible=_seen(face, cameras, blockers)) for face in faces]
    return Truth(tuple(boxes), tuple(seen))


def corners_of(cell_from_face: Pose, size: tuple[float, float]) -> Floats:
    """Upper left, upper right, lower right, lower left of a face: (4, 3) in the cell [m]."""
    flat = np.column_stack((_SQUARE * size, np.zeros(4)))
    turn = np.array(cell_from_face.rotation)
    return np.asarray(flat @ turn.T + np.array(cell_from_face.translation))


def front_and_top(index: int, shape: OrientedBox) -> tuple[TrueFace, TrueFace]:
    """The side that faces the robot most, and the top."""
    axes, size = np.array(shape.pose.rotation), np.array(shape.size)
    up = int(np.abs(axes[2]).argmax())
    flat = [axis for axis in range(3) if axis != up]
    front = max(flat, key=lambda axis: abs(axes[0, axis]))
    side = next(axis for axis in flat if axis != front)
    ahead = axes[:, front] * np.sign(axes[0, front])
    upward = axes[:, up] * np.sign(axes[2, up])
    right = np.cross(-upward, ahead)  # x = y cross z, with y down and z into the box
    middle = np.array(shape.pose.translation)
    return (
        TrueFace(
            Facing.FRONT,
            index,
            Pose.from_arrays(
                middle - ahead * size[front] / 2, np.column_stack((right, -upward, ahead))
            ),
            (float(size[side]), float(size[up])),
        ),
        TrueFace(
            Facing.TOP,
            index,
            Pose.from_arrays(
                middle + upward * size[up] / 2, np.column_stack((right, -ahead, -upward))
            ),
            (float(size[side]), float(size[front])),
        ),
    )


def _seen(face: TrueFace, cameras: Sequence[CameraMount], blockers: Blockers) -> float:
    """The share of a face that at least one camera sees."""
    points, outward = _points_of(face), -np.array(face.cell_from_face.rotation)[:, 2]
    seen = np.zeros(len(points), dtype=np.bool_)
    for camera in cameras:
        eye = np.array(camera.cell_from_camera.translation)
        sight = eye - points
        steep = sight @ outward >= math.cos(STEEPEST) * np.linalg.norm(sight, axis=1)
        asked = np.flatnonzero(steep & ~seen & _in_picture(points, camera))
        if len(asked):
            starts = np.ascontiguousarray(np.broadcast_to(eye, (len(asked), 3)))
            seen[asked] = ~blockers.between(starts, points[asked])
    return float(seen.mean())


def _points_of(face: TrueFace) -> Floats:
    """A grid just before a face, (GRID^2, 3) in the cell [m]."""
    steps = (np.arange(GRID) + 0.5) / GRID - 0.5
    u, v = np.meshgrid(steps * face.size[0], steps * face.size[1])
    local = np.column_stack((u.ravel(), v.ravel(), np.full(GRID * GRID, -BEFORE)))
    pose = face.cell_from_face
    return np.asarray(local @ np.array(pose.rotation).T + np.array(pose.translation))


def _in_picture(points: Floats, camera: CameraMount) -> npt.NDArray[np.bool_]:
    """Which points lie in both pictures of a camera."""
    camera_from_cell = camera.cell_from_camera.inverse
    x, y, z = (
        points @ np.array(camera_from_cell.rotation).T + np.array(camera_from_cell.translation)
    ).T
    reach = math.tan(camera.vertical_view / 2) * np.maximum(z, 0.0)
    width = min(w / h for w, h in (camera.colour_size, camera.depth_size))
    return np.asarray((z > 0) & (np.abs(y) <= reach) & (np.abs(x) <= reach * width))
