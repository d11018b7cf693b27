"""The simulated camera sees the boxes where they are, as well as its depths allow."""

import numpy as np
import pytest
from imaging_rays import cast

from depal.cell.files import shipped_cell
from depal.executive.clock import LoopClock, run_simulated
from depal.geometry import OrientedBox
from depal.logistics import shipped_deliveries
from depal.ports import Frame
from depal.simulation import build
from depal.simulation.cases import cases_of
from depal.simulation.imaging.camera import SimulatedCamera
from depal.simulation.imaging.lens import Lens
from depal.simulation.imaging.scene import Stage
from depal.simulation.imaging.severity import Severity
from depal.simulation.world import World

LAYOUT = shipped_cell("default")
DELIVERY = shipped_deliveries()[2]


@pytest.fixture(scope="module")
def world() -> World:
    """A delivery on its pallet; nothing is moved."""
    return World(LAYOUT, cases_of(DELIVERY, DELIVERY.stack or (), LAYOUT))


@pytest.fixture(scope="module")
def frame(world: World) -> Frame:
    """One picture of it, nearly ideal."""
    return camera(world).frame(3.0)


def camera(world: World) -> SimulatedCamera:
    """A camera that has taken nothing yet."""
    return SimulatedCamera(Stage(world), LoopClock(), severity=Severity.EASY)


def test_a_frame_has_the_sizes_and_the_pose_of_its_mount(frame: Frame) -> None:
    """And intrinsics that fit: the middle of the picture on the axis, the angle of view."""
    mount = LAYOUT.cameras[0]
    assert frame.taken == 3.0
    assert frame.colour.shape == (*mount.colour_size[::-1], 3)
    assert frame.depth.shape == mount.depth_size[::-1]
    assert frame.depth.dtype == np.float32
    assert frame.cell_from_camera == mount.cell_from_camera
    for k, (width, height) in (
        (frame.colour_k, mount.colour_size),
        (frame.depth_k, mount.depth_size),
    ):
        assert (k[0][2], k[1][2]) == ((width - 1) / 2, (height - 1) / 2)
        assert np.arctan(height / 2 / k[1][1]) * 2 == pytest.approx(mount.vertical_view)
        assert k[0][0] == k[1][1]


def test_depths_lie_on_the_boxes_that_the_rays_meet(world: World, frame: Frame) -> None:
    """Within some millimetres, for all but a few of the pixels that see a box."""
    boxes = [OrientedBox(world.box(case.index), case.shape.size) for case in world.cases]
    mount = LAYOUT.cameras[0]
    lens = Lens.looking(mount.cell_from_camera, mount.depth_size, mount.vertical_view)
    depth, part = cast(boxes, lens, np.array(mount.cell_from_camera.translation))
    both = (part >= 0) & (frame.depth > 0)
    assert np.count_nonzero(both) > 0.5 * np.count_nonzero(part >= 0)
    apart = np.abs(frame.depth[both] - depth[both])
    assert np.median(apart) < 0.004
    assert np.quantile(apart, 0.98) < 0.02


def test_pictures_are_the_same_for_the_same_seed(world: World, frame: Frame) -> None:
    """And the next one has other noise."""
    same = camera(world)
    again, other = same.frame(3.0), same.frame(3.0)
    assert again.colour.tobytes() == frame.colour.tobytes()
    assert again.depth.tobytes() == frame.depth.tobytes()
    assert other.depth.tobytes() != frame.depth.tobytes()


def test_a_picture_is_taken_at_the_end_of_its_exposure() -> None:
    """After 0.5 s, of the world as it is then."""

    async def take() -> tuple[Frame, float]:
        cell = build(LAYOUT, DELIVERY)
        frame = await cell.camera.take()
        return frame, cell.world.now

    frame, now = run_simulated(take())
    assert frame.taken == pytest.approx(0.5)
    assert now == pytest.approx(0.5)
