"""The ports' laws, for a cell in this process and for one behind a socket: they are the same."""

import asyncio
from collections.abc import Callable, Coroutine
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np
import pytest
from served_worlds import Side, far, near
from simulated_layouts import PARKED, REACHING, delivery, layout, point_to_point, radians
from simulated_worlds import ALL, shifted

from depal.cell.guards import Guards
from depal.domain import FRONT, CellLayout, Delivery, Joints
from depal.errors import DeviceError
from depal.executive.clock import LoopClock
from depal.geometry import OrientedBox, Pose, Vector3
from depal.ports import STANDS, Frame, Guard, Question, SafetyState

T = TypeVar("T")

AWAY = radians(-15, -102, 125, 60, 80, 30)
CELL = layout()
NOTE = delivery(((0.4, 0.2, 0.0), (0.3, 0.3, 0.3), 5.0), ((0.8, 0.4, 0.0), (0.2, 0.2, 0.2), 3.0))
EXCHANGE = Question("q1", "Exchange trolley_1?", ("done", "not now"), "trolley_1")

TALL = 1.402
BOARD = OrientedBox.upright((2.22, 0.0, 0.144 + TALL - 0.02), (0.3, 0.4, 0.04))
BEFORE_A_BOX = replace(CELL, robot=replace(CELL.robot, parked=REACHING), fixtures=(BOARD,))

Through = Callable[[Callable[[Side], Coroutine[Any, Any, T]], CellLayout, Delivery], T]


@pytest.fixture(params=[near, far], ids=["here", "behind a socket"])
def through(request: pytest.FixtureRequest) -> Through[Any]:
    """How a cell is reached."""
    found: Through[Any] = request.param
    return found


def standing(side: Side) -> tuple[bool, np.ndarray]:
    """Whether the arm stands still, and where."""
    world = side.cell.world
    world.advance(LoopClock().now())
    return not world.wanted()[1].any(), world.wanted()[0]


def test_a_motion_takes_its_time_and_ends_where_it_says(through: Through[Any]) -> None:
    """No reason to stop: None; the joints are at the end as soon as it is over."""

    async def work(side: Side) -> tuple[str | None, float, np.ndarray]:
        began = LoopClock().now()
        reason = await side.arm.follow(point_to_point(PARKED, AWAY, 1.5))
        return reason, LoopClock().now() - began, np.array(side.arm.joints())

    reason, took, joints = through(work, CELL, NOTE)
    assert reason is None
    assert took >= 1.5 - 0.004
    assert np.abs(joints - np.array(AWAY)).max() < 1e-3


def test_a_guard_brings_the_arm_to_rest_on_its_path(through: Through[Any]) -> None:
    """The reason is what it said."""

    async def work(side: Side) -> tuple[str | None, bool, np.ndarray]:
        began = LoopClock().now()
        reason = await side.arm.follow(
            point_to_point(PARKED, AWAY, 3.0),
            lambda: "enough" if LoopClock().now() - began > 0.9 else None,
        )
        return (reason, *standing(side))

    reason, still, joints = through(work, CELL, NOTE)
    share = (joints - np.array(PARKED)) / (np.array(AWAY) - np.array(PARKED))
    assert reason == "enough"
    assert still
    assert np.ptp(share) < 1e-9
    assert 0.01 < share[0] < 0.99


@pytest.mark.parametrize("after", [0.0, 0.5])
def test_a_motion_that_is_cancelled_leaves_the_arm_at_rest(
    through: Through[Any], after: float
) -> None:
    """Half-way, and in the very moment in which it was commanded."""

    async def work(side: Side) -> tuple[bool, np.ndarray]:
        motion = asyncio.create_task(side.arm.follow(point_to_point(PARKED, AWAY, 3.0)))
        await asyncio.sleep(after)
        motion.cancel()
        await asyncio.gather(motion, return_exceptions=True)
        await asyncio.sleep(1.0)
        return standing(side)

    still, joints = through(work, CELL, NOTE)
    assert still
    assert abs(joints - np.array(AWAY)).max() > 0.2


def test_a_motion_behind_one_that_was_cancelled_begins_where_the_arm_has_come_to_rest(
    through: Through[Any],
) -> None:
    """The first one does not go on; where the arm stands is told."""

    async def work(side: Side) -> tuple[str | None, np.ndarray]:
        motion = asyncio.create_task(side.arm.follow(point_to_point(PARKED, AWAY, 3.0)))
        await asyncio.sleep(0.3)
        motion.cancel()
        await asyncio.gather(motion, return_exceptions=True)
        await asyncio.sleep(1.0)
        reason = await side.arm.follow(point_to_point(side.arm.joints(), PARKED, 2.0))
        return reason, np.array(side.arm.joints())

    reason, joints = through(work, CELL, NOTE)
    assert reason is None
    assert joints == pytest.approx(np.array(PARKED), abs=1e-3)


def test_two_motions_at_once_are_refused(through: Through[Any]) -> None:
    """The first one goes on."""

    async def work(side: Side) -> tuple[str | None, str]:
        first = asyncio.create_task(side.arm.follow(point_to_point(PARKED, AWAY, 1.5)))
        await asyncio.sleep(0.1)
        with pytest.raises(DeviceError) as caught:
            await side.arm.follow(point_to_point(PARKED, AWAY, 1.5))
        return await first, str(caught.value)

    assert through(work, CELL, NOTE) == (None, "the arm was told to move while it moves")


@pytest.mark.parametrize("moment", ["before", "on the way"])
def test_a_safety_stop_is_an_error(through: Through[Any], moment: str) -> None:
    """Before a motion the arm refuses, on the way it comes to rest; the state says why."""

    async def work(side: Side) -> tuple[str, bool, SafetyState, SafetyState]:
        safety, loop = side.cell.safety, asyncio.get_running_loop()
        before = side.safety.state()
        if moment == "before":
            safety.stopped = True
        else:
            loop.call_later(0.5, lambda: setattr(safety, "stopped", True))
        with pytest.raises(DeviceError) as caught:
            await side.arm.follow(point_to_point(PARKED, AWAY, 3.0))
        return str(caught.value), standing(side)[0], before, side.safety.state()

    error, still, before, after = through(work, CELL, NOTE)
    assert "safety stop is active" in error
    assert still
    assert before == SafetyState(stopped=False, gate_open=False)
    assert after == SafetyState(stopped=True, gate_open=False)


@pytest.mark.parametrize(
    ("start", "end", "seconds", "message"),
    [
        (AWAY, PARKED, 1.5, "begins 1.047 rad from where axis 4 stands"),
        (PARKED, radians(-70, -95, 110, 0, 60, 340), 1.5, "axis 6 at 1.32 times its greatest"),
        (PARKED, radians(-70, -95, 110, 0, 121, 0), 2.0, "axis 5 0.035 rad beyond its limits"),
    ],
)
def test_the_arm_refuses_what_it_cannot_do(
    through: Through[Any], start: Joints, end: Joints, seconds: float, message: str
) -> None:
    """With the same words."""

    async def work(side: Side) -> None:
        with pytest.raises(DeviceError, match=message):
            await side.arm.follow(point_to_point(start, end, seconds))

    through(work, CELL, NOTE)


async def go(side: Side, way: Vector3, seconds: float, guard: Guard | None = None) -> str | None:
    """A straight part: the held box may touch."""
    motion = replace(shifted(side.cell.world, way, seconds), allowances=((0.0, seconds),))
    return await side.arm.follow(motion, guard)


@pytest.mark.parametrize("mass", [1.0, 5.0, 12.0])
def test_a_box_is_taken_weighed_and_set_down_without_collision_or_loss(
    through: Through[Any], mass: float
) -> None:
    """As the primitives do it; it does not press on what it is set down on."""
    box = ((0.45, 0.665, TALL), (0.3, 0.3, 0.3), mass)

    async def work(side: Side) -> tuple[list[float], list[dict[str, float]], str | None]:
        loads, vacua = [], [side.gripper.vacuum()]
        guards = Guards(side.arm, side.gripper, side.safety)
        await go(side, (0.1, 0.0, 0.0), 0.5)
        assert await side.gripper.suck(tuple((FRONT, cup) for cup in ALL))
        vacua.append(side.gripper.vacuum())
        await go(side, (0.0, 0.0, 0.015), 0.5, guards.holding())
        await go(side, (-0.15, 0.0, 0.0), 0.8, guards.holding())
        await asyncio.sleep(1.0)
        loads.append(side.arm.load())
        assert side.cell.referee.where(0) == "hand"
        await go(side, (0.15, 0.0, 0.0), 0.8, guards.holding())
        landed = await go(side, (0, 0, -0.03), 1.5, guards.setting_down(mass))
        await side.gripper.release()
        vacua.append(side.gripper.vacuum())
        await asyncio.sleep(1.0)
        loads.append(side.arm.load())
        summary = side.cell.referee.summary()
        assert summary.collisions == ()
        assert summary.greatest_force < 50.0
        assert summary.lost == ()
        return loads, vacua, landed

    loads, vacua, landed = through(work, BEFORE_A_BOX, delivery(box))
    assert loads == [pytest.approx(mass, abs=0.1), pytest.approx(0.0, abs=0.1)]
    assert [vacuum["front"] > 0.0 for vacuum in vacua] == [False, True, False]
    assert landed == STANDS


def test_cups_that_seal_on_nothing_say_so(through: Through[Any]) -> None:
    """And read no vacuum."""

    async def work(side: Side) -> tuple[bool, dict[str, float]]:
        return await side.gripper.suck((("front", 0), ("front", 1))), side.gripper.vacuum()

    assert through(work, CELL, NOTE) == (False, {"front": 0.0, "lower": 0.0})


def test_the_hinge_moves_both_ways(through: Through[Any]) -> None:
    """Each way takes its time."""

    async def work(side: Side) -> list[tuple[bool, bool]]:
        seen = []
        for up in (True, True, False):
            began = LoopClock().now()
            await side.gripper.fold(up=up)
            moved = LoopClock().now() - began >= CELL.tool.fold_time
            seen.append((side.gripper.folded(), moved))
        return seen

    folded = [state for state, _ in through(work, CELL, NOTE)]
    assert folded == [True, True, False]


def test_a_trolley_is_exchanged_by_who_promises_it(through: Through[Any]) -> None:
    """The bay is empty for a while; who declines changes nothing."""

    async def work(side: Side) -> list[str | None]:
        seen = [side.bays.trolley("trolley_1")]
        await side.do(EXCHANGE, "not now")
        seen.append(side.bays.trolley("trolley_1"))
        exchange = asyncio.create_task(side.do(EXCHANGE, "done"))
        await asyncio.sleep(15.0)
        seen.append(side.bays.trolley("trolley_1"))
        await exchange
        return [*seen, side.bays.trolley("trolley_1"), side.bays.trolley("nowhere")]

    seen = through(work, CELL, NOTE)
    assert seen == ["trolley_1", "trolley_1", None, "trolley_1#2", None]


def test_who_stands_there_says_what_is_so(through: Through[Any]) -> None:
    """A box that is there can be taken; then it has gone, and the referee knows."""
    question = Question("q2", "Please take b1.", ("taken", "it is not there"), "b1")

    async def work(side: Side) -> tuple[str, str, str]:
        before = await side.what_is_so(question)
        await side.do(question, "taken")
        nobody = Question("q3", "Please take b9.", ("taken", "it is not there"), "b9")
        return before, side.cell.referee.where(0), await side.what_is_so(nobody)

    assert through(work, CELL, NOTE) == ("taken", "removed", "it is not there")


def test_what_is_seen_comes_as_it_was_seen(through: Through[Any]) -> None:
    """Boxes, their products where they are known, and when."""

    async def work(side: Side) -> tuple[list[str], float, float]:
        before = LoopClock().now()
        view = await side.sight.look()
        assert view.obstacles == ()
        return [str(box.id) for box in view.boxes], view.taken - before, LoopClock().now() - before

    boxes, taken, took = through(work, CELL, NOTE)
    assert sorted(boxes) == ["b1", "b2"]
    assert 0.0 <= taken <= took


def test_a_reader_that_sees_no_code_reads_nothing(through: Through[Any]) -> None:
    """Nothing is in the hand."""

    async def work(side: Side) -> tuple[str, ...]:
        return await side.reader.read()

    assert through(work, CELL, NOTE) == ()


def test_where_the_physics_broke_down_nothing_can_be_read(through: Through[Any]) -> None:
    """Each sensor that measures is an error, and so is a motion; nobody waits for ever."""

    async def work(side: Side) -> None:
        side.cell.world.data.warning[5].number = 1
        await asyncio.sleep(1.0)
        for reading in (side.arm.joints, side.arm.load, side.gripper.vacuum):
            with pytest.raises(DeviceError, match="physics broke down"):
                reading()
        with pytest.raises(DeviceError, match="physics broke down"):
            await side.arm.follow(point_to_point(PARKED, AWAY, 1.5))

    through(work, CELL, NOTE)


@pytest.mark.slow
def test_a_picture_is_the_same_to_the_byte(through: Through[Any]) -> None:
    """Both pictures, both lenses, and from where."""

    async def work(side: Side) -> bool:
        seen = []
        take = side.cell.cameras[0].take

        async def kept() -> Frame:
            seen.append(await take())
            return seen[-1]

        side.cell.cameras[0].take = kept  # type: ignore[method-assign]
        frame = await side.cameras[0].take()
        (truth,) = seen
        assert frame.taken == truth.taken
        assert frame.colour.tobytes() == truth.colour.tobytes()
        assert frame.depth.tobytes() == truth.depth.tobytes()
        assert frame.colour.shape == (1080, 1920, 3)
        assert (frame.colour_k, frame.depth_k) == (truth.colour_k, truth.depth_k)
        assert isinstance(frame.cell_from_camera, Pose)
        return bool(frame.cell_from_camera == truth.cell_from_camera)

    assert through(work, CELL, NOTE)


def test_axes_do_not_follow_what_is_no_number(through: Through[Any]) -> None:
    """Or the physics would break down."""

    async def work(side: Side) -> None:
        good = point_to_point(PARKED, AWAY, 1.5)
        bad = replace(good, positions=np.where(good.times[:, None] > 1.0, np.nan, good.positions))
        with pytest.raises(DeviceError, match="not finite"):
            await side.arm.follow(bad)

    through(work, CELL, NOTE)
