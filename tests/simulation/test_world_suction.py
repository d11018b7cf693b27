"""Suction holds up to its limits and lets go beyond them."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from simulated_worlds import ALL, CELL, hanging, shifted, world_of

from depal.domain import FRONT, LOWER
from depal.domain.cup_group import Break, CupGroup
from depal.executive.clock import LoopClock, run_simulated
from depal.geometry import Pose, Vector3
from depal.simulation.devices import SimulatedGripper
from depal.simulation.model import STEP
from depal.simulation.world import World

CUP = 85.0


def load_until_it_breaks(
    world: World, force: Vector3, moment: Vector3 = (0, 0, 0)
) -> tuple[float, Break]:
    """Loads the box with a growing force through the middle of the cups, in the cell's axes."""
    data, body, tool = world.data, world.model.box_bodies[0], world.model.tool_body
    module = world.suction.holds[0].cups[0][0]
    middle = np.array(CELL.tool.module(module).flange_from_face.translation)
    share = 0.0
    while not world.broken:
        share += 1 / 800
        push = share * np.array(force)
        point = data.xpos[tool] + data.xmat[tool].reshape(3, 3) @ middle
        data.xfrc_applied[body, :3] = push
        data.xfrc_applied[body, 3:] = share * np.array(moment) + np.cross(
            point - data.xpos[body], push
        )
        world.wake()
        world.advance(world.now + 1.01 * STEP)
        assert share < 2.0, "it holds for ever"
    return share, world.broken[0].why


def test_a_pull_beyond_area_times_vacuum_breaks_the_hold() -> None:
    """The weight of the box pulls too."""
    world = hanging(LOWER, (0.3, 0.3, 0.2), 5.0)
    share, _ = load_until_it_breaks(world, (0, 0, -500))
    assert share * 500 + 5 * 9.81 == pytest.approx(6 * CUP, rel=0.1)


def test_a_shear_beyond_friction_breaks_the_hold() -> None:
    """The weight takes from the pressure that friction needs."""
    world = hanging(LOWER, (0.3, 0.3, 0.1), 8.0)
    share, why = load_until_it_breaks(world, (200, 100, 0))
    assert share * math.hypot(200, 100) == pytest.approx(0.5 * (6 * CUP - 8 * 9.81), rel=0.1)
    assert why is Break.SHEAR


@pytest.mark.parametrize(("axis", "reach"), [(1, 0.08), (2, 0.13)])
def test_a_moment_that_lifts_an_edge_breaks_the_hold(axis: int, reach: float) -> None:
    """The box tips about the lips' other edge."""
    world = hanging(FRONT, (0.1, 0.3, 0.3), 1.0)
    moment = [0.0, 0.0, 0.0]
    moment[axis] = 80.0
    x, y, z = moment
    share, why = load_until_it_breaks(world, (0, 0, 0), (x, y, z))
    own = 9.81 * 0.05 if axis == 1 else 0.0
    assert share * 80.0 + own == pytest.approx(6 * CUP * reach, rel=0.1)
    assert why is Break.PEEL


@pytest.mark.parametrize("rise", [12.0, 20.0])
def test_a_box_of_20_kg_is_lost_by_an_acceleration_beyond_theory_and_by_no_less(
    rise: float,
) -> None:
    """Upwards, hanging below the tool: 6 cups of 85 N hold 15.7 m/s^2."""
    world = hanging(LOWER, (0.35, 0.35, 0.1), 20.0)
    limit = 6 * CUP / 20.0 - 9.81
    distance = 0.15
    seconds = math.sqrt(5.7735 * distance / rise)  # the peak of a fifth degree rise
    world.begin(shifted(world, (0, 0, distance), seconds))
    world.advance(world.now + seconds + 0.3)
    assert bool(world.broken) == (rise > limit)


@given(
    cups=st.lists(st.tuples(st.floats(-0.1, 0.1), st.floats(-0.1, 0.1)), min_size=1, max_size=8),
    force=st.tuples(st.floats(-300, 300), st.floats(-300, 300), st.floats(-300, 300)),
    moment=st.tuples(st.floats(-9, 9), st.floats(-9, 9), st.floats(-9, 9)),
    more=st.floats(1.0, 3.0),
)
@settings(deadline=None, max_examples=200)
def test_more_vacuum_never_holds_less_and_more_load_never_holds_better(
    cups: list[tuple[float, float]], force: Vector3, moment: Vector3, more: float
) -> None:
    """For any group of cups."""
    group = CupGroup.of(np.array(cups), 0.03, 0.5)
    vacuum = CUP * len(cups)
    push, turn = np.array(force), np.array(moment)
    if group.load_share(push, turn, vacuum)[0] <= 1.0:
        assert group.load_share(push, turn, more * vacuum)[0] <= 1.0 + 1e-9
    elif push[0] >= 0:
        assert group.load_share(more * push, more * turn, vacuum)[0] > 1.0 - 1e-9


def test_the_load_cell_weighs_what_hangs() -> None:
    """Without bias, with a little noise."""
    world = hanging(FRONT, (0.3, 0.3, 0.3), 7.3)
    readings = [world.load() for _ in range(50)]
    assert np.mean(readings) == pytest.approx(7.3, abs=0.05)
    assert 0.002 < np.std(readings) < 0.05


def test_a_held_box_sags_less_than_a_millimetre_for_five_kilograms() -> None:
    """Bellows of 10 N/mm each, six of them."""
    world = hanging(FRONT, (0.3, 0.3, 0.3), 5.0)
    sag = world.box(0).translation[2] - world.flange().translation[2]
    assert -0.001 < sag < 0.0


def test_vacuum_rises_holds_and_is_gone_after_release() -> None:
    """And the box with it."""

    async def work() -> list[float]:
        world = hanging(FRONT, (0.3, 0.3, 0.3), 5.0)
        gripper = SimulatedGripper(world, LoopClock())
        readings = [gripper.vacuum()[FRONT]]
        await gripper.release()
        readings.append(gripper.vacuum()[FRONT])
        assert world.suction.held_boxes == ()
        return readings

    full, vented = run_simulated(work(), start=0.2)
    assert full == pytest.approx(CELL.tool.suction.vacuum)
    assert vented == 0.0


@pytest.mark.parametrize(
    ("shift", "cups", "expected"),
    [
        ((0, 0, 0), ALL, True),
        ((0.009, 0, 0), ALL, True),  # within the bellows' stroke
        ((0.012, 0, 0), ALL, False),  # beyond it
        ((0, 0.04, 0), ALL, False),  # two cups beside the box: they leak
        ((0, 0.04, 0), (1, 2, 4, 5), True),  # those two left shut
    ],
)
def test_vacuum_stands_where_the_cups_lie_wholly_on_a_face(
    shift: Vector3, cups: tuple[int, ...], *, expected: bool
) -> None:
    """Within the stroke of the bellows; open cups beside the face leak."""

    async def work() -> bool:
        world = world_of(((0.4, 0.2, 0.0), (0.3, 0.3, 0.3), 5.0))
        world.model.mj.opt.gravity[2] = 0.0
        x, y, z = shift
        world.place_box(0, world.flange() @ Pose((0.35 + x, y, z)))
        gripper = SimulatedGripper(world, LoopClock())
        return await gripper.suck(tuple((FRONT, cup) for cup in cups))

    assert run_simulated(work()) is expected


def test_a_broken_hold_leaks() -> None:
    """The sensor, the load cell and the box tell of it."""
    world = hanging(FRONT, (0.3, 0.3, 0.3), 5.0)
    world.suction.detach(0, world.now)
    world.wake()
    world.advance(world.now + 0.5)
    assert world.suction.vacuum(world.now)[FRONT] == 0.0
    assert world.load() == pytest.approx(0.0, abs=0.06)
    assert world.box(0).translation[2] < 1.0


def test_a_valve_that_is_stuck_does_not_let_go() -> None:
    """A fault for the executive to notice: the sensor still reads a vacuum."""

    async def work() -> dict[str, float]:
        world = hanging(FRONT, (0.3, 0.3, 0.3), 5.0)
        world.suction.stuck = True
        gripper = SimulatedGripper(world, LoopClock())
        await gripper.release()
        assert world.suction.held_boxes == (0,)
        return gripper.vacuum()

    assert run_simulated(work(), start=0.2)[FRONT] == pytest.approx(CELL.tool.suction.vacuum)


@pytest.mark.parametrize(("supply", "expected"), [(0.85, True), (0.7, False)])
def test_a_weak_pump_is_noticed_below_four_fifths_of_the_vacuum(
    supply: float, *, expected: bool
) -> None:
    """Though the box hangs."""
    world = world_of(((0.4, 0.2, 0.0), (0.3, 0.3, 0.3), 2.0))
    world.place_box(0, world.flange() @ Pose((0.35, 0.0, 0.0)))
    world.suction.supply = supply
    world.suction.open_valves(tuple((FRONT, cup) for cup in ALL), -1.0)
    assert world.suction.grip(world.now) is expected
    assert world.suction.held_boxes == (0,)
