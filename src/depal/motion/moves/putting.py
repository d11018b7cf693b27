"""With a held box into a place, and out again without it."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from depal.domain import Grasp
from depal.geometry import OrientedBox, Pose, Vector3
from depal.motion.collision import Scene
from depal.motion.collision.values import Array
from depal.motion.moves.margins import AFTER, BELOW, ENTRY, FINE, LEAVING, OPEN, RESTING
from depal.motion.moves.reach import Reach
from depal.motion.moves.values import Kind, NoMotion, Part, Put
from depal.motion.planning.free import Effort
from depal.motion.planning.straight import PITCH, moved, straight


@dataclass(frozen=True, slots=True)
class Berth:
    """What is to be put where.

    Attributes:
        grasp: how the box is held.
        size: of the box along its own axes [m].
        into: `cell_from_place`: x is the way in.
        target: `cell_from_box` where the box will stand.
        lift: how far above it the box is pushed in [m].
        short: how much less high the box may be than it is taken to be, held at its top [m].
    """

    grasp: Grasp
    size: Vector3
    into: Pose
    target: Pose
    lift: float
    short: float = 0.0

    @property
    def outward(self) -> Vector3:
        """The way out of the place, of length 1."""
        x, y, z = (-row[0] for row in self.into.rotation)
        return (x, y, z)

    @property
    def above(self) -> Pose:
        """`cell_from_flange` when the box is all the way in, above where it will stand."""
        return moved(self.target, (0.0, 0.0, self.lift)) @ self.grasp.box_from_flange


@dataclass(frozen=True, slots=True, eq=False)
class _Option:
    """A configuration in which a box can be put down, with its straight parts."""

    back: Array
    down: Array
    away: Array


def plan_put(
    reach: Reach,
    lead: tuple[Part, ...],
    start: Array,
    berth: Berth,
    scene: Scene,
    effort: Effort,
) -> Put | NoMotion:
    """With a held box into a place.

    Args:
        reach: of the arm.
        lead: parts that come before, ending at `start`: the way out of the pile.
        start: (6,) where free space begins [rad].
        berth: what is put where.
        scene: all that stands around, the held box left out.
        effort: for free space.
    """
    reasons: list[str] = []
    options = list(_options(reach, start, berth, scene, reasons))
    if not options:
        return NoMotion.because(reasons)
    clear = reach.checker(scene, OPEN, berth.grasp, berth.size)
    ends = np.stack([option.back[-1] for option in options])
    way = reach.free.plan(clear, start, ends, effort, level=True)
    if way is None:
        return NoMotion.because([clear.why(start) or "no free way to the place", *reasons])
    option = next(one for one in options if np.array_equal(one.back[-1], way.path[-1]))
    carry = (
        *lead,
        Part(Kind.FREE, way.path),
        Part(Kind.STRAIGHT, option.back[::-1].copy(), touching=True),
    )
    return Put(
        carry,
        Part(Kind.STRAIGHT, option.down, touching=True),
        Part(Kind.STRAIGHT, option.away),
    )


def why_no_put(reach: Reach, near: Array, berth: Berth, scene: Scene) -> str:
    """Why a spot cannot be had, as far as its straight parts go; empty where it can.

    Args:
        reach: of the arm.
        near: (6,) configurations near this one come first [rad].
        berth: what is put where.
        scene: all that stands around, the held box left out.
    """
    reasons: list[str] = []
    for _ in _options(reach, near, berth, scene, reasons):
        return ""
    return str(NoMotion.because(reasons))


def _options(
    reach: Reach, near: Array, berth: Berth, scene: Scene, reasons: list[str]
) -> Iterator[_Option]:
    """Configurations above a spot from which there is a way down and a way out."""
    kinematics = reach.body.kinematics
    branches = reach.branches(berth.above, near)
    if not len(branches):
        reasons.append("no reach to its spot")
        return
    entry = reach.checker(scene, ENTRY, berth.grasp, berth.size)
    clear = entry.with_margins(OPEN)
    tool = reach.checker(scene, LEAVING, folded=berth.grasp.folded)
    for q in branches:
        if hit := entry.why(q):
            reasons.append(hit)
            continue
        back = reach.way_out(q, berth.outward, entry, clear, round(AFTER / PITCH))
        if isinstance(back, str):
            reasons.append(back)
            continue
        down = straight(kinematics, q, (0.0, 0.0, -berth.lift - berth.short - BELOW), pitch=FINE)
        low = straight(kinematics, q, (0.0, 0.0, -berth.lift), pitch=FINE)
        if down is None or low is None:
            reasons.append("no reach to set it down")
            continue
        away = _retreat(reach, low[-1], berth, scene)
        if isinstance(away, str):
            reasons.append(away)
            continue
        # A box that ends higher than it is taken to does not keep the tool off what is below.
        yield _Option(back, down[: tool.first_hit(down)], away)


def _retreat(reach: Reach, q: Array, berth: Berth, scene: Scene) -> Array | str:
    """Straight out with an empty hand, until the tool is clear and has room to be folded."""
    with_box = scene.with_case("the box", OrientedBox(berth.target, berth.size))
    folded = berth.grasp.folded
    near = reach.checker(with_box, LEAVING, folded=folded)
    other = reach.checker(with_box, RESTING, folded=not folded)
    least = round(AFTER / PITCH)
    return reach.way_out(q, berth.outward, near, near.with_margins(RESTING), least, other)
