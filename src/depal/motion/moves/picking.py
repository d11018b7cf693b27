"""To a box, and straight out of the pile with it."""

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from depal.domain import Approach, CellLayout, Grasp
from depal.geometry import OrientedBox, Pose, Vector3
from depal.motion.collision import Checker, Scene
from depal.motion.collision.values import Array
from depal.motion.grasping.bulk import EXACT, swollen
from depal.motion.moves.margins import BEFORE, BEYOND, CLOSE, DEEPER, FINE, LIFT, OPEN
from depal.motion.moves.reach import Reach, scaled
from depal.motion.moves.values import SURE, Doubts, Kind, NoMotion, Part, Pick
from depal.motion.planning.free import Effort, Found
from depal.motion.planning.straight import PITCH, straight

BRANCHES = 3
"""So many configurations of one grasp are planned for."""

KEPT = 12
"""So many configurations, of all grasps, are kept for a search."""

UP: Vector3 = (0.0, 0.0, 1.0)


@dataclass(frozen=True, slots=True, eq=False)
class _Option:
    """A configuration in which a box can be held, with its straight parts.

    Attributes:
        grasp: how.
        back: (n, 6) from the plane of touch back to where free space begins [rad].
        lift: holding.
        out: holding.
    """

    grasp: Grasp
    back: Array
    lift: Part
    out: Part

    def with_way(self, way: Found) -> Pick:
        """The whole pick, once the way through free space is known."""
        approach = (Part(Kind.FREE, way.path), Part(Kind.STRAIGHT, self.back[::-1].copy()))
        return Pick(self.grasp, approach, self.lift, self.out)


@dataclass(frozen=True, slots=True, eq=False)
class _Job:
    """A box that is to be taken.

    Attributes:
        reach: of the arm.
        start: (6,) where the arm is [rad].
        box: in the cell frame.
        scene: all that stands around, the box included.
        without: the same, the box left out.
        wary: what an empty hand keeps clear of: the same, or larger where errors are feared.
        roomy: what the held box is clear of in the end: what stands around without it, or larger.
        beyond: how much longer it may be along its own axes, at either end [m].
    """

    reach: Reach
    start: Array
    box: OrientedBox
    scene: Scene
    without: Scene
    wary: Scene
    roomy: Scene
    beyond: Vector3 = EXACT


def plan_pick(
    reach: Reach,
    start: Array,
    box: OrientedBox,
    grasps: Sequence[Grasp],
    scene: Scene,
    name: str,
    effort: Effort,
    doubts: Doubts = SURE,
) -> Pick | NoMotion:
    """To a box, and straight out of the pile with it.

    Grasps come in the order of preference: the first one with an easy way through free space is
    taken. Only where none has one a way is searched for, to all of them at once. Ways out that
    take the box deeper into its neighbours are a last resort.

    Args:
        reach: of the arm.
        start: (6,) where the arm is [rad].
        box: in the cell frame.
        grasps: ways to hold it, best first.
        scene: all that stands around, the box included under its name.
        name: of the box in the scene.
        effort: for free space.
        doubts: what is not as it looks, maybe.
    """
    around, without = doubts.wary or scene, scene.without(name)
    roomy = doubts.roomy or without
    job = _Job(reach, start, box, scene, without, around, roomy, doubts.beyond)
    reasons: list[str] = []
    kept: list[_Option] = []
    empty = {folded: reach.checker(around, OPEN, folded=folded) for folded in (False, True)}
    for careful, grasp in itertools.product((True, False), grasps):
        options = list(itertools.islice(_options(job, grasp, reasons, careful=careful), BRANCHES))
        if not options:
            continue
        way = reach.free.quick(empty[grasp.folded], start, _ends(options), effort)
        if way is not None:
            return _option_at(options, way).with_way(way)
        kept += options
        if len(kept) >= KEPT:
            break
    for folded in dict.fromkeys(option.grasp.folded for option in kept):
        options = [option for option in kept if option.grasp.folded is folded]
        way = reach.free.search(empty[folded], start, _ends(options), effort, level=False)
        if way is not None:
            return _option_at(options, way).with_way(way)
    reasons += [f"no free way to a {option.grasp.approach.value} grasp" for option in kept]
    return NoMotion.because(reasons)


def why_no_pick(
    reach: Reach, near: Array, box: OrientedBox, grasp: Grasp, scene: Scene, name: str
) -> str:
    """Why a grasp is of no use, as far as its straight parts go; empty where it is.

    Args:
        reach: of the arm.
        near: (6,) configurations near this one come first [rad].
        box: in the cell frame.
        grasp: how it would be held.
        scene: all that stands around, the box included under its name.
        name: of the box in the scene.
    """
    reasons: list[str] = []
    without = scene.without(name)
    job = _Job(reach, near, box, scene, without, scene, without)
    for _ in _options(job, grasp, reasons, careful=False):
        return ""
    return str(NoMotion.because(reasons))


def _ends(options: Sequence[_Option]) -> Array:
    return np.stack([option.back[-1] for option in options])


def _option_at(options: Sequence[_Option], way: Found) -> _Option:
    return next(option for option in options if np.array_equal(option.back[-1], way.path[-1]))


def _options(job: _Job, grasp: Grasp, reasons: list[str], *, careful: bool) -> Iterator[_Option]:
    """Configurations in which a grasp works, as far as its straight parts go.

    Args:
        job: the box and what stands around it.
        grasp: how it would be held.
        reasons: receives why others do not work.
        careful: whether the box may reach no deeper into others than it seems to already.
    """
    reach, start, box = job.reach, job.start, job.box
    touch = box.pose @ grasp.box_from_flange
    normal = into_face(touch, grasp, reach.layout)
    how = grasp.approach.value
    branches = reach.branches(touch, start)
    if not len(branches):
        reasons.append(f"no reach for a {how} grasp")
        return
    near = reach.checker(job.wary, CLOSE, folded=grasp.folded)
    empty = near.with_margins(OPEN)
    holding = reach.checker(job.without, CLOSE, grasp, box.size)
    clear = reach.checker(job.roomy, OPEN, *swollen(grasp, box.size, job.beyond))
    for q in branches:
        if hit := near.why(q):
            reasons.append(hit)
            continue
        back = reach.way_out(q, scaled(normal, -1.0), near, empty, round(BEFORE / PITCH))
        if isinstance(back, str):
            reasons.append(back)
            continue
        rubbing = holding.rubbing(q, DEEPER) if careful else holding
        parts = _way_out(reach, q, grasp, normal, (rubbing, clear), reasons)
        if parts is not None:
            yield _Option(grasp, back, *parts)


def _way_out(
    reach: Reach,
    touch: Array,
    grasp: Grasp,
    normal: Vector3,
    checks: tuple[Checker, Checker],
    reasons: list[str],
) -> tuple[Part, Part] | None:
    """Lift, then straight out until the held box is clear of everything."""
    holding, clear = checks
    lift = straight(reach.body.kinematics, touch, scaled(UP, LIFT), pitch=FINE)
    if lift is None:
        reasons.append("no reach to lift it")
        return None
    ways = (UP,) if grasp.approach is Approach.VERTICAL else (scaled(normal, -1.0), UP)
    for way in ways:
        out = reach.way_out(lift[-1], way, holding, clear, round(BEYOND / PITCH))
        if isinstance(out, str):
            reasons.append(out)
            continue
        return Part(Kind.STRAIGHT, lift, touching=True), Part(Kind.STRAIGHT, out, touching=True)
    return None


def into_face(touch: Pose, grasp: Grasp, layout: CellLayout) -> Vector3:
    """The direction of a grasp's approach, out of the plane of touch towards the box."""
    module = layout.tool.module(grasp.cups[0][0], folded=grasp.folded)
    turn = np.array(touch.rotation) @ np.array(module.flange_from_face.rotation)
    x, y, z = turn[:, 0].tolist()
    return (x, y, z)
