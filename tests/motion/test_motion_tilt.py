"""How far a held box leans: never further than it may, whatever box, place and limit."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_motion_moves import CELL, JOBS, MOVER, Floats, Job, berth_of, finely, pick_of

from depal.cell.planning.timing import Timing
from depal.domain import Grasp, PlaceId
from depal.geometry import OrientedBox, Pose
from depal.motion.moves import OPEN, Kind, Mover, NoMotion, Put
from depal.motion.moves.margins import TILT
from depal.motion.planning.free import Effort

PLACES = [PlaceId(f"trolley_{n}/level_{level}") for n in (1, 2, 4, 5) for level in (1, 2)]

ERROR = math.radians(0.1)
"""Between two checks, and where a corner is rounded off, it may lean so much more [rad]."""


def leans(path: Floats, grasp: Grasp) -> Floats:
    """How far the box's up axis is from the vertical in each row of a path, (n,) [rad]."""
    up = np.array(grasp.box_from_flange.rotation)[2]
    rise = [(MOVER.body.kinematics.frames(q)[6][:, :3] @ up)[2] for q in path]
    angles: Floats = np.arccos(np.clip(rise, -1.0, 1.0))
    return angles


def carried(job: Job, place: PlaceId, tilt: float) -> tuple[Put | NoMotion, Grasp, Floats]:
    """A box's way into a place under a limit, how it is held, and every sample of its motion."""
    mover, pick = MOVER.leaning(tilt), pick_of(job)
    scene = job.scene.without("b")
    put = mover.put(
        (pick.out,), pick.out.path[-1], berth_of(job, pick, place), scene, Effort(iterations=4000)
    )
    if isinstance(put, NoMotion):
        return put, pick.grasp, np.empty((0, 6))
    checker = mover.checker(scene, OPEN, pick.grasp, job.box.size)
    motion = Timing(CELL).along(put.carry, None, checker)
    assert motion is not None
    times = np.arange(0.0, motion.duration, 0.01)
    return put, pick.grasp, np.array([motion.at(time)[0] for time in times])


@settings(max_examples=15, deadline=None)
@given(st.sampled_from(JOBS), st.sampled_from(PLACES), st.floats(1.0, 30.0))
def test_a_box_never_leans_further_than_its_limit(job: Job, place: PlaceId, degrees: float) -> None:
    """Neither on the path, nor in the motion along it with its corners rounded off."""
    tilt = math.radians(degrees)
    put, grasp, samples = carried(job, place, tilt)
    if isinstance(put, NoMotion):
        assert str(put)
        return
    most = min(tilt, TILT) + ERROR
    for part in (*put.carry, put.descent):
        assert leans(finely(part.path), grasp).max() <= most
    assert leans(samples, grasp).max() <= most


@pytest.mark.parametrize("degrees", [5.0, 10.0])
def test_most_boxes_find_a_way_under_a_tight_limit(degrees: float) -> None:
    """So that the law above is not kept by refusing; and without the limit they lean further."""
    found, further = 0, 0
    jobs = [(job, place) for job in JOBS[::6] for place in PLACES[::3]]
    jobs = [each for each in jobs if isinstance(carried(*each, TILT)[0], Put)]
    for job, place in jobs:
        put, _, _ = carried(job, place, math.radians(degrees))
        found += isinstance(put, Put)
        free, grasp, _ = carried(job, place, TILT)
        assert isinstance(free, Put)
        further += leans(finely(free.carry[1].path), grasp).max() > math.radians(degrees)
    assert found >= 0.9 * len(jobs)
    assert further


def test_a_limit_wider_than_the_planners_own_changes_nothing() -> None:
    """Twenty-five degrees are never exceeded."""
    assert MOVER.leaning(TILT) is MOVER
    assert MOVER.leaning(math.inf) is MOVER
    assert MOVER.leaning(0.1).leaning(math.inf).checker is not None


def righted_from(lean: float, about: float) -> tuple[Put | NoMotion | None, Grasp]:
    """A box that hangs askew goes into a place under five degrees; None where the arm cannot."""
    job = JOBS[4]
    pick, scene = pick_of(job), job.scene.without("b")
    upright = MOVER.body.kinematics.flange(drawn_in(pick.out.path[-1]))
    axis = np.array([math.cos(about), math.sin(about), 0.0])
    tilted = Pose.from_arrays(
        np.array(upright.translation), turned_about(axis, lean) @ np.array(upright.rotation)
    )
    starts = MOVER.body.kinematics.solve(tilted, pick.out.path[-1])
    free = MOVER.checker(scene, OPEN, pick.grasp, job.box.size)
    starts = np.array([q for q in starts if free.free(q)])
    if not len(starts):
        return None, pick.grasp
    assert leans(starts[:1], pick.grasp)[0] == pytest.approx(lean)
    berth = berth_of(job, pick, PlaceId("trolley_2/level_2"))
    tight = MOVER.leaning(math.radians(5.0))
    return tight.put((), starts[0], berth, scene, Effort()), pick.grasp


@given(st.floats(0.12, 0.4), st.floats(-math.pi, math.pi))
@settings(max_examples=20, deadline=None)
def test_a_box_that_leans_too_far_is_turned_upright_before_it_goes_on(
    lean: float, about: float
) -> None:
    """Its task allows less now; it leans no further on the way than where it hung."""
    put, grasp = righted_from(lean, about)
    if put is None:
        return
    if isinstance(put, NoMotion):
        assert any("leans too far" in reason for reason in put.reasons)
        return
    righting, *rest = put.carry
    assert righting.kind is Kind.FREE
    assert leans(finely(righting.path), grasp).max() <= lean + math.radians(0.6)
    for part in rest:
        assert leans(finely(part.path), grasp).max() <= math.radians(5.0) + ERROR


def test_most_boxes_that_lean_too_far_can_be_turned_upright() -> None:
    """So that the law above is not kept by refusing."""
    found = [righted_from(0.2, about)[0] for about in np.arange(-3.0, 3.1, 1.0)]
    tried = [put for put in found if put is not None]
    assert len(tried) > 3
    assert sum(isinstance(put, Put) for put in tried) >= 0.8 * len(tried)


def drawn_in(q: Floats) -> Floats:
    """The same hold of the box, with room around it."""
    flange = MOVER.body.kinematics.flange(q)
    x, y, z = flange.translation
    found = MOVER.body.kinematics.solve(Pose((0.7 * x, 0.7 * y, z + 0.2), flange.rotation), q)
    return np.asarray(found[int(np.argmin(np.abs(found - q).max(axis=1)))])


def turned_about(axis: Floats, angle: float) -> Floats:
    """The turn about an axis of length 1, (3, 3)."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    turn: Floats = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    return turn


def test_a_box_that_stands_askew_on_the_pallet_is_refused_under_a_tight_limit() -> None:
    """It would hang so all the way."""
    x, y, z = JOBS[0].box.centre
    rotation = turned_about(np.array([0.0, 1.0, 0.0]), math.radians(8.0))
    pose = Pose.from_arrays(np.array([x, y, z + 0.05]), rotation)
    askew = OrientedBox(pose, JOBS[0].box.size)
    job = Job(askew, JOBS[0].grasps, [])
    tight = MOVER.leaning(math.radians(5.0))
    start = np.array(CELL.robot.parked)
    found = tight.pick(start, askew, job.grasps, job.scene, "b", Effort())
    assert isinstance(found, NoMotion)
    assert "the held box leans too far" in found.reasons
    loose: Mover = MOVER.leaning(math.radians(12.0))
    assert not isinstance(loose.pick(start, askew, job.grasps, job.scene, "b", Effort()), NoMotion)
