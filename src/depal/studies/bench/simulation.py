"""The simulated cell: how fast it runs, how still a stack stands, how true servos and suction are.

Measured in the default cell with the largest delivery that ships.
"""

import itertools
import time
from collections.abc import Callable
from dataclasses import replace
from statistics import median

import numpy as np

from depal.cell.files import shipped_cell
from depal.domain import (
    FRONT,
    LOWER,
    CellLayout,
    Delivery,
    DeliveryLine,
    Gtin,
    Joints,
    Product,
    StackedCase,
)
from depal.geometry import Pose, Vector3
from depal.logistics import shipped_deliveries
from depal.ports import Trajectory
from depal.simulation import SimulatedCell, World, build, cases_of
from depal.studies.bench.figure import Figure
from depal.studies.bench.memory import peak_megabytes
from depal.studies.sweep import Progress, no_progress

BOXES = 40
"""Figures of a stack are for this many boxes."""

REACHING: Joints = (0.0, -1.0472, 1.0472, 0.0, 0.0, 0.0)
"""The tool held level before the pallet [rad]."""

_FULL_SPEED = 1.875
"""The peak of a fifth degree motion's rate, by its mean."""


def bench_simulation(progress: Progress = no_progress) -> list[Figure]:
    """Measures every figure of the simulated cell.

    Args:
        progress: told how far it is.

    Returns:
        The figures, medians over repetitions where the name says nothing else.
    """
    measures: list[Callable[[], list[Figure]]] = [
        lambda: [_moving(), _awake(), _settled()],
        lambda: [_drift()],
        lambda: [_lag()],
        lambda: [_break(*case) for case in BREAKS],
        lambda: [_look()],
        lambda: [_memory()],
    ]
    figures: list[Figure] = []
    for done, measure in enumerate(measures):
        progress(done, len(measures))
        figures += measure()
    progress(len(measures), len(measures))
    return figures


def stack_of(boxes: int = BOXES) -> SimulatedCell:
    """The default cell with the lowest boxes of the largest delivery that ships."""
    delivery = max(shipped_deliveries(), key=lambda note: len(note.stack or ()))
    stack = sorted(delivery.stack or (), key=lambda case: case.corner[2])
    return build(shipped_cell(), replace(delivery, stack=tuple(stack[:boxes])))


def _moving(repetitions: int = 5) -> Figure:
    cell = stack_of()
    there, back = _sweep(cell.world.layout)
    rates = []
    for number in range(repetitions):
        motion = cell.world.begin(back if number % 2 else there)
        start, begun = time.perf_counter(), cell.world.now
        cell.world.advance(cell.world.ending(motion))
        rates.append((cell.world.now - begun) / (time.perf_counter() - start))
    name = f"{BOXES} boxes, the arm moving"
    return Figure(name, median(rates), "x real time", 4.0, "higher", repetitions)


def _awake(seconds: float = 1.0) -> Figure:
    """The whole stack kept awake beside the moving arm: the worst that can be."""
    cell = stack_of()
    there, _ = _sweep(cell.world.layout)
    cell.world.begin(there)
    start = time.perf_counter()
    while cell.world.now < seconds:
        cell.world.refresh()
        cell.world.advance(cell.world.now + 0.02)
    rate = seconds / (time.perf_counter() - start)
    name = f"{BOXES} boxes, all awake and the arm moving"
    return Figure(name, rate, "x real time", 2.0, "higher", 1)


def _settled(seconds: float = 1000.0) -> Figure:
    cell = stack_of()
    start = time.perf_counter()
    cell.world.advance(seconds)
    cost = 1e3 * (time.perf_counter() - start) / seconds
    name = f"{BOXES} settled boxes, one simulated second"
    return Figure(name, cost, "ms", 20.0, "lower", 1)


def _drift(seconds: float = 10.0) -> Figure:
    """Kept awake: asleep nothing could drift."""
    cell = stack_of()
    while cell.world.now < seconds:
        cell.world.refresh()
        cell.world.advance(cell.world.now + 0.1)
    name = f"drift of {BOXES} settled boxes in {seconds:.0f} s"
    return Figure(name, 1e3 * cell.referee.moved(), "mm", 1.0, "lower", BOXES)


def _lag() -> Figure:
    cell = stack_of(1)
    there, _ = _sweep(cell.world.layout)
    world = cell.world
    motion, lag = world.begin(there), 0.0
    while world.now < world.ending(motion):
        world.advance(world.now + 0.002)
        wanted, _ = world.wanted()
        lag = max(lag, float(np.abs(np.array(world.joints()) - wanted).max()))
    return Figure("lag of the servos at full speed", float(np.degrees(lag)), "deg", 0.2, "lower", 1)


BREAKS: tuple[tuple[str, str, Vector3, Vector3, Vector3], ...] = (
    ("pull", LOWER, (0.4, 0.3, 0.2), (0.0, 0.0, -600.0), (0.0, 0.0, 0.0)),
    ("shear", LOWER, (0.4, 0.3, 0.1), (250.0, 150.0, 0.0), (0.0, 0.0, 0.0)),
    ("peel", LOWER, (0.4, 0.3, 0.1), (0.0, 0.0, 0.0), (0.0, 60.0, 0.0)),
    ("peel", FRONT, (0.1, 0.4, 0.3), (0.0, 0.0, 0.0), (0.0, 60.0, 0.0)),
)
"""What is pulled how: the module, the box, and the load that grows to this [N], [N m]."""


def _break(kind: str, module: str, size: Vector3, force: Vector3, moment: Vector3) -> Figure:
    """The load at which a hold gives way, against statics done by hand."""
    layout, mass = shipped_cell(), 5.0
    world = _hanging(layout, module, size, mass)
    suction = layout.tool.suction
    pull, weight = suction.cup_force * len(layout.tool.module(module).cups), 9.81 * mass
    edge = 0.05 + suction.cup_radius
    own = weight * size[0] / 2 if module == FRONT else 0.0
    beside = 0.0 if module == FRONT else weight
    expected = {
        "pull": pull - weight,
        "shear": suction.friction * (pull - weight),
        "peel": (pull - beside) * edge - own,
    }[kind]
    share = _load_until_it_breaks(world, module, force, moment)
    loaded = share * float(np.linalg.norm(force) + np.linalg.norm(moment))
    error = 100 * abs(loaded / expected - 1)
    return Figure(f"suction breaks by {kind}, {module}, off theory", error, "%", 10.0, "lower", 1)


def _hanging(layout: CellLayout, module: str, size: Vector3, mass: float) -> World:
    """A world in which one box hangs on a module."""
    product = Product(Gtin("10000000000000"), "case", size, mass)
    case = StackedCase(product.gtin, (0.2, 0.2, 0.0), size)
    note = Delivery("one", layout.pallet.size, (DeliveryLine(product, 1),), (case,))
    world = World(layout, cases_of(note, (case,), layout), joints=REACHING)
    face = layout.tool.module(module).flange_from_face
    normal = np.array(face.rotation)[:, 0]
    reach = float(np.abs(normal) @ np.array(size)) / 2
    x, y, z = (np.array(face.translation) + normal * reach).tolist()
    world.place_box(0, world.flange() @ Pose((x, y, z)))
    cups = range(len(layout.tool.module(module).cups))
    world.suction.open_valves(tuple((module, cup) for cup in cups), -1.0)
    world.suction.grip(world.now)
    world.advance(world.now + 0.3)
    return world


def _load_until_it_breaks(world: World, module: str, force: Vector3, moment: Vector3) -> float:
    """The share of a load, through the middle of the cups, at which the hold gives way."""
    data, body, tool = world.data, world.model.box_bodies[0], world.model.tool_body
    middle = np.array(world.layout.tool.module(module).flange_from_face.translation)
    for step in itertools.count():
        if world.broken:
            return step / 1000
        push = step / 1000 * np.array(force)
        point = data.xpos[tool] + data.xmat[tool].reshape(3, 3) @ middle
        turn = step / 1000 * np.array(moment) + np.cross(point - data.xpos[body], push)
        data.xfrc_applied[body] = (*push, *turn)
        world.wake()
        world.advance(world.now + 0.0021)
    return float("nan")


def _look(repetitions: int = 20) -> Figure:
    cell = stack_of()
    cell.sight.perceived(0)
    seconds = []
    for number in range(1, repetitions + 1):
        start = time.perf_counter()
        cell.sight.perceived(number)
        seconds.append(time.perf_counter() - start)
    name = f"a look at {BOXES} boxes from the truth"
    return Figure(name, 1e3 * median(seconds), "ms", 50.0, "lower", repetitions)


def _memory() -> Figure:
    return Figure("peak memory of the process", peak_megabytes(), "MB", 1500.0, "lower", 1)


def _sweep(layout: CellLayout) -> tuple[Trajectory, Trajectory]:
    """A joint motion over the free middle of the cell at the full speed of axis 1, and back."""
    start = np.array(layout.robot.parked)
    end = start + np.array([1.0, -0.1, 0.2, 0.8, 0.2, 0.6])
    seconds = float(np.max(np.abs(end - start) / np.array(layout.robot.limits.speed)))
    seconds *= _FULL_SPEED
    u = np.linspace(0.0, 1.0, 101)
    share, rate = 10 * u**3 - 15 * u**4 + 6 * u**5, 30 * u**2 * (1 - u) ** 2 / seconds
    way = end - start
    there = Trajectory(u * seconds, start + np.outer(share, way), np.outer(rate, way))
    back = Trajectory(u * seconds, end - np.outer(share, way), -np.outer(rate, way))
    return there, back
