"""How a plate of cups fits on a face of a box: quarter turns, and shifts that bring cups on."""

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.domain import FRONT, LOWER, Approach, Cup, Grasp, Tool
from depal.geometry import OrientedBox, Pose, Vector3

RIM = 0.005
"""A cup that is switched on stays this far inside the edges of the face [m]."""

QUARTERS = ((1, 0), (0, 1), (-1, 0), (0, -1))
"""Cosine and sine of the quarter turns."""

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Face:
    """A face of a box.

    Attributes:
        approach: what touching it is called.
        box_from_face: its middle in the box's frame, x into the box, z as near up as it gets.
        width: along y [m].
        height: along z [m].
        depth: of the box behind it [m].
    """

    approach: Approach
    box_from_face: Pose
    width: float
    height: float
    depth: float


@dataclass(frozen=True, slots=True, eq=False)
class Plate:
    """Cups in one plane: the front module, the lower one, or both when it is folded up.

    Attributes:
        folded: whether the lower module is up.
        flange_from_face: the plane's frame.
        cups: their names.
        centres: (n, 2) in the plane's y and z [m].
    """

    folded: bool
    flange_from_face: Pose
    cups: tuple[Cup, ...]
    centres: Floats


@dataclass(frozen=True, slots=True)
class Way:
    """A plate on a face.

    Attributes:
        face: which.
        plate: which.
        roll: of the plate about the face's normal, in quarter turns.
        shift: of the plate's frame along the face's y and z [m].
        rows: the plate's cups that lie wholly on the face.
        demerit: how far from the plainest way.
    """

    face: Face
    plate: Plate
    roll: int
    shift: tuple[float, float]
    rows: tuple[int, ...]
    demerit: float

    def grasp(self) -> Grasp:
        """The same as the arm needs it."""
        box_from_plate = self.face.box_from_face @ Pose.from_arrays(
            (0.0, *self.shift), _roll(self.roll)
        )
        return Grasp(
            self.face.approach,
            self.plate.folded,
            box_from_plate @ self.plate.flange_from_face.inverse,
            tuple(self.plate.cups[row] for row in self.rows),
        )


def faces_of(box: OrientedBox, front: Vector3) -> Iterator[Face]:
    """The top of an upright box, and its side that faces the robot."""
    rotation = np.array(box.pose.rotation)
    toward = rotation.T @ np.array(front)  # in the box's frame
    axis = int(np.argmax(np.abs(toward[:2])))
    sign = 1.0 if toward[axis] > 0 else -1.0
    normal = np.zeros(3)
    normal[axis] = sign
    up = np.array([0.0, 0.0, 1.0])
    # The top first: of two equal ways hanging is the faster one. Its z points away from the robot,
    # for the tool reaches over the box from the front.
    yield _face(Approach.VERTICAL, box.size, up, -normal)
    yield _face(Approach.HORIZONTAL, box.size, normal, up)


def _face(approach: Approach, size: Vector3, normal: Floats, up: Floats) -> Face:
    x, z = -normal, up
    y = np.cross(z, x)
    lengths = np.array(size)
    centre = normal * lengths / 2
    pose = Pose.from_arrays(centre, np.column_stack((x, y, z)))
    width, height, depth = (float(np.abs(axis) @ lengths) for axis in (y, z, x))
    return Face(approach, pose, width, height, depth)


def plates_for(
    tool: Tool, approach: Approach, without: frozenset[str] = frozenset()
) -> Iterator[Plate]:
    """The plates that can touch a face: in front one module or both, on top the lower one.

    Args:
        tool: the gripper.
        approach: from the front or from above.
        without: modules that must not be used.
    """

    def plate(names: tuple[str, ...], *, folded: bool) -> Plate:
        flange_from_face = tool.module(names[0], folded=folded).flange_from_face
        back = flange_from_face.inverse
        cups: list[Cup] = []
        centres: list[tuple[float, float]] = []
        for name in names:
            module = tool.module(name, folded=folded)
            from_module = back @ module.flange_from_face
            for index, (y, z) in enumerate(module.cups):
                _, u, v = from_module.apply((0.0, y, z))
                cups.append((name, index))
                centres.append((u, v))
        return Plate(folded, flange_from_face, tuple(cups), np.array(centres))

    if approach is Approach.VERTICAL:
        offers: tuple[tuple[tuple[str, ...], bool], ...] = (((LOWER,), False),)
    else:
        offers = (((FRONT,), False), ((FRONT, LOWER), True))
    for names, folded in offers:
        left = tuple(name for name in names if name not in without)
        if left:
            yield plate(left, folded=folded)


def ways_on(face: Face, plate: Plate, tool: Tool) -> Iterator[Way]:
    """Rolls and offsets of a plate on a face, each with its demerit."""
    radius = tool.suction.cup_radius + RIM
    for roll in range(4):
        centres = plate.centres @ _roll(roll)[1:, 1:].T
        seen: set[tuple[int, ...]] = set()
        for demerit, (du, dv) in _offsets(centres, face, radius):
            at = np.abs(centres + np.array((du, dv)))
            inside = (at[:, 0] <= face.width / 2 - radius + 1e-9) & (
                at[:, 1] <= face.height / 2 - radius + 1e-9
            )
            rows = tuple(np.flatnonzero(inside).tolist())
            key = (*rows, round(1000 * du), round(1000 * dv))
            if not rows or key in seen:
                continue
            seen.add(key)
            turned = _TURNED[roll] + _FOLDED * plate.folded
            yield Way(face, plate, roll, (du, dv), rows, demerit + turned)


_TURNED = (0.0, 2.0, 1.0, 2.0)
"""What a roll by 0, 90, 180, 270 degrees costs in the order."""

_FOLDED = 1.5
"""What folding the lower module up costs in the order."""


def _roll(quarter: int) -> Floats:
    c, s = QUARTERS[quarter]
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def _offsets(
    centres: Floats, face: Face, radius: float
) -> Iterator[tuple[float, tuple[float, float]]]:
    """Shifts of the plate on the face: as many columns and rows as fit, in the middle or high."""
    along_u = _shifts(np.unique(centres[:, 0].round(6)), face.width / 2 - radius)
    along_v = _shifts(np.unique(centres[:, 1].round(6)), face.height / 2 - radius)
    for (mu, du), (mv, dv) in itertools.product(along_u, along_v):
        yield mu + mv, (du, dv)


def _shifts(lines: Floats, room: float) -> list[tuple[float, float]]:
    """Shifts that bring the most lines of cups into -room .. room, with their demerits."""
    if room < 0:
        return []
    for count in range(len(lines), 0, -1):
        shifts: list[tuple[float, float]] = []
        for first in range(len(lines) - count + 1):
            part = lines[first : first + count]
            low, high = float(part[0]), float(part[-1])
            if high - low > 2 * room + 1e-9:
                continue
            middle = -(low + high) / 2
            spare = room - (high - low) / 2
            shifts.append((0.3 * first, middle))
            if spare > 0.03:  # noqa: PLR2004 - worth a try of its own [m]
                shifts += [(0.5 + 0.3 * first, middle + spare), (0.6 + 0.3 * first, middle - spare)]
        if shifts:
            return shifts
    return []
