"""A box is taken and set down through the ports, to the same bytes each time."""

import asyncio
from dataclasses import replace

import pytest
from simulated_layouts import REACHING, delivery, layout
from simulated_worlds import ALL, shifted

from depal.domain import FRONT, Tool
from depal.executive.clock import run_simulated
from depal.geometry import OrientedBox, Vector3
from depal.ports import Guard
from depal.simulation import SimulatedCell, build

CELL = layout()
TALL = 1.402  # so that a box on it stands before the tool at REACHING


def a_cell(mass: float = 5.0) -> SimulatedCell:
    """A box on a board, its front 0.1 m before the cups."""
    board = OrientedBox.upright((2.22, 0.0, 0.144 + TALL - 0.02), (0.3, 0.4, 0.04))
    box = ((0.45, 0.665, TALL), (0.3, 0.3, 0.3), mass)
    reaching = replace(CELL.robot, parked=REACHING)
    return build(replace(CELL, robot=reaching, fixtures=(board,)), delivery(box), seed=3)


async def go(
    cell: SimulatedCell, way: Vector3, seconds: float, guard: Guard | None = None
) -> str | None:
    """A straight part: the held box may touch."""
    motion = replace(shifted(cell.world, way, seconds), allowances=((0.0, seconds),))
    return await cell.arm.follow(motion, guard)


async def pick_and_place(cell: SimulatedCell) -> tuple[list[float], str | None]:
    """Forward, suck, lift, back, forward again, down until the load says so, release, back."""
    loads, mass = [], cell.world.cases[0].mass
    await go(cell, (0.1, 0.0, 0.0), 0.5)
    assert await cell.gripper.suck(tuple((FRONT, cup) for cup in ALL))
    await go(cell, (0.0, 0.0, 0.015), 0.5)
    await go(cell, (-0.15, 0.0, 0.0), 0.8)
    await asyncio.sleep(0.3)
    loads.append(cell.arm.load())
    assert cell.referee.where(0) == "hand"
    await go(cell, (0.15, 0.0, 0.0), 0.8)
    landed = await go(
        cell, (0, 0, -0.03), 1.5, lambda: "landed" if cell.arm.load() < mass / 2 else None
    )
    await cell.gripper.release()
    loads.append(cell.arm.load())
    await go(cell, (-0.15, 0.0, 0.0), 0.8)
    await asyncio.sleep(1.0)
    cell.arm.joints()
    return loads, landed


@pytest.mark.parametrize("mass", [1.0, 5.0, 12.0])
def test_a_box_is_taken_weighed_and_set_down_without_collision_or_loss(mass: float) -> None:
    """It stands where it stood, to a few millimetres; its own weight is no collision."""
    cell = a_cell(mass)
    before = cell.world.box(0).translation
    (held, free), landed = run_simulated(pick_and_place(cell))
    summary = cell.referee.summary()
    assert held == pytest.approx(mass, abs=0.1)
    assert free == pytest.approx(0.0, abs=0.1)
    assert landed == "landed"
    assert summary.collisions == ()
    assert summary.lost == ()
    assert summary.greatest_force < 50.0
    assert cell.world.box(0).translation == pytest.approx(before, abs=0.004)


def test_the_same_seed_leads_to_the_same_bytes() -> None:
    """State and readings."""

    def run() -> tuple[bytes, list[float], bytes]:
        cell = a_cell()
        loads, _ = run_simulated(pick_and_place(cell))
        return cell.world.data.qpos.tobytes(), loads, cell.world.snapshot().boxes.tobytes()

    assert run() == run()


def test_the_tool_of_the_tests_keeps_its_solids_behind_the_planes_of_touch() -> None:
    """Or the cups would never be what touches first."""
    tool: Tool = CELL.tool
    for folded, shapes in ((False, tool.shapes), (True, tool.folded_shapes)):
        for module in tool.modules:
            face = tool.module(module.name, folded=folded).flange_from_face.inverse
            ahead = max(face.apply(tuple(corner))[0] for s in shapes for corner in s.corners)
            assert ahead <= -tool.suction.stroke
