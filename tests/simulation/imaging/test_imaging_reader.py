"""The reader decodes the label that it is shown, and nothing else."""

import asyncio
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.cell.files import shipped_cell
from depal.domain import CellLayout
from depal.executive.clock import LoopClock, run_simulated
from depal.geometry import Pose
from depal.logistics import shipped_deliveries
from depal.simulation import SimulatedCell, build
from depal.simulation.imaging.mesh import face_pose
from depal.simulation.imaging.reader import SimulatedReader, codes_in
from depal.simulation.imaging.scene import Stage

TURN = math.radians(20)


@pytest.fixture(scope="module")
def layout() -> CellLayout:
    """The paper's cell."""
    return shipped_cell("default")


@pytest.fixture(scope="module")
def cell(layout: CellLayout) -> SimulatedCell:
    """A cell with a real delivery; each test puts back what it moves."""
    return build(layout, shipped_deliveries()[1])


@pytest.fixture(scope="module")
def reader(cell: SimulatedCell) -> SimulatedReader:
    """Its reader."""
    return SimulatedReader(Stage(cell.world), LoopClock())


def turned(axis: int, angle: float) -> Pose:
    """A turn about an axis."""
    first, second = [k for k in range(3) if k != axis]
    turn = np.eye(3)
    turn[first, first] = turn[second, second] = math.cos(angle)
    turn[first, second], turn[second, first] = -math.sin(angle), math.sin(angle)
    return Pose.from_arrays((0, 0, 0), turn)


def show(cell: SimulatedCell, box: int, side: int, ahead: float, turn: Pose | None = None) -> None:
    """The middle of a side on the reader's line of sight, the side turned about it."""
    at = cell.world.layout.reader.cell_from_reader @ Pose((0, 0, ahead)) @ (turn or Pose())
    face = face_pose(cell.world.cases[box].shape.size, side)
    cell.world.place_box(box, at @ face.inverse)


@settings(max_examples=20)
@given(
    box=st.integers(0, 24),
    side=st.integers(0, 3),
    ahead=st.floats(0.30, 0.40),
    turn=st.tuples(st.sampled_from((0, 1, 2)), st.floats(-TURN, TURN)),
    quarters=st.integers(0, 3),
)
def test_a_label_at_about_the_nominal_distance_is_decoded(
    cell: SimulatedCell,
    reader: SimulatedReader,
    box: int,
    side: int,
    ahead: float,
    turn: tuple[int, float],
    quarters: int,
) -> None:
    """50 mm nearer or farther, up to 20 degrees about any axis, whichever way the box hangs."""
    home = cell.world.box(box)
    show(cell, box, side, ahead, turned(*turn) @ turned(2, quarters * math.pi / 2))
    codes = codes_in(reader.picture())
    cell.world.place_box(box, home)
    assert codes == (cell.world.cases[box].gtin,)


@settings(max_examples=10)
@given(box=st.integers(0, 24), side=st.integers(4, 5), ahead=st.floats(0.25, 0.5))
def test_nothing_is_decoded_where_no_label_faces_the_reader(
    cell: SimulatedCell, reader: SimulatedReader, box: int, side: int, ahead: float
) -> None:
    """Top and bottom carry none."""
    home = cell.world.box(box)
    show(cell, box, side, ahead)
    codes = codes_in(reader.picture())
    cell.world.place_box(box, home)
    assert codes == ()


@settings(max_examples=15)
@given(
    box=st.integers(0, 24),
    at=st.tuples(st.floats(-0.3, 0.3), st.floats(-0.2, 0.2), st.floats(0.2, 0.9)),
    turn=st.tuples(*[st.floats(-math.pi, math.pi)] * 3),
)
def test_a_code_on_the_note_is_never_wrong(
    cell: SimulatedCell,
    reader: SimulatedReader,
    box: int,
    at: tuple[float, float, float],
    turn: tuple[float, float, float],
) -> None:
    """However a box is held: a misread can be well-formed, but names no product that is there.

    So the cell believes a code only where it is on the delivery's note.
    """
    home = cell.world.box(box)
    x, y, z = turn
    way = Pose(at) @ turned(0, x) @ turned(1, y) @ turned(2, z)
    cell.world.place_box(box, cell.world.layout.reader.cell_from_reader @ way)
    codes = codes_in(reader.picture())
    cell.world.place_box(box, home)
    on_note = {case.gtin for case in cell.world.cases}
    assert on_note.intersection(codes) <= {cell.world.cases[box].gtin}


def test_a_box_in_front_hides_the_label(cell: SimulatedCell, reader: SimulatedReader) -> None:
    """The lid of another box, between the reader and the label."""
    homes = [cell.world.box(box) for box in (0, 1)]
    show(cell, 0, 0, 0.35)
    seen = codes_in(reader.picture())
    show(cell, 1, 4, 0.15)
    hidden = codes_in(reader.picture())
    for box, home in enumerate(homes):
        cell.world.place_box(box, home)
    assert (seen, hidden) == ((cell.world.cases[0].gtin,), ())


def test_a_reading_takes_its_time_and_sees_the_world_of_now(layout: CellLayout) -> None:
    """The world has gone on to the loop's time before the picture, 0.3 s pass after it."""

    async def read() -> tuple[tuple[str, ...], float, float]:
        cell = build(layout, shipped_deliveries()[1])
        cell.world.model.mj.opt.gravity[2] = 0.0
        show(cell, 3, 2, 0.35)
        await asyncio.sleep(0.5)
        loop = asyncio.get_running_loop()
        began = loop.time()
        codes = await cell.reader.read()
        return codes, loop.time() - began, cell.world.now

    codes, took, now = run_simulated(read())
    assert codes == (shipped_deliveries()[1].stack[3].gtin,)
    assert took == pytest.approx(0.3)
    assert now == pytest.approx(0.5)


def test_the_same_seed_gives_the_same_picture(cell: SimulatedCell) -> None:
    """Noise included; the next picture's noise is another."""
    first, second = (SimulatedReader(Stage(cell.world), LoopClock()) for _ in range(2))
    one, two = first.picture(), second.picture()
    assert one.tobytes() == two.tobytes()
    assert one.tobytes() != first.picture().tobytes()
