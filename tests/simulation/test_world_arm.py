"""The simulated arm follows, stops and refuses."""

import asyncio

import numpy as np
import pytest
from simulated_layouts import PARKED, delivery, layout, point_to_point, radians

from depal.domain import Joints
from depal.errors import DeviceError
from depal.executive.clock import LoopClock, run_simulated
from depal.simulation.cases import cases_of
from depal.simulation.devices import SimulatedArm, SimulatedSafety
from depal.simulation.model import STEP
from depal.simulation.world import World

AWAY = radians(-15, -102, 125, 60, 80, 30)
CELL = layout()


def a_world() -> World:
    """A world with one box."""
    note = delivery(((0.4, 0.2, 0.0), (0.3, 0.3, 0.3), 5.0))
    return World(CELL, cases_of(note, note.stack or (), CELL))


def an_arm(world: World) -> tuple[SimulatedArm, SimulatedSafety]:
    """The arm of a world, and what stops it."""
    safety = SimulatedSafety()
    return SimulatedArm(world, LoopClock(), safety), safety


def test_the_servos_lag_less_than_a_fifth_of_a_degree_at_full_speed() -> None:
    """With velocity feed-forward, one axis at 95 % of its limit or more."""
    world = a_world()
    trajectory = point_to_point(PARKED, AWAY, 0.82)
    speeds = np.abs(trajectory.velocities).max(axis=0) / np.array(CELL.robot.limits.speed)
    motion, lag = world.begin(trajectory), 0.0
    while world.now < world.ending(motion):
        world.advance(world.now + STEP)
        wanted, _ = world.wanted()
        lag = max(lag, float(np.abs(np.array(world.joints()) - wanted).max()))
    assert speeds.max() > 0.95
    assert np.degrees(lag) < 0.2


def test_a_motion_takes_its_time_and_ends_where_it_says() -> None:
    """No reason to stop: None."""

    async def work() -> tuple[str | None, float, Joints]:
        world = a_world()
        arm, _ = an_arm(world)
        reason = await arm.follow(point_to_point(PARKED, AWAY, 1.5))
        return reason, LoopClock().now(), arm.joints()

    reason, took, joints = run_simulated(work())
    assert reason is None
    assert took == pytest.approx(1.5, abs=0.004)
    assert np.abs(np.array(joints) - np.array(AWAY)).max() < 1e-3


@pytest.mark.parametrize("stop_after", [0.1, 0.7, 1.3])
def test_a_guard_brings_the_arm_to_rest_on_its_path_within_the_accelerations(
    stop_after: float,
) -> None:
    """Early, at full speed, and late; half of the limit again, for the path bends."""
    world = a_world()
    trajectory = point_to_point(PARKED, AWAY, 1.5)

    async def work() -> tuple[str | None, float]:
        arm, _ = an_arm(world)
        asked = LoopClock().now()
        reason = await arm.follow(
            trajectory, lambda: "enough" if LoopClock().now() - asked > stop_after else None
        )
        return reason, LoopClock().now()

    reason, took = run_simulated(work())
    positions, velocities = world.wanted()
    first, way = np.array(PARKED), np.array(AWAY) - np.array(PARKED)
    share = (positions - first) / way
    assert reason == "enough"
    assert stop_after < took < stop_after + 0.6
    assert np.ptp(share) < 1e-9  # still on the straight joint line
    assert not velocities.any()
    assert np.abs(world.data.qvel[:6]).max() < 0.03
    rates = np.abs(np.diff(world._motion.velocities, axis=0)) / STEP  # noqa: SLF001
    limits = np.array(CELL.robot.limits.acceleration)
    assert (rates < 2.2 * limits).all()


def test_a_motion_that_is_cancelled_leaves_the_arm_at_rest() -> None:
    """Half way, without anybody waiting for it."""
    world = a_world()

    async def work() -> None:
        arm, _ = an_arm(world)
        motion = asyncio.ensure_future(arm.follow(point_to_point(PARKED, AWAY, 1.5)))
        await asyncio.sleep(0.7)
        motion.cancel()
        await asyncio.sleep(1.0)
        arm.joints()

    run_simulated(work())
    assert np.abs(world.data.qvel[:6]).max() < 1e-3
    assert 0.1 < abs(world.joints()[0] - PARKED[0]) < 0.8


def test_the_arm_refuses_while_a_safety_stop_is_active() -> None:
    """And moves again when it is over."""

    async def work() -> None:
        arm, safety = an_arm(a_world())
        safety.stopped = True
        with pytest.raises(DeviceError, match="a safety stop is active"):
            await arm.follow(point_to_point(PARKED, AWAY, 1.5))
        safety.stopped = False
        assert await arm.follow(point_to_point(PARKED, AWAY, 1.5)) is None

    run_simulated(work())


@pytest.mark.parametrize(
    ("start", "end", "seconds", "message"),
    [
        (AWAY, PARKED, 1.5, "begins 1.047 rad from where axis 4 stands"),
        (PARKED, radians(-70, -95, 110, 0, 60, 340), 1.5, "axis 6 at 1.32 times its greatest"),
        (PARKED, radians(-70, -95, 110, 0, 121, 0), 2.0, "axis 5 0.035 rad beyond its limits"),
    ],
)
def test_the_arm_refuses_what_it_cannot_do(
    start: Joints, end: Joints, seconds: float, message: str
) -> None:
    """And says which axis."""

    async def work() -> None:
        arm, _ = an_arm(a_world())
        with pytest.raises(DeviceError, match=message):
            await arm.follow(point_to_point(start, end, seconds))

    run_simulated(work())


def test_a_safety_stop_on_the_way_is_an_error() -> None:
    """The arm comes to rest on its path all the same."""
    world = a_world()

    async def work() -> None:
        arm, safety = an_arm(world)
        asyncio.get_running_loop().call_later(0.5, lambda: setattr(safety, "stopped", True))
        with pytest.raises(DeviceError, match="safety stop"):
            await arm.follow(point_to_point(PARKED, AWAY, 1.5))

    run_simulated(work())
    assert not world.wanted()[1].any()


def test_time_that_is_asked_for_twice_passes_once() -> None:
    """Nor does it run backwards."""
    world = a_world()
    world.advance(0.5)
    state = world.data.qpos.copy()
    world.advance(0.5)
    world.advance(0.2)
    assert world.now == pytest.approx(0.5)
    assert (world.data.qpos == state).all()


def test_a_world_in_which_nothing_moves_costs_no_steps() -> None:
    """An hour is free."""
    world = a_world()
    world.advance(1.0)
    before = world.steps
    world.advance(3600.0)
    assert world.steps == before
    assert world.now == pytest.approx(3600.0)


def test_the_same_commands_lead_to_the_same_bytes_however_often_one_asks() -> None:
    """Lazy steps are the same steps."""

    def run(pieces: int) -> bytes:
        world = a_world()
        world.begin(point_to_point(PARKED, AWAY, 1.0))
        for piece in range(1, pieces + 1):
            world.advance(1.2 * piece / pieces)
        return world.data.qpos.tobytes() + world.data.qvel.tobytes()

    assert run(1) == run(7) == run(100)


def test_an_arm_that_was_held_back_beyond_its_strength_catches_up() -> None:
    """Its servos saturate, and come back without striking from limit to limit."""
    world = a_world()
    world.begin(point_to_point(PARKED, AWAY, 1.0))
    tool = world.model.tool_body
    for step in range(200):
        world.data.xfrc_applied[tool] = (3e4, 3e4, -2e4, 5e3, 5e3, 5e3) if step < 60 else 0.0
        world.advance(world.now + 1.01 * STEP)
    world.data.xfrc_applied[tool] = 0.0
    world.advance(2.5)
    assert np.abs(np.array(world.joints()) - np.array(AWAY)).max() < 1e-3
    assert np.abs(world.data.qvel[:6]).max() < 1e-3


def test_broken_physics_is_an_error_and_no_reading() -> None:
    """Nothing goes on from numbers that are none."""
    world = a_world()
    world.data.warning[5].number = 1
    with pytest.raises(DeviceError, match="physics broke down"):
        world.advance(1.0)
