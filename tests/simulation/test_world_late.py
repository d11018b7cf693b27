"""A loop that is late: what the arm's own controller watches is not."""

import asyncio
from dataclasses import replace

import pytest
from simulated_layouts import PARKED, REACHING, delivery, layout, point_to_point, radians
from simulated_worlds import ALL, shifted

from depal.domain import FRONT
from depal.executive.clock import LoopClock, SimulatedLoop
from depal.geometry import OrientedBox, Vector3
from depal.ports import STANDS, Guard, Watch
from depal.simulation import SimulatedCell, build

CELL = layout()
AWAY = radians(-15, -102, 125, 60, 80, 30)
TALL = 1.402
BOARD = OrientedBox.upright((2.22, 0.0, 0.144 + TALL - 0.02), (0.3, 0.4, 0.04))


class LateLoop(SimulatedLoop):
    """Whoever sleeps on it wakes as much too late as the machine is busy."""

    late = 0.0

    def jump(self, seconds: float) -> None:
        """Moves the time on, by more than was asked for."""
        super().jump(max(seconds, self.late))


def late_by(seconds: float) -> asyncio.Runner:
    """Runs on such a loop [s]."""

    def loop() -> LateLoop:
        made = LateLoop()
        made.late = seconds
        return made

    return asyncio.Runner(loop_factory=loop)


async def set_down(cell: SimulatedCell, guard: Guard | None, watch: Watch | None) -> str | None:
    """A box that hangs on the cups is lowered until it stands."""

    async def go(way: Vector3, seconds: float) -> None:
        await cell.arm.follow(
            replace(shifted(cell.world, way, seconds), allowances=((0, seconds),))
        )

    await go((0.1, 0.0, 0.0), 0.5)
    assert await cell.gripper.suck(tuple((FRONT, cup) for cup in ALL))
    await go((0.0, 0.0, 0.015), 0.5)
    await asyncio.sleep(0.3)
    down = replace(shifted(cell.world, (0.0, 0.0, -0.03), 1.5), allowances=((0.0, 1.5),))
    return await cell.arm.follow(down, guard, watch)


def a_cell(mass: float) -> SimulatedCell:
    """A box on a board, its front 0.1 m before the cups."""
    note = delivery(((0.45, 0.665, TALL), (0.3, 0.3, 0.3), mass))
    reaching = replace(CELL.robot, parked=REACHING)
    return build(replace(CELL, robot=reaching, fixtures=(BOARD,)), note, seed=3)


@pytest.mark.parametrize("late", [0.0, 0.05, 0.2, 2.0])
@pytest.mark.parametrize("mass", [1.0, 5.0, 12.0])
def test_a_box_does_not_press_on_what_it_stands_on_however_late_the_loop_is(
    mass: float, late: float
) -> None:
    """As the watch stops the arm in its control period."""
    cell = a_cell(mass)
    with late_by(late) as runner:
        landed = runner.run(set_down(cell, None, Watch(load=mass / 2)))
    summary = cell.referee.summary()
    assert landed == STANDS
    assert summary.greatest_force < 50.0
    assert summary.collisions == ()


def test_a_guard_that_a_late_loop_asks_lets_the_box_press_on() -> None:
    """Which is why the watch is the arm's own: the control."""
    cell = a_cell(5.0)
    with late_by(0.1) as runner:
        guard = lambda: "landed" if cell.arm.load() < 2.5 else None  # noqa: E731 - handed over
        assert runner.run(set_down(cell, guard, None)) == "landed"
    assert cell.referee.summary().greatest_force > 50.0


def test_a_watch_sees_what_it_sees_even_where_the_loop_wakes_behind_the_end() -> None:
    """A motion that the watch has stopped has not come to its end."""
    cell = a_cell(5.0)
    with late_by(30.0) as runner:
        motion = point_to_point(REACHING, radians(10, -60, 60, 0, 0, 0), 2.0)
        watch = Watch(least=((FRONT, 1000.0),))  # there is no vacuum at all
        assert (
            runner.run(cell.arm.follow(motion, None, watch)) == "the vacuum broke: the box is lost"
        )
    assert abs(cell.world.joints()[0]) < 0.01


def test_an_arm_that_is_stopped_again_while_it_stops_comes_to_rest_no_later() -> None:
    """Nor does it speed up on the way."""
    cell = build(CELL, delivery(((0.4, 0.2, 0.0), (0.3, 0.3, 0.3), 5.0)))
    world = cell.world
    world.begin(point_to_point(PARKED, AWAY, 1.5))
    world.advance(0.7)
    first = world.stop()
    world.advance(0.8)
    assert world.stop() is first
    assert world.begin(point_to_point(PARKED, AWAY, 1.5)) is not first
    assert world.stop() is not first


def test_a_watch_holds_for_its_motion_only() -> None:
    """The next one begins without."""
    cell = build(CELL, delivery(((0.4, 0.2, 0.0), (0.3, 0.3, 0.3), 5.0)))

    async def work() -> tuple[str | None, str | None, float]:
        first = await cell.arm.follow(
            point_to_point(PARKED, PARKED, 0.5), None, Watch(least=((FRONT, 1.0),))
        )
        second = await cell.arm.follow(point_to_point(PARKED, AWAY, 1.5))
        return first, second, LoopClock().now()

    with late_by(0.0) as runner:
        first, second, _ = runner.run(work())
    assert first is not None
    assert second is None
