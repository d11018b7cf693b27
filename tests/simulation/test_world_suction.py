"""Suction holds up to its limits and lets go beyond them."""

import math

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from simulated_layouts import REACHING, delivery, layout, point_to_point

from depal.domain import FRONT, LOWER, Joints
from depal.executive.clock import LoopClock, run_simulated
from depal.geometry import Pose, Vector3
from depal.ports import Trajectory
from depal.simulation.cases import cases_of
from depal.simulation.devices import SimulatedGripper
from depal.domain.cup_group import Break, CupGroup
from depal.simulation.model import STEP
from depal.simulation.world import World

CELL = layout()
CUP = 85.0
ALL = tuple(range(6))


def hanging(
    module: str,
    size: Vector3,
    mass: float,
    cups: tuple[int, ...] = ALL,
    shift: Vector3 = (0.0, 0.0, 0.0),
) -> World:
    """A world in which one box hangs on a module, its face in the plane of the cups."""
    note = delivery(((0.4, 0.2, 0.0), size, mass))
    world = World(CELL, cases_of(note, note.stack or (), CELL), joints=REACHING)
    middle = (0.2 + size[0] / 2, 0.0, 0.0) if module == FRONT else (0.1, 0.0, -0.2 - size[2] / 2)
    x, y, z = (a + b for a, b in zip(middle, shift, strict=True))
    world.place_box(0, world.flange() @ Pose((x, y, z)))
    world.suction.open_valves(tuple((module, cup) for cup in cups), -1.0)
    assert world.suction.grip(world.now)
    world.advance(0.2)
    return world


def load_until_it_breaks(
    world: World, force: Vector3, moment: Vector3 = (0, 0, 0)
) -> tuple[float, Break]:
    """Loads the box with a growing force through the middle of the cups, in the cell's axes."""
    data, body, tool = world.data, world.model.box_bodies[0], world.model.tool_body
    hold = world.suction.holds[0]
    share = 0.0
    while not world.broken:
        share += 1 / 800
        push = share * np.array(force)
        point = data.xpos[tool] + data.xmat[tool].reshape(3, 3) @ hold.middle
        data.xfrc_applied[body, :3] = push
        data.xfrc_applied[body, 3:] = share * np.array(moment) + np.cross(
            point - data.xpos[body], push
        )
        world.wake()
        world.advance(world.now + 1.01 * STEP)
        assert share < 2.0, "it holds for ever"
    return share, world.broken[0].why


def test_a_pull_beyond_area_times_vacuum_breaks_the_hold() -> None:
    """A pull beyond area times vacuum breaks the hold."""
    world = hanging(LOWER, (0.3, 0.3, 0.2), 5.0)
    share, _ = load_until_it_breaks(world, (0, 0, -500))
    assert share * 500 + 5 * 9.81 == pytest.approx(6 * CUP, rel=0.1)


def test_a_shear_beyond_friction_breaks_the_hold() -> None:
    """A shear beyond friction breaks the hold."""
    world = hanging(LOWER, (0.3, 0.3, 0.1), 8.0)
    share, why = load_until_it_breaks(world, (200, 100, 0))
    assert share * math.hypot(200, 100) == pytest.approx(0.5 * (6 * CUP - 8 * 9.81), rel=0.1)
    assert why is Break.SHEAR


@pytest.mark.parametrize(("axis", "reach", "second"), [(1, 0.08, 0.00295), (2, 0.13, 0.00712)])
def test_a_moment_that_lifts_an_edge_breaks_the_hold(
    axis: int, reach: float, second: float
) -> None:
    """A moment that lifts an edge breaks the hold."""
    world = hanging(FRONT, (0.1, 0.3, 0.3), 1.0)
    moment = [0.0, 0.0, 0.0]
    moment[axis] = 50.0
    x, y, z = moment
    share, why = load_until_it_breaks(world, (0, 0, 0), (x, y, z))
    own = 9.81 * 0.05 if axis == 1 else 0.0
    assert share * 50.0 + own == pytest.approx(6 * CUP * second / reach, rel=0.1)
    assert why is Break.PEEL


@pytest.mark.parametrize("rise", [12.0, 20.0])
def test_a_box_of_20_kg_is_lost_by_an_acceleration_beyond_theory_and_by_no_less(
    rise: float,
) -> None:
    """A box of 20 kg is lost by an acceleration beyond theory and by no less."""
    world = hanging(LOWER, (0.35, 0.35, 0.1), 20.0)
    limit = 6 * CUP / 20.0 - 9.81
    distance = 0.01
    seconds = math.sqrt(5.7735 * distance / rise)  # the peak of a fifth degree rise
    start = np.array(REACHING)
    height = _rates_upwards(world)
    end = start + height * distance
    world.begin(_through(start, end, seconds))
    world.advance(world.now + seconds + 0.3)
    assert bool(world.broken) == (rise > limit)


def _rates_upwards(world: World) -> np.ndarray:
    """Rates of the joints at which the flange rises by 1 m/s without turning."""
    mj, data = world.model.mj, world.data
    jacobian, turning = np.zeros((3, mj.nv)), np.zeros((3, mj.nv))
    mujoco.mj_jacBody(mj, data, jacobian, turning, int(world.model.tool_body))
    both = np.vstack((jacobian[:, :6], turning[:, :6]))
    return np.linalg.lstsq(both, np.array([0, 0, 1.0, 0, 0, 0]), rcond=1e-6)[0]


def _through(start: np.ndarray, end: np.ndarray, seconds: float) -> Trajectory:
    def joints(row: np.ndarray) -> Joints:
        a, b, c, d, e, f = row.tolist()
        return (a, b, c, d, e, f)

    return point_to_point(joints(start), joints(end), seconds)


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
    """More vacuum never holds less and more load never holds better."""
    group = CupGroup.of(np.array(cups), 0.03, 0.5)
    vacuum = CUP * len(cups)
    push, turn = np.array(force), np.array(moment)
    if group.load_share(push, turn, vacuum)[0] <= 1.0:
        assert group.load_share(push, turn, more * vacuum)[0] <= 1.0 + 1e-9
    elif push[0] >= 0:
        assert group.load_share(more * push, more * turn, vacuum)[0] > 1.0 - 1e-9


def test_the_load_cell_weighs_what_hangs() -> None:
    """The load cell weighs what hangs."""
    world = hanging(FRONT, (0.3, 0.3, 0.3), 7.3)
    readings = [world.load() for _ in range(50)]
    assert np.mean(readings) == pytest.approx(7.3, abs=0.05)
    assert 0.002 < np.std(readings) < 0.05


def test_a_held_box_sags_less_than_a_millimetre_for_five_kilograms() -> None:
    """A held box sags less than a millimetre for five kilograms."""
    world = hanging(FRONT, (0.3, 0.3, 0.3), 5.0)
    sag = world.box(0).translation[2] - world.flange().translation[2]
    assert -0.001 < sag < 0.0


def test_vacuum_rises_holds_and_is_gone_after_release() -> None:
    """Vacuum rises holds and is gone after release."""

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
    """Vacuum stands where the cups lie wholly on a face."""

    async def work() -> bool:
        note = delivery(((0.4, 0.2, 0.0), (0.3, 0.3, 0.3), 5.0))
        world = World(CELL, cases_of(note, note.stack or (), CELL), joints=REACHING)
        world.model.mj.opt.gravity[2] = 0.0
        x, y, z = shift
        world.place_box(0, world.flange() @ Pose((0.35 + x, y, z)))
        gripper = SimulatedGripper(world, LoopClock())
        return await gripper.suck(tuple((FRONT, cup) for cup in cups))

    assert run_simulated(work()) is expected


def test_a_broken_hold_leaks() -> None:
    """A broken hold leaks."""
    world = hanging(FRONT, (0.3, 0.3, 0.3), 5.0)
    world.suction.detach(0, world.now)
    world.wake()
    world.advance(world.now + 0.5)
    assert world.suction.vacuum(world.now)[FRONT] == 0.0
    assert world.load() == pytest.approx(0.0, abs=0.06)
    assert world.box(0).translation[2] < 1.0
