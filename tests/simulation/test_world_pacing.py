"""The arm's override: the tool no faster than a limit, on the same path, judged by physics."""

import asyncio

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from simulated_layouts import PARKED, delivery, layout, point_to_point, radians

from depal.domain import Joints
from depal.executive.clock import LoopClock, run_simulated
from depal.geometry import Pose
from depal.simulation.cases import cases_of
from depal.simulation.devices import SimulatedArm, SimulatedSafety
from depal.simulation.model import STEP
from depal.simulation.pacing import paced
from depal.simulation.servo import Motion, motion_along
from depal.simulation.world import World

AWAY = radians(-15, -102, 125, 60, 80, 30)
CELL = layout()
ALONG = point_to_point(PARKED, AWAY, 1.5)


def a_world() -> World:
    """A world with one box."""
    note = delivery(((0.4, 0.2, 0.0), (0.3, 0.3, 0.3), 5.0))
    return World(CELL, cases_of(note, note.stack or (), CELL))


class Tachometer:
    """Measures how fast the tool is, from where the world's bodies are."""

    def __init__(self, world: World) -> None:
        """Of this world."""
        self.world = world
        self.at: list[float] = []
        self.tips: list[list[tuple[float, float, float]]] = []

    async def watch(self, seconds: float, period: float = 0.01) -> None:
        """Looks every so often [s]."""
        for _ in range(int(seconds / period)):
            self.world.advance(LoopClock().now())
            self.at.append(self.world.now)
            self.tips.append([tip.translation for tip in tips(self.world)])
            await asyncio.sleep(period)

    def speeds(self, first: float, last: float) -> np.ndarray:
        """The greatest speed of any point, period by period [m/s]."""
        at, points = np.array(self.at), np.array(self.tips)
        speed = np.linalg.norm(np.diff(points, axis=0), axis=2).max(axis=1) / np.diff(at)
        return speed[(at[:-1] >= first) & (at[1:] <= last)]


def tips(world: World) -> list[Pose]:
    """Flange and faces of the tool, by MuJoCo's own bodies."""
    tool, flange = CELL.tool, world.flange()
    faces = [tool.module(each.name, folded=False).flange_from_face for each in tool.modules]
    return [flange, *(flange @ face for face in faces)]


def moved(*changes: tuple[float, str, float], seconds: float) -> tuple[Tachometer, Joints, float]:
    """Moves, while at some times the limit or the scanner's field changes."""

    async def work() -> tuple[Tachometer, Joints, float]:
        world, safety = a_world(), SimulatedSafety()
        arm, meter = SimulatedArm(world, LoopClock(), safety), Tachometer(world)
        watching = asyncio.ensure_future(meter.watch(seconds))

        def change(what: str, value: float) -> None:
            if what == "limit":
                arm.limit(value)
            else:
                safety.inside = bool(value)

        for at, what, value in changes:
            asyncio.get_running_loop().call_later(at, change, what, value)
        await asyncio.sleep(0.01)
        assert await arm.follow(ALONG) is None
        took = LoopClock().now()
        await watching
        return meter, arm.joints(), took

    return run_simulated(work())


@pytest.mark.parametrize("limit", [1.0, 0.25])
def test_the_tool_is_no_faster_than_its_limit(limit: float) -> None:
    """From the beginning, and the motion ends where it was to end."""
    meter, joints, took = moved((0.0, "limit", limit), seconds=14.0)
    speeds = meter.speeds(0.0, 14.0)
    assert 0.8 * limit < speeds.max() <= limit
    assert np.abs(np.array(joints) - np.array(AWAY)).max() < 1e-3
    assert took > 1.8


def test_a_limit_in_the_middle_slows_the_running_motion_and_lets_it_go_again() -> None:
    """Below the limit after half a second; afterwards it is as fast as planned."""
    meter, joints, _ = moved((0.5, "limit", 0.25), (2.0, "limit", np.inf), seconds=6.0)
    assert meter.speeds(0.0, 0.5).max() > 1.0
    assert meter.speeds(1.0, 2.0).max() <= 0.25
    assert meter.speeds(2.0, 6.0).max() > 0.5
    assert np.abs(np.array(joints) - np.array(AWAY)).max() < 1e-3


def test_in_the_protective_field_nothing_moves_and_then_it_goes_on_by_itself() -> None:
    """Whatever the software says: the arm's own controller sees the field."""
    changes = (0.6, "inside", 1.0), (0.7, "limit", 3.0), (4.0, "inside", 0.0)
    meter, joints, took = moved(*changes, seconds=6.0)
    assert meter.speeds(0.0, 0.6).max() > 1.0
    assert meter.speeds(1.4, 4.0).max() < 2e-3
    assert took > 4.0
    assert np.abs(np.array(joints) - np.array(AWAY)).max() < 1e-3


def test_a_motion_that_is_commanded_meanwhile_does_not_begin() -> None:
    """It waits on its first point."""
    meter, _, took = moved((0.0, "inside", 1.0), (2.0, "inside", 0.0), seconds=4.0)
    assert meter.speeds(0.0, 2.0).max() < 2e-3
    assert took > 3.0


def points(joints: np.ndarray) -> np.ndarray:
    """A tool whose one point is moved by the first three axes alone."""
    return joints[:, None, :3]


LIMITS = st.one_of(st.just(np.inf), st.just(0.0), st.floats(0.05, 3.0))


@settings(deadline=None)
@given(st.lists(st.tuples(st.integers(1, 400), LIMITS), min_size=1, max_size=5))
def test_whatever_the_limits_the_path_is_followed_within_them(
    changes: list[tuple[int, float]],
) -> None:
    """Never backwards, no jump of the rate, never faster than planned, and to its end at last."""
    limits = CELL.robot.limits
    motion, step = motion_along(ALONG, 0, STEP), 0
    for steps, most in [*changes, (1, np.inf)]:
        before = at(motion, step)
        motion = paced(motion, step, STEP, limits, most, points)
        assert at(motion, step)[0] == pytest.approx(before[0], abs=1e-12)
        assert np.all(np.diff(motion.path) >= -1e-12)
        assert np.all((motion.rates >= 0.0) & (motion.rates <= 1.0 + 1e-9))
        assert np.abs(np.diff(motion.rates)).max(initial=0.0) <= 10.0 * STEP + 1e-6
        drift = np.diff(motion.path) / STEP - (motion.rates[:-1] + motion.rates[1:]) / 2
        assert np.abs(drift[:-1]).max(initial=0.0) < 0.02
        assert motion.whole or motion.rates[-1] == 0.0  # so near to its end it comes to it
        assert motion.whole or most == 0.0
        step += steps
    assert motion.whole
    assert motion.path[-1] == ALONG.duration


def at(motion: Motion, step: int) -> tuple[float, float]:
    """Where it is along its trajectory [s], and at which rate."""
    row = motion.row(step)
    return float(motion.path[row]), float(motion.rates[row])
