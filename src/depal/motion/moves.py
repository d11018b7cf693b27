"""Whole motions: to a box and off the pile with it, into a place and out again, to the reader.

Everything is a path of joint angles in named parts; when the arm is where, `timing` says. What
cannot be done comes back with its reason.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np

from depal.domain import Approach, CellLayout, Grasp
from depal.geometry import OrientedBox, Pose, Vector3
from depal.motion.collision import Body, Checker, Hand, Margins, Scene, Upright, held_box
from depal.motion.collision.values import Array
from depal.motion.planning.free import Effort, FreePlanner
from depal.motion.planning.straight import moved, straight

BEFORE = (0.10, 0.05)
"""A straight approach begins so far before the plane of touch, where the arm reaches [m]."""

LIFT = 0.008
"""A box is lifted by this before it is pulled out [m]."""

FURTHEST = 0.9
"""No straight move out is longer [m]."""

TILT = math.radians(25)
"""So far may a held box lean in free space [rad]."""

CLOSE = Margins(arm=0.02, tool=0.004, held=0.004, pile=-0.012, floor=0.01)
"""Near boxes, in straight parts: the held box may rub along cases, by the errors of its pose."""

ENTRY = Margins(arm=0.02, tool=0.005, held=0.004, pile=0.004, floor=0.01)
"""Going into a place: narrow, but clear."""

OPEN = Margins(arm=0.03, tool=0.015, held=0.015, pile=0.015, floor=0.02)
"""In free space."""

WIDE = Margins(arm=0.07, tool=0.08, held=0.07, pile=0.06, floor=0.02)
"""Where straight moves out had better end: room for a first turn."""


class Kind(Enum):
    """What a part of a path is."""

    FREE = "free"
    STRAIGHT = "straight"


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """A part of a path.

    Attributes:
        kind: free, with corners between which the axes move evenly, or a straight move.
        path: (n, 6) [rad]; it begins where the part before ended.
        touching: whether the held box may touch what it stands beside or on.
    """

    kind: Kind
    path: Array
    touching: bool = False


@dataclass(frozen=True, slots=True)
class NoMotion:
    """Why a motion is not possible.

    Attributes:
        reasons: of each way that was tried, the most frequent first, in words.
    """

    reasons: tuple[str, ...]

    def __str__(self) -> str:
        """In one line."""
        return "; ".join(self.reasons[:3]) or "no way to hold it"


@dataclass(frozen=True, slots=True, eq=False)
class Pick:
    """A box is taken off the pile.

    Attributes:
        grasp: how.
        approach: to the plane of touch.
        lift: straight up by a little, holding.
        out: straight out of the pile, holding.
    """

    grasp: Grasp
    approach: tuple[Part, ...]
    lift: Part
    out: Part


@dataclass(frozen=True, slots=True, eq=False)
class Put:
    """A held box is put into a place.

    Attributes:
        carry: to just above where it will stand.
        descent: straight down, further than needed: it is stopped by the load.
        retreat: straight out again, empty.
    """

    carry: tuple[Part, ...]
    descent: Part
    retreat: Part


class Mover:
    """Plans whole motions for the arm of one cell."""

    def __init__(self, layout: CellLayout) -> None:
        """For a cell."""
        self.layout = layout
        self.body = Body.of(layout)
        self._free = FreePlanner(self.body.kinematics, layout.robot.limits)
        self._speed = np.array(layout.robot.limits.speed)

    def checker(
        self,
        scene: Scene,
        margins: Margins,
        grasp: Grasp | None = None,
        size: Vector3 | None = None,
        *,
        folded: bool = False,
    ) -> Checker:
        """The check for an empty hand, or for one that holds a box by a grasp."""
        tool = self.layout.tool
        if grasp is None or size is None:
            return Checker(self.body, Hand.of(tool, folded=folded), scene, margins)
        hand = Hand.of(tool, folded=grasp.folded, held=held_box(grasp, size))
        up = np.array(grasp.box_from_flange.rotation)[2].tolist()
        return Checker(self.body, hand, scene, margins, Upright((up[0], up[1], up[2]), TILT))

    def pick(
        self,
        start: Array,
        box: OrientedBox,
        grasps: Sequence[Grasp],
        scene: Scene,
        name: str,
        effort: Effort,
    ) -> Pick | NoMotion:
        """To a box, and straight out of the pile with it.

        Args:
            start: (6,) where the arm is [rad].
            box: in the cell frame.
            grasps: ways to hold it, best first.
            scene: all that stands around, the box included under its name.
            name: of the box in the scene.
            effort: for free space.
        """
        without = scene.without(name)
        reasons: list[str] = []
        for grasp in grasps:
            found = self._pick_by(start, box, grasp, scene, without, effort, reasons)
            if found is not None:
                return found
        return NoMotion(_ranked(reasons))

    def _pick_by(
        self,
        start: Array,
        box: OrientedBox,
        grasp: Grasp,
        scene: Scene,
        without: Scene,
        effort: Effort,
        reasons: list[str],
    ) -> Pick | None:
        kinematics = self.body.kinematics
        touch = box.pose @ grasp.box_from_flange
        normal = _into(touch, grasp, self.layout)
        branches = self._branches(touch, start)
        if not len(branches):
            reasons.append(f"no reach for a {grasp.approach.value} grasp")
            return None
        near = self.checker(scene, CLOSE, folded=grasp.folded)
        holding = self.checker(without, CLOSE, grasp, box.size)
        clear = holding.with_margins(OPEN)
        empty = self.checker(scene, OPEN, folded=grasp.folded)
        for q in branches:
            tries = (straight(kinematics, q, _scaled(normal, -far)) for far in BEFORE)
            back = next((path for path in tries if path is not None), None)
            if back is None:
                reasons.append(f"no reach before the box for a {grasp.approach.value} grasp")
                continue
            if hit := near.why_along(back):
                reasons.append(hit)
                continue
            out = self._way_out(q, grasp, normal, holding, clear, reasons)
            if out is None:
                continue
            free = self._through(empty, start, back[-1:], effort, level=False)
            if free is None:
                reasons.append(f"no free way to a {grasp.approach.value} grasp")
                continue
            lift, leave = out
            approach = (Part(Kind.FREE, free), Part(Kind.STRAIGHT, back[::-1].copy()))
            return Pick(grasp, approach, lift, leave)
        return None

    def _way_out(
        self,
        touch: Array,
        grasp: Grasp,
        normal: Vector3,
        holding: Checker,
        clear: Checker,
        reasons: list[str],
    ) -> tuple[Part, Part] | None:
        """Lift, then straight out until the held box is clear of everything."""
        kinematics = self.body.kinematics
        lift = straight(kinematics, touch, (0.0, 0.0, LIFT), pitch=0.004)
        if lift is None:
            reasons.append("no reach to lift it")
            return None
        up = (0.0, 0.0, 1.0)
        ways = (up,) if grasp.approach is Approach.VERTICAL else (_scaled(normal, -1.0), up)
        for way in ways:
            leave = self._until_clear(lift[-1], way, holding, clear)
            if isinstance(leave, str):
                reasons.append(leave)
                continue
            return (
                Part(Kind.STRAIGHT, lift, touching=True),
                Part(Kind.STRAIGHT, leave, touching=True),
            )
        return None

    def _until_clear(
        self, start: Array, way: Vector3, holding: Checker, clear: Checker
    ) -> Array | str:
        """Straight along a direction until the strict check passes, and a little further."""
        return _until_clear(self._as_far_as(start, way, FURTHEST), holding, clear, "no way out")

    def _as_far_as(self, start: Array, way: Vector3, furthest: float) -> Array:
        """The straight move along a direction as far as the arm reaches."""
        length = furthest
        while length > 0.02:  # noqa: PLR2004 - nothing worth calling a move [m]
            path = straight(self.body.kinematics, start, _scaled(way, length))
            if path is not None:
                return path
            length *= 0.7
        return start[None, :]

    def put(
        self,
        lead: tuple[Part, ...],
        start: Array,
        grasp: Grasp,
        size: Vector3,
        into: Pose,
        target: Pose,
        depth: float,
        scene: Scene,
        lift: float,
        effort: Effort,
    ) -> Put | NoMotion:
        """With a held box into a place.

        Args:
            lead: parts that come before, ending at `start`: the way out of the pile.
            start: (6,) where free space begins [rad].
            grasp: how the box is held.
            size: of the box along its own axes [m].
            into: `cell_from_place`: x is the way in.
            target: `cell_from_box` where the box will stand.
            depth: how far in the box's outward face will be, plus the box's depth [m].
            scene: all that stands around, the held box left out.
            lift: how far above its spot the box is pushed in [m].
            effort: for free space.
        """
        kinematics = self.body.kinematics
        rotation = np.array(into.rotation)
        inward: Vector3 = tuple((rotation[:, 0]).tolist())  # type: ignore[assignment]
        above = moved(target, (0.0, 0.0, lift)) @ grasp.box_from_flange
        entry = self.checker(scene, ENTRY, grasp, size)
        clear = entry.with_margins(OPEN)
        reasons: list[str] = []
        branches = self._branches(above, start)
        if not len(branches):
            return NoMotion(("no reach to its spot",))
        for q in branches:
            if hit := entry.why(q):
                reasons.append(hit)
                continue
            back = self._out_of_place(q, inward, depth, entry, clear)
            if isinstance(back, str):
                reasons.append(back)
                continue
            down = straight(kinematics, q, (0.0, 0.0, -lift - 0.012), pitch=0.004)
            if down is None:
                reasons.append("no reach to set it down")
                continue
            free = self._through(clear, start, back[-1:], effort, level=True)
            if free is None:
                reasons.append("no free way to the place")
                continue
            low = straight(kinematics, q, (0.0, 0.0, -lift), pitch=0.004)
            away = self._retreat(
                low[-1] if low is not None else q, inward, grasp, size, scene, target
            )
            if isinstance(away, str):
                reasons.append(away)
                continue
            carry = (
                *lead,
                Part(Kind.FREE, free),
                Part(Kind.STRAIGHT, back[::-1].copy(), touching=True),
            )
            return Put(
                carry,
                Part(Kind.STRAIGHT, down, touching=True),
                Part(Kind.STRAIGHT, away),
            )
        return NoMotion(_ranked(reasons))

    def could_put(
        self, start: Array, grasp: Grasp, size: Vector3, target: Pose, scene: Scene, lift: float
    ) -> bool:
        """Whether the arm reaches over a spot at all: the cheap part of `put`."""
        above = moved(target, (0.0, 0.0, lift)) @ grasp.box_from_flange
        branches = self._branches(above, start)
        if not len(branches):
            return False
        entry = self.checker(scene, ENTRY, grasp, size)
        return any(entry.free(q) for q in branches)

    def _out_of_place(
        self, q: Array, inward: Vector3, depth: float, entry: Checker, clear: Checker
    ) -> Array | str:
        """From above the spot straight out until all is clear, at most out of the opening."""
        path = self._as_far_as(q, _scaled(inward, -1.0), depth + FURTHEST / 3)
        return _until_clear(path, entry, clear, "no way in")

    def _retreat(
        self, q: Array, inward: Vector3, grasp: Grasp, size: Vector3, scene: Scene, target: Pose
    ) -> Array | str:
        """Straight out with an empty hand until the tool is clear of everything."""
        with_box = scene.with_case("the box", OrientedBox(target, size))
        near = self.checker(with_box, ENTRY._replace(tool=0.002), folded=grasp.folded)
        clear = near.with_margins(OPEN)
        away = _scaled(inward, -1.0)
        return _until_clear(self._as_far_as(q, away, FURTHEST), near, clear, "no way back")

    def show(
        self,
        lead: tuple[Part, ...],
        start: Array,
        grasp: Grasp,
        size: Vector3,
        poses: Iterable[Pose],
        scene: Scene,
        effort: Effort,
    ) -> tuple[tuple[Part, ...], Pose] | NoMotion:
        """With a held box to the first pose of the flange that can be had.

        Args:
            lead: parts that come before, ending at `start`.
            start: (6,) where free space begins [rad].
            grasp: how the box is held.
            size: of the box [m].
            poses: of the flange, best first.
            scene: all that stands around, the held box left out.
            effort: for free space.
        """
        clear = self.checker(scene, OPEN, grasp, size)
        reasons: list[str] = []
        for pose in poses:
            branches = self._branches(pose, start)
            hits = [clear.why(q) for q in branches]
            reasons += [hit for hit in hits if hit]
            free = [q for q, hit in zip(branches, hits, strict=True) if not hit]
            if not len(branches):
                reasons.append("no reach to the reader")
            if not free:
                continue
            path = self._through(clear, start, np.stack(free), effort, level=True)
            if path is not None:
                return (*lead, Part(Kind.FREE, path)), pose
            reasons.append("no free way to the reader")
        return NoMotion(_ranked(reasons))

    def park(self, start: Array, scene: Scene, effort: Effort, *, folded: bool) -> Part | NoMotion:
        """With an empty hand to where the arm stands idle."""
        goal = np.array(self.layout.robot.parked)
        empty = self.checker(scene, OPEN, folded=folded)
        path = self._through(empty, start, goal[None, :], effort, level=False)
        return NoMotion(("no free way to park",)) if path is None else Part(Kind.FREE, path)

    def _through(
        self, checker: Checker, start: Array, goals: Array, effort: Effort, *, level: bool
    ) -> Array | None:
        found = self._free.plan(checker, start, goals, effort, level=level)
        return None if found is None else found.path

    def _branches(self, pose: Pose, near: Array) -> Array:
        """The configurations for a pose of the flange, the nearest in time first."""
        found = self.body.kinematics.solve(pose, near)
        if not len(found):
            return found
        times = (np.abs(found - near) / self._speed).max(axis=1)
        return found[np.argsort(times, kind="stable")]


def _into(touch: Pose, grasp: Grasp, layout: CellLayout) -> Vector3:
    """The direction of a grasp's approach, out of the plane of touch towards the box."""
    module = layout.tool.module(grasp.cups[0][0], folded=grasp.folded)
    turn = np.array(touch.rotation) @ np.array(module.flange_from_face.rotation)
    x, y, z = turn[:, 0].tolist()
    return (x, y, z)


def _until_clear(path: Array, near: Checker, clear: Checker, otherwise: str) -> Array | str:
    """The part of a straight move out that leaves everything behind.

    Args:
        path: (n, 6) as far as the arm reaches [rad].
        near: must pass along all of it.
        clear: must pass at its end; better still with room around.
        otherwise: what is said where nothing else is known.
    """
    wide = clear.with_margins(WIDE)
    first = None
    for row in range(len(path)):
        if near.why(path[row]):
            break
        if clear.free(path[row]):
            first = row
            if wide.free(path[row]):
                break
    if first is not None:
        return path[: first + 1]
    return near.why_along(path) or clear.why(path[-1]) or otherwise


def _scaled(vector: Vector3, factor: float) -> Vector3:
    x, y, z = vector
    return (factor * x, factor * y, factor * z)


def _ranked(reasons: Sequence[str]) -> tuple[str, ...]:
    """Every reason once, the most frequent first."""
    once = dict.fromkeys(reasons)
    return tuple(sorted(once, key=lambda reason: -reasons.count(reason)))
