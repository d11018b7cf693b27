"""The simulated camera sees the boxes where they are, as well as its depths allow."""

import numpy as np
import pytest
from imaging_rays import cast

from depal.cell.files import shipped_cell
from depal.executive.clock import LoopClock, run_simulated
from depal.geometry import OrientedBox, Pose
from depal.logistics import shipped_deliveries
from depal.ports import Frame
from depal.simulation import build
from depal.simulation.cases import cases_of
from depal.simulation.imaging.atlas import AtlasBuilder
from depal.simulation.imaging.camera import SimulatedCamera
from depal.simulation.imaging.depth_noise import DepthNoise, measured
from depal.simulation.imaging.lens import Lens
from depal.simulation.imaging.mesh import cuboid, joined, rectangle
from depal.simulation.imaging.raster import Picture, render
from depal.simulation.imaging.scene import Stage
from depal.simulation.world import World

LAYOUT = shipped_cell("default")
DELIVERY = shipped_deliveries()[2]
LENS = Lens.looking(Pose(), (320, 240), 1.0)
QUIET = DepthNoise(sigma=0.0)


@pytest.fixture(scope="module")
def world() -> World:
    """A delivery on its pallet; nothing is moved."""
    return World(LAYOUT, cases_of(DELIVERY, DELIVERY.stack or (), LAYOUT))


@pytest.fixture(scope="module")
def frame(world: World) -> Frame:
    """One picture of it."""
    return SimulatedCamera(Stage(world), LoopClock()).frame(3.0)


def picture_of(*boxes: OrientedBox) -> Picture:
    """Boxes before a wall 4 m away."""
    builder = AtlasBuilder()
    skin = builder.plain((200, 200, 200))
    wall = rectangle(Pose((0.0, 0.0, 4.0)), (9.0, 9.0), skin)
    solids = [cuboid(box.size, (skin,)).moved(box.pose) for box in boxes]
    return render(joined([wall, *solids]), builder.build(), LENS)


def at(depth: float) -> OrientedBox:
    """A box whose front is so far away."""
    return OrientedBox(Pose((0.0, 0.0, depth + 0.2)), (0.6, 0.6, 0.4))


def told(picture: Picture, noise: DepthNoise) -> np.ndarray:
    """Depths with the errors of one seed."""
    return measured(picture, LENS, noise, np.random.default_rng(5))


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


@pytest.mark.parametrize("depth", [0.8, 1.6, 3.2])
def test_the_error_of_a_depth_grows_with_its_square(depth: float) -> None:
    """sigma_z = z^2 sigma_d / (f b), to a tenth."""
    noise = DepthNoise(steps=1000)
    picture = picture_of(at(depth))
    middle = told(picture, noise)[110:130, 150:170].astype(float)
    expected = depth**2 * noise.sigma / (LENS.focal[0] * noise.baseline)
    assert middle.std() == pytest.approx(expected, rel=0.15)
    assert abs(middle.mean() - depth) < expected


def test_depths_come_in_steps_of_disparity() -> None:
    """A slanted face takes few values, all of them whole steps of 1/32 pixel."""
    picture = picture_of()
    slant = Pose((0.0, 0.0, 2.0), ((0.8, 0.0, 0.6), (0.0, 1.0, 0.0), (-0.6, 0.0, 0.8)))
    builder = AtlasBuilder()
    skin = builder.plain((9, 9, 9))
    picture = render(rectangle(slant, (1.0, 1.0), skin), builder.build(), LENS)
    depths = told(picture, QUIET)
    steps = LENS.focal[0] * QUIET.baseline / depths[depths > 0].astype(float) * QUIET.steps
    np.testing.assert_allclose(steps, np.round(steps), atol=1e-3)
    assert 10 < len(np.unique(depths)) < 2000


def test_what_only_one_lens_sees_is_a_hole() -> None:
    """A band at the left of a near box, as wide as the jump of the disparity."""
    near, far = 1.0, 4.0
    depths = told(picture_of(at(near)), QUIET)[120]
    left = int(np.nonzero(np.abs(depths - near) < 0.05)[0][0])
    right = int(np.nonzero(np.abs(depths - near) < 0.05)[0][-1])
    jump = LENS.focal[0] * QUIET.baseline * (1 / near - 1 / far)
    before = int(np.nonzero(depths[:left] > 0)[0][-1])
    after = right + 1 + int(np.nonzero(depths[right + 1 :] > 0)[0][0])
    assert abs((left - before) - jump) <= 3
    assert after - right <= 3


def test_faces_seen_flatly_and_what_is_out_of_reach_are_holes() -> None:
    """A plane turned step by step vanishes; so do depths too near and too far."""
    builder = AtlasBuilder()
    skin = builder.plain((9, 9, 9))
    atlas = builder.build()
    shares = []
    for angle in (1.2, 1.4, 1.55):
        c, s = np.cos(angle), np.sin(angle)
        slant = Pose((0.0, 0.0, 2.0), ((1.0, 0.0, 0.0), (0.0, c, s), (0.0, -s, c)))
        picture = render(rectangle(slant, (0.4, 0.4), skin), atlas, LENS)
        seen = picture.triangles >= 0
        shares.append(float((told(picture, QUIET)[seen] > 0).mean()))
    assert shares[0] > 0.7
    assert shares[1] > 0.0
    assert shares[2] == 0.0
    for depth in (0.35, 7.0):
        picture = render(rectangle(Pose((0.0, 0.0, depth)), (9.0, 9.0), skin), atlas, LENS)
        assert not told(picture, QUIET).any()


def test_pictures_are_the_same_for_the_same_seed(world: World, frame: Frame) -> None:
    """And the next one has other noise."""
    camera = SimulatedCamera(Stage(world), LoopClock())
    again, other = camera.frame(3.0), camera.frame(3.0)
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
