"""Pictures differ from run to run and from box to box as real ones do."""

from dataclasses import replace

import numpy as np
import pytest

from depal.cell.files import shipped_cell
from depal.executive.clock import LoopClock
from depal.geometry import Pose
from depal.logistics import shipped_deliveries
from depal.ports import Frame
from depal.simulation import build
from depal.simulation.cases import cases_of
from depal.simulation.imaging.camera import SimulatedCamera
from depal.simulation.imaging.hall import RunLight
from depal.simulation.imaging.scene import Stage
from depal.simulation.imaging.severity import Severity
from depal.simulation.imaging.wear import BULGE, CREASE, FILM, TAPE, WEAR, Wear
from depal.simulation.world import World

CELL = shipped_cell("default")
LAYOUT = replace(
    CELL,
    cameras=tuple(
        replace(
            mount,
            colour_size=(mount.colour_size[0] // 2, mount.colour_size[1] // 2),
            depth_size=(mount.depth_size[0] // 2, mount.depth_size[1] // 2),
        )
        for mount in CELL.cameras
    ),
)
"""The default cell with pictures of half the breadth and height."""

DELIVERY = shipped_deliveries()[2]
CASES = cases_of(DELIVERY, DELIVERY.stack or (), LAYOUT)
SHAPES = [case.shape for case in CASES]
POSES = [shape.pose for shape in SHAPES]


def picture(severity: Severity, seed: int, camera: int = 0) -> Frame:
    """The first picture of a run."""
    world = World(LAYOUT, CASES, seed)
    mount = LAYOUT.cameras[camera]
    return SimulatedCamera(Stage(world), LoopClock(), mount, severity).frame(0.0)


def marks(severity: Severity, seed: int) -> np.ndarray:
    """The marks of all faces."""
    return Wear(SHAPES, WEAR[severity], seed).seen_from(POSES, Pose()).marks


def test_easy_boxes_look_as_printed() -> None:
    """No tape, no film, no bulge, gains of one."""
    found = marks(Severity.EASY, 1)
    assert np.all(found[:, :3] == 1.0)
    assert not found[:, 3:CREASE].any()
    assert np.all(found[:, CREASE] == 1.0)


def test_normal_boxes_differ_in_print_tape_and_bulge() -> None:
    """Two boxes of a product differ by some percent; faces stand out by some millimetres."""
    found = marks(Severity.NORMAL, 1)
    assert 0.01 < found[::6, :3].std() < 0.15
    assert 0.05 < (found[:, TAPE + 5] > 0).mean() < 0.5
    assert 0.0 < found[:, BULGE].max() <= 0.004
    shifts = Wear(SHAPES, WEAR[Severity.NORMAL], 1).shifts
    widths = np.array([[s.size[0], s.size[2]] for s in SHAPES])
    front = np.abs(shifts.reshape(-1, 6, 2)[:, 2] * widths)
    assert 0.0003 < np.median(front) < front.max() <= 0.0031


def test_film_covers_groups_of_boxes_in_some_runs() -> None:
    """In about half of them; neither all boxes nor a single one."""
    shares = [(marks(Severity.NORMAL, seed)[::6, FILM] > 0).mean() for seed in range(30)]
    wrapped = [share for share in shares if share > 0]
    assert 5 < len(wrapped) < 25
    assert any(share < 0.9 for share in wrapped)


def test_the_wear_of_a_box_depends_on_the_seed_and_its_number_alone() -> None:
    """Its neighbours do not matter, but for film."""
    some, settings = SHAPES[:5], WEAR[Severity.NORMAL]
    few = Wear(some, settings, 3).seen_from(POSES[:5], Pose()).marks[:, :FILM]
    assert np.array_equal(few, marks(Severity.NORMAL, 3)[:30, :FILM])
    assert not np.array_equal(few, marks(Severity.NORMAL, 4)[:30, :FILM])


def test_lamps_are_one_runs_and_colours_one_cameras() -> None:
    """Two cameras of a run see the same shadows and other colours."""
    one, two = (RunLight.drawn(Severity.NORMAL, 5, camera) for camera in (1, 2))
    other = RunLight.drawn(Severity.NORMAL, 6, 1)
    assert one.light == two.light
    assert one.light != other.light
    assert not np.array_equal(one.gains, two.gains)
    assert len({bool(RunLight.drawn(Severity.NORMAL, seed, 1).beams) for seed in range(9)}) == 2


def test_runs_look_different_and_the_same_seed_the_same() -> None:
    """Brightness and colour change from run to run."""
    same, again, other = (picture(Severity.NORMAL, seed) for seed in (1, 1, 2))
    assert same.colour.tobytes() == again.colour.tobytes()
    assert same.depth.tobytes() == again.depth.tobytes()
    means = [frame.colour.mean(axis=(0, 1)) for frame in (same, other)]
    assert np.abs(means[0] - means[1]).max() > 2.0


def test_a_box_that_leaves_takes_its_shadow_along() -> None:
    """What is still is painted once; what stood before it shows the ground in the light."""
    world = World(LAYOUT, CASES)
    top = SimulatedCamera(Stage(world), LoopClock(), LAYOUT.cameras[1], Severity.EASY)
    before = top.frame(0.0).colour.astype(int)
    for index in range(len(CASES)):
        world.place_box(index, Pose((-1.5, 0.0, 0.3 + 0.3 * index)))
    after = top.frame(0.0).colour.astype(int)
    brighter = (after - before).min(axis=2) > 25
    assert brighter.mean() > 0.005
    fresh = SimulatedCamera(Stage(world), LoopClock(), LAYOUT.cameras[1], Severity.EASY)
    assert np.abs(fresh.frame(0.0).colour.astype(int) - after).mean() < 2.5


def test_a_trolley_that_leaves_its_bay_leaves_the_picture() -> None:
    """The still part is painted anew."""
    world = World(LAYOUT, CASES)
    top = SimulatedCamera(Stage(world), LoopClock(), LAYOUT.cameras[1], Severity.EASY)
    before = top.frame(0.0).colour.astype(int)
    world.show_storage("trolley_1", trolley=None)
    changed = [np.abs(top.frame(0.0).colour.astype(int) - before).max(axis=2) > 30]
    for storage in LAYOUT.storages:
        world.show_storage(storage.id, trolley=None)
    changed.append(np.abs(top.frame(0.0).colour.astype(int) - before).max(axis=2) > 30)
    assert changed[1].mean() > 0.01


def test_a_cell_has_all_cameras_of_its_layout_each_with_its_own_bias() -> None:
    """And the severity that was asked for."""
    cell = build(LAYOUT, DELIVERY, 3, severity=Severity.HARD)
    assert [camera.model.mount for camera in cell.cameras] == list(LAYOUT.cameras)
    assert {camera.model.severity for camera in cell.cameras} == {Severity.HARD}
    assert len({camera.model.bias for camera in cell.cameras}) == len(LAYOUT.cameras)
    assert cell.camera is cell.cameras[0]


@pytest.mark.parametrize("camera", [0, 1])
def test_depths_are_off_by_the_runs_bias(camera: int) -> None:
    """Of the same world, depths of two runs stand in the relation of their biases."""
    mount = LAYOUT.cameras[camera]
    models, depths = [], []
    for seed in (1, 2):
        eye = SimulatedCamera(
            Stage(World(LAYOUT, CASES, seed)), LoopClock(), mount, Severity.NORMAL
        )
        models.append(eye.model.bias)
        depths.append(eye.frame(0.0).depth)
    both = (depths[0] > 0) & (depths[1] > 0)
    ratio = np.median(depths[0][both] / depths[1][both])
    assert ratio == pytest.approx((1 + models[0]) / (1 + models[1]), abs=0.001)


def test_a_depth_picture_may_see_more_than_the_colour_picture() -> None:
    """In the middle, where both see the same, it is the same as beside a colour picture as wide."""
    layout = LAYOUT.cameras[0]
    width, height = layout.depth_size
    frames = []
    for colour in (layout.colour_size, (layout.colour_size[0] // 2, layout.colour_size[1])):
        mount = replace(layout, colour_size=colour)
        world = World(LAYOUT, CASES, 2)
        frames.append(SimulatedCamera(Stage(world), LoopClock(), mount, Severity.EASY).frame(0.0))
    assert frames[0].depth.shape == frames[1].depth.shape == (height, width)
    one, two = (frame.depth for frame in frames)
    both = (one > 0) & (two > 0)
    assert both.mean() > 0.9 * (one > 0).mean()
    assert (np.abs(one[both] - two[both]) < 0.02).mean() > 0.98
