"""What is true of a scene."""

import itertools
import math
from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from depal.domain import CellLayout, Gtin
from depal.geometry import OrientedBox, Pose, prisms_of
from depal.selection import PERCEIVED, Tolerances
from depal.selection.relations import A_BEFORE_B, B_BEFORE_A, CLASH, relate
from depal.simulation.imaging.lens import Lens

Floats = npt.NDArray[np.float64]
Parts = npt.NDArray[np.int64]

GRID = 16
"""A face is asked about at so many points along both edges."""

STEEPEST = math.radians(70)
"""A camera that sees a face farther from its normal does not count."""

ENOUGH = 0.7
"""A face counts as visible when so much of it is seen."""

STANDS = 0.005
"""A box stands on another when its bottom is within this of the other's top [m]."""


@dataclass(frozen=True, slots=True)
class TrueFace:
    """A front or a top face.

    Attributes:
        cell_from_face: its middle; x to the right, y down (of a top: to the viewer), z into the
            box.
        size: width and height [m].
        seen: by each camera the share of it that nothing hides and the picture holds.
        angles: between its normal and the way to each camera [rad].
        visible: the share of it that any camera sees within `STEEPEST` of its normal.
    """

    cell_from_face: Pose
    size: tuple[float, float]
    seen: tuple[float, ...]
    angles: tuple[float, ...]
    visible: float

    @property
    def counts(self) -> bool:
        """Whether enough of it is visible to be found."""
        return self.visible >= ENOUGH

    @property
    def corners(self) -> Floats:
        """Upper left, upper right, lower right, lower left as seen: (4, 3) in the cell [m]."""
        half = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) / 2
        local = half * (*self.size, 0.0)
        turn = np.array(self.cell_from_face.rotation)
        return np.asarray(local @ turn.T + np.array(self.cell_from_face.translation))


@dataclass(frozen=True, slots=True)
class TrueBox:
    """A box that stands there.

    Attributes:
        shape: in the cell frame.
        gtin: its product.
        foreign: whether the product is on no note and in no picture book.
        front: the face that looks to the robot.
        top: the face that looks up.
    """

    shape: OrientedBox
    gtin: Gtin
    foreign: bool
    front: TrueFace
    top: TrueFace


@dataclass(frozen=True, slots=True)
class Truth:
    """All that is true of a scene.

    Attributes:
        boxes: those that stand there.
        on_top: (a, b): box a stands on box b.
        occludes: (a, b): box a hides box b from the robot (section II-C).
    """

    boxes: tuple[TrueBox, ...]
    on_top: frozenset[tuple[int, int]]
    occludes: frozenset[tuple[int, int]]


def front_and_top(shape: OrientedBox, outward: Floats) -> tuple[Pose, Pose]:
    """`cell_from_face` of the faces of a box that look along `outward` and up."""
    axes = np.array(shape.pose.rotation)
    up = int(np.abs(axes[2]).argmax())
    facing = axes.T @ outward
    facing[up] = 0.0
    side = int(np.abs(facing).argmax())
    above = axes[:, up] * math.copysign(1.0, axes[2, up])
    normal = axes[:, side] * math.copysign(1.0, facing[side])
    right = np.cross(above, normal)
    half, centre = np.array(shape.size) / 2, np.array(shape.centre)
    return (
        Pose.from_arrays(centre + normal * half[side], np.column_stack((right, -above, -normal))),
        Pose.from_arrays(centre + above * half[up], np.column_stack((right, normal, -above))),
    )


def outward_of(layout: CellLayout) -> Floats:
    """The direction in which the pallet's front looks."""
    return -np.array(layout.pallet.cell_from_pallet.rotation)[:, 1]


def seen_faces(
    shapes: list[OrientedBox], layout: CellLayout, views: list[tuple[Lens, Parts]]
) -> list[tuple[TrueFace, TrueFace]]:
    """Front and top of each box, and how much of them the cameras see.

    Args:
        shapes: box i is part i in the pictures.
        layout: tells where the front is.
        views: each camera's lens, and the part that each of its pixels sees.
    """
    outward = outward_of(layout)
    poses = [pose for shape in shapes for pose in front_and_top(shape, outward)]
    sizes = [_extent(shapes[k // 2], pose) for k, pose in enumerate(poses)]
    shares, angles = [], []
    union = np.zeros((len(poses), GRID * GRID), dtype=np.bool_)
    for lens, parts in views:
        seen, angle = _seen(poses, sizes, lens, parts)
        shares.append(seen.mean(axis=1))
        angles.append(angle)
        union |= seen & (angle <= STEEPEST)[:, None]
    faces = [
        TrueFace(
            pose,
            sizes[k],
            tuple(float(share[k]) for share in shares),
            tuple(float(angle[k]) for angle in angles),
            float(union[k].mean()),
        )
        for k, pose in enumerate(poses)
    ]
    return list(zip(faces[::2], faces[1::2], strict=True))


def _extent(shape: OrientedBox, face: Pose) -> tuple[float, float]:
    turn = np.abs(np.array(face.rotation).T @ np.array(shape.pose.rotation))
    width, height, _ = (turn @ np.array(shape.size)).tolist()
    return width, height


def _seen(
    poses: list[Pose], sizes: list[tuple[float, float]], lens: Lens, parts: Parts
) -> tuple[npt.NDArray[np.bool_], Floats]:
    """Which points of a grid on each face a picture shows, (n, GRID^2); and angles (n,)."""
    steps = (np.arange(GRID) + 0.5) / GRID - 0.5
    u, v = (axis.ravel() for axis in np.meshgrid(steps, steps))
    turns = np.array([pose.rotation for pose in poses]).reshape(-1, 3, 3)
    shifts = np.array([pose.translation for pose in poses]).reshape(-1, 3)
    spans = np.array(sizes).reshape(-1, 2)
    points = shifts[:, None, :] + (
        turns[:, None, :, 0] * (u * spans[:, :1])[..., None]
        + turns[:, None, :, 1] * (v * spans[:, 1:])[..., None]
    )
    seen_from = lens.cell_from_camera.inverse
    local = points @ np.array(seen_from.rotation).T + np.array(seen_from.translation)
    z = np.maximum(local[..., 2], 1e-6)
    x = np.rint(local[..., 0] / z * lens.focal[0] + lens.centre[0]).astype(int)
    y = np.rint(local[..., 1] / z * lens.focal[1] + lens.centre[1]).astype(int)
    width, height = lens.size
    inside = (local[..., 2] > lens.near) & (x >= 0) & (x < width) & (y >= 0) & (y < height)
    part = parts[np.clip(y, 0, height - 1), np.clip(x, 0, width - 1)]
    eye = np.array(lens.cell_from_camera.translation)
    way = eye - shifts
    cosine = -(turns[:, :, 2] * way).sum(axis=1) / np.linalg.norm(way, axis=1)
    own = np.arange(len(poses)) // 2
    visible = inside & (part == own[:, None]) & (cosine > 0.0)[:, None]
    return visible, np.arccos(np.clip(cosine, -1.0, 1.0))


def relations_of(
    shapes: list[OrientedBox], tolerances: Tolerances = PERCEIVED
) -> tuple[frozenset[tuple[int, int]], frozenset[tuple[int, int]]]:
    """Which box stands on which, and which hides which from the robot.

    A box stands on another when its bottom touches the other's top over more than the tolerance's
    overlap in both directions. Hiding is `selection`'s relation, the same that orders the work.
    """
    prisms = prisms_of(shapes)
    on_top, occludes = set(), set()
    for a, b in itertools.combinations(range(len(shapes)), 2):
        code = relate(prisms, a, b, tolerances.overlap, tolerances.slack)
        if code & CLASH:
            continue
        if code & A_BEFORE_B:
            occludes.add((a, b))
        if code & B_BEFORE_A:
            occludes.add((b, a))
        for upper, lower in ((a, b), (b, a)):
            rise = prisms[upper, 2] - prisms[upper, 5] - prisms[lower, 2] - prisms[lower, 5]
            if abs(rise) <= STANDS and contact(prisms, upper, lower) > tolerances.overlap**2:
                on_top.add((upper, lower))
    return frozenset(on_top), frozenset(occludes)


def contact(prisms: Floats, a: int, b: int) -> float:
    """The area that the ground rectangles of two prisms share [m^2]."""
    kind, corners = cv2.rotatedRectangleIntersection(_ground(prisms[a]), _ground(prisms[b]))
    if kind == cv2.INTERSECT_NONE or corners is None:
        return 0.0
    return float(cv2.contourArea(cv2.convexHull(corners))) / 1e4


def _ground(row: Floats) -> tuple[tuple[float, float], tuple[float, float], float]:
    """A prism's rectangle on the ground as OpenCV takes it: middle, edges [cm], turn [degree]."""
    x, y, _, length, width, _, c, s = row.tolist()
    return (x * 100, y * 100), (length * 200, width * 200), math.degrees(math.atan2(s, c))
