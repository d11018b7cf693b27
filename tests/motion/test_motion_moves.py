"""Whole motions: a real pallet is taken apart, box by box, into the trolleys."""

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import numpy.typing as npt
import pytest

from depal.cell.files import shipped_cell
from depal.domain import Approach, Grasp, PlaceId
from depal.geometry import OrientedBox, Pose
from depal.logistics import read_delivery
from depal.motion.collision import Scene, fixed_solids, held_box
from depal.motion.grasping import grasps
from depal.motion.moves import Berth, Kind, Mover, NoMotion, Part, Pick, Put
from depal.motion.moves.margins import BEYOND, CLOSE, OPEN
from depal.motion.planning.free import Effort
from depal.studies.bench.planning_referee import Referee
from depal.studies.real import perceived_stack, unload_delivery

Floats = npt.NDArray[np.float64]

CELL = shipped_cell("default")
MOVER = Mover(CELL)
FIXED = fixed_solids(CELL)
PARKED = np.array(CELL.robot.parked)
FRONT = (-1.0, 0.0, 0.0)


@dataclass(frozen=True)
class Job:
    """The next box of a delivery, with all that stands around."""

    box: OrientedBox
    grasps: tuple[Grasp, ...]
    cases: list[tuple[str, OrientedBox]]

    @property
    def scene(self) -> Scene:
        """The box is in it, as "b"."""
        return Scene.of(FIXED, [("b", self.box), *self.cases])

    @property
    def solids(self) -> list[OrientedBox]:
        """Everything but the box."""
        return [solid for _, solid in FIXED + self.cases]


LAG = 3e-4
"""An axis rests this far from where it should, at the most [rad]."""


def jobs_of(name: str) -> Iterator[Job]:
    """The boxes of a delivery in the order of Algorithm 1."""
    delivery = read_delivery(name)
    order, boxes = unload_delivery(delivery, (), 0.5).sequence, perceived_stack(delivery)
    for k, index in enumerate(order):
        box = boxes[index]
        mass = delivery.products[box.gtin].mass
        ways = grasps(box.shape, mass, CELL.tool, FRONT)
        rest = [(str(boxes[other].id), boxes[other].shape) for other in order[k + 1 :]]
        yield Job(box.shape, ways, rest)


JOBS = list(jobs_of("dev-018"))
EVERY = JOBS[::4]


def pick_of(job: Job, start: Floats = PARKED, **only: Approach) -> Pick:
    """A pick that must be possible."""
    ways = [way for way in job.grasps if way.approach is only.get("approach", way.approach)]
    found = MOVER.pick(start, job.box, ways, job.scene, "b", Effort())
    assert isinstance(found, Pick)
    return found


def berth_of(job: Job, pick: Pick, place: PlaceId, depth: float = 0.02) -> Berth:
    """The box just inside a place, turned so that the flange looks into it."""
    into = CELL.places[place].cell_from_place
    x, y, _ = np.array(pick.grasp.box_from_flange.rotation)[:, 0]
    turn = Pose.from_yaw((0.0, 0.0, 0.0), -math.atan2(y, x))
    long, _, tall = np.abs(np.array(turn.rotation)) @ np.array(job.box.size)
    target = into @ Pose((depth + long / 2, 0.0, tall / 2), turn.rotation)
    return Berth(pick.grasp, job.box.size, into, target, 0.015)


def assert_joined(start: Floats, parts: tuple[Part, ...]) -> None:
    """Each part begins where the one before ended."""
    assert np.array_equal(parts[0].path[0], start)
    for one, other in pairwise(parts):
        assert np.array_equal(one.path[-1], other.path[0])


def finely(path: Floats) -> Floats:
    """A path with many configurations between its own."""
    shares = np.linspace(0.0, 1.0, 25)[:, None]
    return np.concatenate([a + shares * (b - a) for a, b in pairwise(path)])


@pytest.mark.parametrize("job", EVERY)
def test_a_pick_touches_the_face_squarely_and_nothing_else(job: Job) -> None:
    """The approach against MuJoCo, the box itself included."""
    pick = pick_of(job)
    assert_joined(PARKED, (*pick.approach, pick.lift, pick.out))
    touch = MOVER.body.kinematics.frames(pick.approach[-1].path[-1])[6]
    wanted = job.box.pose @ pick.grasp.box_from_flange
    assert np.allclose(touch[:, 3], wanted.translation, atol=1e-9)
    assert np.allclose(touch[:, :3], wanted.rotation, atol=1e-9)
    referee = Referee(CELL, [*job.solids, job.box], folded=pick.grasp.folded)
    for part in pick.approach:
        assert all(referee.nearest(q) > 0.0 for q in finely(part.path))


@pytest.mark.parametrize("job", EVERY)
def test_a_box_comes_out_clear_and_rubs_no_deeper_than_it_may(job: Job) -> None:
    """Arm and tool clear all along; the box within the errors of its pose."""
    pick = pick_of(job)
    assert pick.lift.touching
    assert pick.out.touching
    frames = [MOVER.body.kinematics.frames(pick.out.path[row])[6][:, 3] for row in (0, -1)]
    assert math.dist(*frames) > BEYOND - 1e-9
    held = held_box(pick.grasp, job.box.size)
    referee = Referee(CELL, job.solids, held, folded=pick.grasp.folded)
    for q in finely(np.concatenate((pick.lift.path, pick.out.path))):
        assert referee.nearest(q) > CLOSE.pile - 1e-6
    assert referee.nearest(pick.out.path[-1]) > 0.0
    open_hand = MOVER.checker(job.scene.without("b"), OPEN, pick.grasp, job.box.size)
    assert open_hand.free(pick.out.path[-1])


@pytest.mark.parametrize("job", EVERY)
@pytest.mark.parametrize("place", ["trolley_2/level_2", "trolley_4/level_1"])
def test_a_box_goes_into_a_place_without_a_contact_and_the_hand_comes_out(
    job: Job, place: str
) -> None:
    """Against MuJoCo from the pile to the place and back out."""
    pick = pick_of(job)
    scene = job.scene.without("b")
    berth = berth_of(job, pick, PlaceId(place))
    start = pick.out.path[-1]
    if MOVER.why_no_put(start, berth, scene):
        return
    put = MOVER.put((pick.out,), start, berth, scene, Effort())
    assert isinstance(put, Put)
    assert_joined(pick.out.path[0], put.carry)
    assert np.array_equal(put.carry[-1].path[-1], put.descent.path[0])
    referee = Referee(
        CELL, job.solids, held_box(pick.grasp, job.box.size), folded=pick.grasp.folded
    )
    for part in put.carry[1:]:
        assert all(referee.nearest(q) > 0.0 for q in finely(part.path))
    standing = Referee(
        CELL, [*job.solids, OrientedBox(berth.target, job.box.size)], folded=pick.grasp.folded
    )
    assert all(standing.nearest(q) > 0.0 for q in finely(put.retreat.path))
    with_box = scene.with_case("b", OrientedBox(berth.target, job.box.size))
    # The next box may want the tool folded otherwise, and the arm rests within what servos lag.
    for folded, lag in itertools.product((False, True), itertools.product((-LAG, LAG), repeat=6)):
        rest = put.retreat.path[-1] + np.array(lag)
        assert MOVER.checker(with_box, OPEN, folded=folded).free(rest)
    begin = MOVER.body.kinematics.frames(put.retreat.path[0])[6]
    stands = berth.target @ pick.grasp.box_from_flange
    assert np.allclose(begin[:, 3], stands.translation, atol=1e-9)


@pytest.mark.parametrize("job", EVERY)
def test_a_tool_is_clear_on_its_way_down_whatever_its_box_is_like(job: Job) -> None:
    """Against MuJoCo: a box that ends higher than it is taken to would stop it too late."""
    ways = [way for way in job.grasps if way.approach is Approach.HORIZONTAL]
    pick, scene = (
        MOVER.pick(PARKED, job.box, ways, job.scene, "b", Effort()),
        job.scene.without("b"),
    )
    if isinstance(pick, NoMotion):
        return
    berth = replace(berth_of(job, pick, PlaceId("trolley_2/level_2")), short=0.03)
    put = MOVER.put((pick.out,), pick.out.path[-1], berth, scene, Effort())
    if isinstance(put, NoMotion):
        return
    tool = Referee(CELL, job.solids, folded=pick.grasp.folded)
    assert all(tool.nearest(q) > 0.0 for q in finely(put.descent.path))


def test_most_boxes_go_into_most_trolleys() -> None:
    """So that the test above tests something."""
    places = [PlaceId(f"trolley_{n}/level_{level}") for n in (1, 2, 5, 6) for level in (1, 2)]
    good = 0
    for job in EVERY:
        pick = pick_of(job)
        scene, start = job.scene.without("b"), pick.out.path[-1]
        berths = [berth_of(job, pick, place) for place in places]
        good += sum(not MOVER.why_no_put(start, berth, scene) for berth in berths)
    assert good >= 0.6 * len(EVERY) * len(places)


def test_a_held_box_leans_no_further_than_it_may_between_pile_and_place() -> None:
    """Its up axis on the free part."""
    for job in EVERY[:4]:
        pick = pick_of(job)
        berth = berth_of(job, pick, PlaceId("trolley_2/level_2"))
        put = MOVER.put((), pick.out.path[-1], berth, job.scene.without("b"), Effort())
        assert isinstance(put, Put)
        up = np.array(pick.grasp.box_from_flange.rotation)[2]
        for q in finely(put.carry[0].path):
            assert (MOVER.body.kinematics.frames(q)[6][:, :3] @ up)[2] > math.cos(
                math.radians(25.5)
            )


def test_the_same_pick_twice_is_the_same_to_the_byte() -> None:
    """Whatever else was planned."""
    one, other = pick_of(JOBS[5]), pick_of(JOBS[9])
    again = pick_of(JOBS[5])
    assert other.approach[0].path.tobytes() != one.approach[0].path.tobytes()
    for a, b in zip(
        (*one.approach, one.lift, one.out), (*again.approach, again.lift, again.out), strict=True
    ):
        assert a.path.tobytes() == b.path.tobytes()


def test_a_box_beyond_the_reach_says_so() -> None:
    """In words."""
    far = OrientedBox.upright((3.5, 0.0, 0.5), (0.3, 0.3, 0.3))
    job = Job(far, grasps(far, 3.0, CELL.tool, FRONT), [])
    found = MOVER.pick(PARKED, far, job.grasps, job.scene, "b", Effort())
    assert isinstance(found, NoMotion)
    assert set(found.reasons) == {
        "no reach for a vertical grasp",
        "no reach for a horizontal grasp",
    }
    assert str(NoMotion(())) == "no way to hold it"


def test_a_box_behind_and_under_others_names_what_is_in_the_way() -> None:
    """A roof over it, a wall before it."""
    box = OrientedBox.upright((1.8, 0.0, 0.3), (0.3, 0.3, 0.3))
    cases = [
        ("roof", OrientedBox.upright((1.8, 0.0, 0.6), (0.7, 0.9, 0.2))),
        ("wall", OrientedBox.upright((1.5, 0.0, 0.45), (0.2, 0.9, 0.6))),
    ]
    job = Job(box, grasps(box, 3.0, CELL.tool, FRONT), cases)
    found = MOVER.pick(PARKED, box, job.grasps, job.scene, "b", Effort())
    assert isinstance(found, NoMotion)
    assert any("against roof" in reason for reason in found.reasons)
    assert any("against wall" in reason for reason in found.reasons)
    for way in job.grasps:
        assert MOVER.why_no_pick(PARKED, box, way, job.scene, "b")


def test_a_grasp_that_is_of_use_has_nothing_against_it() -> None:
    """What `why_no_pick` says is what `pick` finds."""
    job = JOBS[12]
    told = [not MOVER.why_no_pick(PARKED, job.box, way, job.scene, "b") for way in job.grasps]
    found = [
        isinstance(MOVER.pick(PARKED, job.box, [way], job.scene, "b", Effort()), Pick)
        for way in job.grasps
    ]
    assert told == found
    assert 0 < sum(told) < len(told)


def test_a_spot_behind_another_box_is_refused_with_its_name() -> None:
    """Before any search."""
    job = JOBS[8]
    pick = pick_of(job)
    berth = berth_of(job, pick, PlaceId("trolley_2/level_2"))
    scene, start = job.scene.without("b"), pick.out.path[-1]
    assert MOVER.why_no_put(start, berth, scene) == ""
    in_the_way = OrientedBox(berth.target, (0.1, 0.1, 0.1))
    blocked = scene.with_case("crate", in_the_way)
    assert "the held box against crate" in MOVER.why_no_put(start, berth, blocked)
    refused = MOVER.put((), start, berth, blocked, Effort())
    assert isinstance(refused, NoMotion)
    assert "the held box against crate" in refused.reasons


def test_a_box_is_shown_where_it_can_be_and_the_arm_parks() -> None:
    """The first pose that can be had."""
    job = JOBS[0]
    pick = pick_of(job)
    scene, start = job.scene.without("b"), pick.out.path[-1]
    heading = math.atan2(-1.0, 1.0)
    far = Pose((3.0, 0.0, 1.0))
    near = Pose.from_yaw((0.6, -0.6, 1.3), heading)
    shown = MOVER.show((pick.out,), start, pick.grasp, job.box.size, [far, near], scene, Effort())
    assert not isinstance(shown, NoMotion)
    parts, pose = shown
    assert pose is near
    assert [part.kind for part in parts] == [Kind.STRAIGHT, Kind.FREE]
    end = MOVER.body.kinematics.flange(parts[-1].path[-1])
    assert np.allclose(end.translation, near.translation, atol=1e-9)
    nowhere = MOVER.show((), start, pick.grasp, job.box.size, [far], scene, Effort())
    assert nowhere == NoMotion(("no reach to show it",))
    home = MOVER.park(parts[-1].path[-1], Scene.of(FIXED, []), Effort(), folded=False)
    assert isinstance(home, Part)
    assert np.array_equal(home.path[-1], PARKED)
    crowded = Scene.of(
        [*FIXED, ("a crate", OrientedBox(MOVER.body.kinematics.flange(PARKED), (0.2, 0.2, 0.2)))],
        [],
    )
    assert MOVER.park(start, crowded, Effort(), folded=False) == NoMotion(
        ("the tool against a crate",)
    )


@pytest.mark.slow
def test_every_box_of_a_delivery_can_be_picked_from_where_the_last_one_was_left() -> None:
    """One after the other, into the middle trolleys where they fit, else back to the start."""
    start = PARKED
    for job in JOBS:
        pick = pick_of(job, start)
        scene, end = job.scene.without("b"), pick.out.path[-1]
        start = PARKED
        for place in ("trolley_2/level_2", "trolley_5/level_1", "trolley_1/level_2"):
            berth = berth_of(job, pick, PlaceId(place))
            if not MOVER.why_no_put(end, berth, scene):
                put = MOVER.put((pick.out,), end, berth, scene, Effort())
                assert isinstance(put, Put)
                start = put.retreat.path[-1]
                break


def test_a_box_that_may_be_less_high_is_let_down_by_so_much_more() -> None:
    """Else it would be let go in the air; what it stands on ends the descent."""
    job = EVERY[0]
    pick = pick_of(job)
    scene = job.scene.without("b")
    berth = berth_of(job, pick, PlaceId("trolley_2/level_2"))
    ends = []
    for short in (0.0, 0.05):
        put = MOVER.put(
            (pick.out,), pick.out.path[-1], replace(berth, short=short), scene, Effort()
        )
        assert isinstance(put, Put)
        ends.append(MOVER.body.kinematics.flange(put.descent.path[-1]).translation[2])
    assert ends[0] - ends[1] == pytest.approx(0.05, abs=1e-6)
