"""The ways to hold one box, best first."""

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.domain import FRONT, LOWER, Approach, Cup, Grasp, Tool
from depal.geometry import OrientedBox, Pose, Vector3
from depal.motion.grasping.holding import Groups, static_share

RIM = 0.005
"""A cup that is switched on stays this far inside the edges of the face [m]."""

ENOUGH = 0.95
"""A grasp that uses more than this share of what is counted on is not offered."""

MOST = 24
"""So many grasps are offered at the most."""

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class _Face:
    """A face of a box: its frame in the box's, x into the box, z as near up as it gets."""

    box_from_face: Pose
    width: float
    height: float


@dataclass(frozen=True, slots=True)
class _Plate:
    """Cups in one plane: the front module, the lower one, or both when it is folded up."""

    modules: tuple[str, ...]
    folded: bool
    flange_from_face: Pose
    cups: tuple[tuple[Cup, tuple[float, float]], ...]


def grasps(box: OrientedBox, mass: float, tool: Tool, front: Vector3) -> tuple[Grasp, ...]:
    """Every useful way to hold a box, best first.

    Args:
        box: in the cell frame, standing upright.
        mass: of the box [kg].
        tool: the gripper.
        front: towards the robot, horizontal, in the cell frame.

    Returns:
        Grasps whose suction holds the box still with the planner's safety; horizontal ones touch
        the side that faces `front`, vertical ones the top. Few cups, tight moments and turned
        tools come late.
    """
    found: list[tuple[float, int, Grasp]] = []
    known: Groups = {}
    for approach, face in _faces(box, front):
        for plate in _plates(tool, approach):
            for order, grasp in _on_face(approach, face, plate, tool):
                share = static_share(grasp, mass, tool, known)
                if share <= ENOUGH:
                    found.append((share + 0.12 * order, len(found), grasp))
    found.sort(key=lambda entry: entry[:2])
    return tuple(_spread(grasp for _, _, grasp in found))


def refusal(size: Vector3, mass: float, tool: Tool, payload: float) -> str:
    """Why a box cannot be held at all, in words; empty where it can.

    Args:
        size: of the box standing upright [m].
        mass: [kg].
        tool: the gripper.
        payload: what the flange may carry, tool included [kg].
    """
    if mass > payload - tool.mass:
        left = payload - tool.mass
        return f"{mass:g} kg is more than the arm carries beside its tool ({left:g} kg)"
    cup = 2 * (tool.suction.cup_radius + RIM)
    if sorted(size)[1] < cup:
        return f"no side is wide enough for a cup of {1000 * cup:.0f} mm with its rim"
    turned = (size, (size[1], size[0], size[2]))
    for one in turned:
        if grasps(OrientedBox.upright((0.0, 0.0, 0.0), one), mass, tool, (-1.0, 0.0, 0.0)):
            return ""
    return f"{mass:g} kg is more than the cups hold on its sides with safety {tool.safety:g}"


def _spread(ordered: Iterator[Grasp]) -> list[Grasp]:
    """The first of all, but not more than half of them of one approach."""
    kept: list[Grasp] = []
    counts = dict.fromkeys(Approach, 0)
    for grasp in ordered:
        if counts[grasp.approach] < MOST // 2:
            counts[grasp.approach] += 1
            kept.append(grasp)
    return kept


def _faces(box: OrientedBox, front: Vector3) -> Iterator[tuple[Approach, _Face]]:
    rotation = np.array(box.pose.rotation)
    toward = rotation.T @ np.array(front)  # in the box's frame
    axis = int(np.argmax(np.abs(toward[:2])))
    sign = 1.0 if toward[axis] > 0 else -1.0
    normal = np.zeros(3)
    normal[axis] = sign
    yield Approach.HORIZONTAL, _face(box.size, normal, np.array([0.0, 0.0, 1.0]))
    # The top, with the face's z away from the robot: the tool reaches over the box from the front.
    yield Approach.VERTICAL, _face(box.size, np.array([0.0, 0.0, 1.0]), -normal)


def _face(size: Vector3, normal: Floats, up: Floats) -> _Face:
    x, z = -normal, up
    y = np.cross(z, x)
    lengths = np.array(size)
    centre = normal * lengths / 2
    pose = Pose.from_arrays(centre, np.column_stack((x, y, z)))
    return _Face(pose, float(np.abs(y) @ lengths), float(np.abs(z) @ lengths))


def _plates(tool: Tool, approach: Approach) -> Iterator[_Plate]:
    def plate(names: tuple[str, ...], *, folded: bool) -> _Plate:
        flange_from_face = tool.module(names[0], folded=folded).flange_from_face
        back = flange_from_face.inverse
        cups: list[tuple[Cup, tuple[float, float]]] = []
        for name in names:
            module = tool.module(name, folded=folded)
            for index, (y, z) in enumerate(module.cups):
                _, u, v = back.apply(module.flange_from_face.apply((0.0, y, z)))
                cups.append(((name, index), (u, v)))
        return _Plate(names, folded, flange_from_face, tuple(cups))

    if approach is Approach.VERTICAL:
        yield plate((LOWER,), folded=False)
        return
    yield plate((FRONT,), folded=False)
    yield plate((FRONT, LOWER), folded=True)


def _on_face(
    approach: Approach, face: _Face, plate: _Plate, tool: Tool
) -> Iterator[tuple[float, Grasp]]:
    """Rolls and offsets of a plate on a face, each with its demerit."""
    radius = tool.suction.cup_radius + RIM
    for roll in range(4):
        turn = _roll(roll)
        centres = np.array([turn @ np.array([0.0, *at]) for _, at in plate.cups])[:, 1:]
        seen: set[tuple[int, ...]] = set()
        for demerit, (du, dv) in _offsets(centres, face, radius):
            at = centres + np.array((du, dv))
            inside = (np.abs(at[:, 0]) <= face.width / 2 - radius + 1e-9) & (
                np.abs(at[:, 1]) <= face.height / 2 - radius + 1e-9
            )
            rows = tuple(np.flatnonzero(inside).tolist())
            if not rows or (*rows, round(1000 * du), round(1000 * dv)) in seen:
                continue
            seen.add((*rows, round(1000 * du), round(1000 * dv)))
            box_from_plate = face.box_from_face @ Pose.from_arrays((0.0, du, dv), turn)
            grasp = Grasp(
                approach,
                plate.folded,
                box_from_plate @ plate.flange_from_face.inverse,
                tuple(plate.cups[row][0] for row in rows),
            )
            yield demerit + _TURNED[roll] + 1.5 * plate.folded, grasp


_TURNED = (0.0, 2.0, 1.0, 2.0)
"""What a roll by 0, 90, 180, 270 degrees costs in the order."""


def _roll(quarter: int) -> Floats:
    c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[quarter]
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def _offsets(
    centres: Floats, face: _Face, radius: float
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
