"""Ways out of wherever the arm has come to rest: straight, with whatever the hand holds."""

from collections.abc import Iterator

import numpy as np

from depal.cell.planning.planner import Planner
from depal.cell.planning.promises import Promises
from depal.cell.workplace import Workplace
from depal.domain import Approach, Place
from depal.geometry import Pose, Vector3
from depal.motion.collision import Checker, Scene
from depal.motion.collision.values import Array
from depal.motion.grasping import Holding
from depal.motion.moves import OPEN, Kind, Part
from depal.motion.planning.straight import straight_as_far
from depal.ports import Trajectory

OUT = 0.55
"""The arm draws back this far beyond the depth at which it stands in a place [m]."""

UP, BACK, CLEAR = 0.03, 0.35, 0.30
"""From the pallet a box is raised so far before it is drawn back, an arm above it so far [m]."""

EDGE = 0.05
"""Before its opening and below its floor a place begins so early [m]."""

AROUND = 0.35
"""So near to the pallet's rectangle the arm may stand among boxes [m]."""


class Clearing:
    """Plans the first motions after a restart or a stop."""

    def __init__(self, work: Workplace, planner: Planner, promises: Promises) -> None:
        """Among what this cell believes to stand around."""
        self._work = work
        self._planner = planner
        self._promises = promises

    def ways_out(self) -> Iterator[Trajectory]:
        """Out of a place, or off the pallet; each begins where the one before has ended."""
        for shift in _ways_out(self._work, self._planner):
            motion = _along(self._work, self._planner, self._promises, shift)
            if motion is not None:
                yield motion


def _along(
    work: Workplace, planner: Planner, promises: Promises, shift: Vector3
) -> Trajectory | None:
    """Straight, no farther than until the arm can draw in; as far as it reaches."""
    held = work.held
    path = straight_as_far(planner.mover.body.kinematics, planner.here, shift)
    scene = promises.scene(work.pile, None if held is None else held.box, work.bounds.zones)
    checker = _checker(work, planner, scene)
    if len(work.pile) or _is_level(shift):  # above a pile that nobody has seen all the way counts
        path = path[: _open_row(planner, checker, path) + 1]
    path = _short_of(path, _checker(work, planner, scene.zones))
    if len(path) < 2:  # noqa: PLR2004 - a path has two ends
        return None
    parts = [Part(Kind.STRAIGHT, path, touching=True)]
    if held is None:
        return planner.timing.along(parts)
    holding = Holding.of(held.grasp, held.mass, work.layout.tool, size=held.size)
    return planner.timing.along(parts, holding) or planner.timing.slowly(parts[0])


def _open_row(planner: Planner, checker: Checker, path: Array) -> int:
    """The first row from which the arm can draw in: in a place nothing may be near, and it cannot.

    Where there is none, the first row at which nothing is near, or the last one.
    """
    for row, q in enumerate(path):
        if checker.free(q) and planner.mover.is_open(checker, q):
            return row
    first = checker.first_free(path)
    return len(path) - 1 if first is None else first


def _checker(work: Workplace, planner: Planner, scene: Scene) -> Checker:
    """The check for the hand as it is."""
    held = work.held
    if held is None:
        return planner.mover.checker(scene, OPEN, folded=work.ports.gripper.folded())
    return planner.mover.checker(scene, OPEN, held.grasp, held.size)


def _short_of(path: Array, zones: Checker) -> Array:
    """A way out that ends before it enters a zone, unless it begins in one."""
    hit = zones.first_hit(path)
    return path if hit is None or hit == 0 else path[:hit]


def _is_level(shift: Vector3) -> bool:
    return abs(shift[2]) < EDGE


def _ways_out(work: Workplace, planner: Planner) -> Iterator[Vector3]:
    """Shifts of the flange, in order; none where the arm stands in the open."""
    kinematics = planner.mover.body.kinematics
    flange = kinematics.flange(work.ports.arm.joints())
    tips = [flange, *_tips(work, flange)]
    for place in work.layout.places.values():
        inside = [place.cell_from_place.inverse.apply(tip.translation) for tip in tips]
        deepest = max((x for x, y, z in inside if _within(place, x, y, z)), default=None)
        if deepest is not None:
            x, y, z = (-(deepest + OUT) * row[0] for row in place.cell_from_place.rotation)
            yield (x, y, z)
            return
    if not any(_over_pallet(work, tip.translation) for tip in tips):
        return
    held = work.held
    if held is not None and held.grasp.approach is Approach.HORIZONTAL:
        yield (0.0, 0.0, UP)
        x, y, _ = (-BACK * row[0] for row in _face(work, flange).rotation)
        yield (x, y, 0.0)
    else:
        yield (0.0, 0.0, CLEAR)


def _tips(work: Workplace, flange: Pose) -> list[Pose]:
    """Where the tool ends and the held box has its middle, in the cell frame."""
    folded = work.ports.gripper.folded()
    tool, held = work.layout.tool, work.held
    tips = [flange @ tool.module(m.name, folded=folded).flange_from_face for m in tool.modules]
    return tips if held is None else [*tips, flange @ held.grasp.flange_from_box]


def _face(work: Workplace, flange: Pose) -> Pose:
    held = work.held
    name = work.layout.tool.modules[0].name if held is None else held.grasp.cups[0][0]
    folded = work.ports.gripper.folded()
    return flange @ work.layout.tool.module(name, folded=folded).flange_from_face


def _within(place: Place, x: float, y: float, z: float) -> bool:
    width, height = place.opening
    return -EDGE < x < place.depth and abs(y) < width / 2 and -EDGE < z < height


def _over_pallet(work: Workplace, point: Vector3) -> bool:
    stand = work.layout.pallet
    x, y, _ = stand.cell_from_pallet.inverse.apply(point)
    length, width, _ = stand.size
    middle = np.array([length / 2, width / 2])
    off = np.abs(np.array([x, y]) - middle) - middle
    return bool((off < AROUND).all())
