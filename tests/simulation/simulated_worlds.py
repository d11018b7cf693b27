"""Worlds for the tests of the simulated cell: a few boxes, one of them in the hand."""

import mujoco
import numpy as np
from scipy.interpolate import CubicSpline
from simulated_layouts import REACHING, delivery, layout

from depal.domain import FRONT, Joints
from depal.geometry import Pose, Vector3
from depal.ports import Trajectory
from depal.simulation.cases import cases_of
from depal.simulation.world import World

CELL = layout()
ALL = tuple(range(6))


def world_of(*cases: tuple[Vector3, Vector3, float], joints: Joints = REACHING) -> World:
    """A world of (corner, size, mass) on the pallet, the arm reaching out."""
    note = delivery(*cases)
    return World(CELL, cases_of(note, note.stack or (), CELL), joints=joints)


def hanging(
    module: str,
    size: Vector3,
    mass: float,
    cups: tuple[int, ...] = ALL,
    shift: Vector3 = (0.0, 0.0, 0.0),
    others: tuple[tuple[Vector3, Vector3, float], ...] = (),
) -> World:
    """A world in which one box hangs on a module, its face in the plane of the cups."""
    world = world_of(((0.4, 0.2, 0.0), size, mass), *others)
    middle = (0.2 + size[0] / 2, 0.0, 0.0) if module == FRONT else (0.1, 0.0, -0.2 - size[2] / 2)
    x, y, z = (a + b for a, b in zip(middle, shift, strict=True))
    world.place_box(0, world.flange() @ Pose((x, y, z)))
    world.suction.open_valves(tuple((module, cup) for cup in cups), -1.0)
    assert world.suction.grip(world.now)
    world.advance(0.2)
    return world


def shifted(world: World, way: Vector3, seconds: float) -> Trajectory:
    """A motion that carries the flange along a straight line, without turning it."""
    steps = max(int(np.linalg.norm(way) / 0.002), 5)
    mj, data = world.model.mj, mujoco.MjData(world.model.mj)
    path = [world.wanted()[0]]
    for _ in range(steps):
        path.append(path[-1] + _rates(mj, data, path[-1], int(world.model.tool_body), way) / steps)
    u = np.linspace(0.0, 1.0, steps + 1)
    share, rate = 10 * u**3 - 15 * u**4 + 6 * u**5, 30 * u**2 * (1 - u) ** 2 / seconds
    line = CubicSpline(u, np.array(path))
    return Trajectory(u * seconds, line(share), line(share, 1) * rate[:, None])


def _rates(
    mj: mujoco.MjModel, data: mujoco.MjData, joints: np.ndarray, body: int, way: Vector3
) -> np.ndarray:
    """Rates of the axes at which the flange moves at `way` per second."""
    data.qpos[:6] = joints
    mujoco.mj_kinematics(mj, data)
    mujoco.mj_comPos(mj, data)
    moving, turning = np.zeros((3, mj.nv)), np.zeros((3, mj.nv))
    mujoco.mj_jacBody(mj, data, moving, turning, body)
    both = np.vstack((moving[:, :6], turning[:, :6]))
    return np.linalg.lstsq(both, np.array([*way, 0, 0, 0]), rcond=1e-6)[0]
