"""Calibration by markers: exact on exact corners, near the truth on pictures, wary of lies."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from marker_views import bias_of, frame_of, layout_of, mount_of
from scipy.spatial.transform import Rotation

import depal.perception.calibration
from depal.cell.files import SHIPPED
from depal.domain import Fiducial
from depal.errors import FrameError
from depal.geometry import Pose
from depal.perception.calibration import LIMIT, Calibration, calibrate, check, checked, nominal_k
from depal.perception.calibration.checking import room_among
from depal.perception.calibration.finding import (
    corners_of,
    expected,
    found_anywhere,
    found_near,
    grey_of,
    projected,
)
from depal.perception.calibration.markers import PLATE, dictionary, plate_picture
from depal.perception.calibration.solving import (
    misplaced,
    pose_of,
    refined,
    shifted,
    sighted,
    spread,
)
from depal.ports import Frame
from depal.simulation.imaging.severity import Severity

CAMERAS = ("front", "top")
K = nominal_k((1080, 1920), math.radians(69))


def seen_from(pose: Pose, fiducials: tuple[Fiducial, ...]) -> dict[int, np.ndarray]:
    """Corners as an ideal camera finds them, as many as its picture holds."""
    return expected(fiducials, K, (1080, 1920), pose)


def nudge(shift: tuple[float, ...], turn: tuple[float, ...]) -> Pose:
    """A small motion."""
    return Pose.from_arrays(shift, Rotation.from_rotvec(turn).as_matrix())


def hidden(frame: Frame, patterns: list[int], where: dict[int, np.ndarray]) -> Frame:
    """The same with something before some markers."""
    colour = frame.colour.copy()
    for pattern in patterns:
        (left, top), (right, bottom) = where[pattern].min(axis=0), where[pattern].max(axis=0)
        colour[max(int(top) - 3, 0) : int(bottom) + 3, max(int(left) - 3, 0) : int(right) + 3] = 70
    return replace(frame, colour=colour)


def test_the_package_hands_out_these_names() -> None:
    """A change here is a change for its users."""
    assert sorted(depal.perception.calibration.__all__) == [
        "Calibration",
        "DepthScale",
        "LIMIT",
        "MarkerCheck",
        "calibrate",
        "calibrations_for",
        "check",
        "checked",
        "fields_of",
        "nominal_k",
        "read_calibrations",
    ]


@settings(max_examples=25)
@given(
    st.tuples(*[st.floats(-0.1, 0.1)] * 3),
    st.tuples(*[st.floats(-0.1, 0.1)] * 3),
)
def test_exact_corners_give_the_exact_pose(
    shift: tuple[float, ...], turn: tuple[float, ...]
) -> None:
    """Wherever the camera stands, without a guess and from a near one."""
    fiducials = layout_of().fiducials
    nominal = mount_of("front").cell_from_camera
    pose = nominal @ nudge(shift, turn)
    corners = sighted(fiducials, [seen_from(pose, fiducials)])
    assume(corners.markers >= 4)
    for found in (pose_of(corners, K), refined(corners, K, nominal)):
        assert found is not None
        assert shifted(room_among(fiducials), found, pose).max() < 1e-5
        assert misplaced(corners, K, found).max() < 1e-5


@settings(max_examples=12)
@given(st.integers(0, 1 << 32), st.integers(0, 6))
def test_one_marker_that_was_moved_does_not_carry_the_pose_away(seed: int, which: int) -> None:
    """Its corners lie 20 pixels off; the others hold the pose to some millimetres."""
    random = np.random.default_rng(seed)
    fiducials, pose = layout_of().fiducials, mount_of("front").cell_from_camera
    seen = seen_from(pose, fiducials)
    liar = sorted(seen)[which]
    seen = {
        i: at + random.normal(0, 0.1, at.shape) + (20.0 if i == liar else 0.0)
        for i, at in seen.items()
    }
    found = refined(sighted(fiducials, [seen]), K, pose)
    assert shifted(room_among(fiducials), found, pose).max() < 0.008


def test_the_spread_of_a_pose_is_what_noise_makes_of_it() -> None:
    """Within a quarter, over 100 draws; a moved point is as far as the two poses say."""
    random = np.random.default_rng(3)
    fiducials, pose = layout_of().fiducials, mount_of("front").cell_from_camera
    seen, room = seen_from(pose, fiducials), room_among(fiducials)
    corners = sighted(fiducials, [seen])
    apart = []
    for _ in range(100):
        noisy = replace(
            corners, pixels=corners.pixels + random.normal(0, 0.25, corners.pixels.shape)
        )
        apart.append(shifted(room, refined(noisy, K, pose), pose))
    worst = np.sqrt(np.mean(np.square(apart), axis=0)).max()
    assert spread(corners, K, pose, room) == pytest.approx(worst, rel=0.25)


@pytest.mark.parametrize(
    "name", [SHIPPED[0], *(pytest.param(name, marks=pytest.mark.slow) for name in SHIPPED[1:])]
)
@pytest.mark.parametrize("camera", CAMERAS)
def test_every_camera_sees_enough_markers_above_and_below_a_plane(name: str, camera: str) -> None:
    """Four and more that are in no one plane, behind the highest load and the parked arm."""
    layout, frame = layout_of(name), frame_of(camera, name=name)
    seen = found_anywhere(frame.colour, [one.id for one in layout.fiducials])
    assert len(seen) >= 6
    places = np.array(
        [one.cell_from_marker.translation for one in layout.fiducials if one.id in seen]
    )
    assert np.linalg.svd(places - places.mean(axis=0))[1][2] > 0.2


@pytest.mark.parametrize("name", SHIPPED)
def test_markers_stand_clear_of_the_load_and_within_the_fence(name: str) -> None:
    """A plate on the floor lies beside the pallet; all lie inside the fence."""
    layout = layout_of(name)
    (x0, y0), (x1, y1) = layout.floor
    length, width, _ = layout.pallet.size
    for fiducial in layout.fiducials:
        for corner in corners_of(fiducial, PLATE).tolist():
            assert x0 <= corner[0] <= x1
            assert y0 <= corner[1] <= y1
            x, y, _ = layout.pallet.cell_from_pallet.inverse.apply(tuple(corner))
            assert not (-0.02 < x < length + 0.02 and -0.02 < y < width + 0.02)


@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize(
    ("severity", "allowed"), [(Severity.EASY, 0.0008), (Severity.NORMAL, 0.003)]
)
def test_a_picture_gives_pose_and_scale(camera: str, severity: Severity, allowed: float) -> None:
    """Pose to 2 mm and 0.1 degree; the scale of depths as well as their errors allow."""
    layout, mount = layout_of(), mount_of(camera)
    frame = replace(frame_of(camera, severity=severity), cell_from_camera=Pose())
    found = calibrate([frame], layout.fiducials, layout.fixtures)
    way = mount.cell_from_camera.inverse @ found.cell_from_camera
    turned = Rotation.from_matrix(np.array(way.rotation)).magnitude()
    assert math.degrees(float(turned)) < 0.1
    apart = shifted(room_among(layout.fiducials), found.cell_from_camera, mount.cell_from_camera)
    assert apart.max() < 0.002
    true = found.depth_scale * 1.8 * (1.0 + bias_of(camera, severity)) + found.depth.offset
    assert true == pytest.approx(1.8, rel=allowed)
    assert found.residual < 0.001
    assert found.markers == len(found.seen) >= 6


def test_a_calibration_takes_a_bias_from_the_depths_and_keeps_holes() -> None:
    """Scaled frames give scaled scales, and the same depths once they are applied."""
    layout, frame = layout_of(), frame_of("top")
    one, other = (
        calibrate([told], layout.fiducials, layout.fixtures)
        for told in (frame, replace(frame, depth=frame.depth / np.float32(1.006)))
    )
    assert other.depth_scale == pytest.approx(1.006 * one.depth_scale, abs=2e-4)
    true = one.applied(frame)
    assert true.cell_from_camera == one.cell_from_camera
    assert np.array_equal(true.depth > 0, frame.depth > 0)
    there = frame.depth > 0
    expected_depth = frame.depth[there] * one.depth_scale + one.depth.offset
    np.testing.assert_allclose(true.depth[there], expected_depth, rtol=1e-5)


@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize("share", [1.0, 0.1])
def test_a_camera_that_stands_still_has_a_small_residual(camera: str, share: float) -> None:
    """With a full and with a nearly empty pallet."""
    layout = layout_of()
    known = Calibration.nominal(mount_of(camera))
    seen = checked(frame_of(camera, share=share), layout.fiducials, known)
    assert seen.residual < 0.002
    assert set(seen.seen) <= set(seen.expected)


@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize(
    "moved",
    [
        Pose((0.03, 0.0, 0.0)),
        Pose((0.0, -0.03, 0.0)),
        Pose((0.0, 0.0, 0.03)),
        nudge((0.0, 0.0, 0.0), (0.0, 0.012, 0.0)),
    ],
    ids=["sideways", "up", "forward", "turned"],
)
def test_a_camera_that_was_moved_is_not_trusted(camera: str, moved: Pose) -> None:
    """Three centimetres or two thirds of a degree: the residual is about what the load is off."""
    layout, mount = layout_of(), mount_of(camera)
    found = check(frame_of(camera, moved=moved), layout.fiducials, Calibration.nominal(mount))
    there = mount.cell_from_camera @ moved
    truth = shifted(room_among(layout.fiducials), there, mount.cell_from_camera).max()
    assert found > LIMIT
    assert 0.8 * truth < found < 2.5 * truth


@pytest.mark.parametrize("camera", CAMERAS)
def test_some_hidden_markers_change_nothing(camera: str) -> None:
    """Any two of them, and a moved camera is still found out; none at all says so."""
    layout, known = layout_of(), Calibration.nominal(mount_of(camera))
    frame, moved = frame_of(camera), frame_of(camera, moved=Pose((0.03, 0.0, 0.0)))
    seen = checked(frame, layout.fiducials, known)
    beside = checked(moved, layout.fiducials, known).seen
    patterns = sorted(seen.seen)
    for one, other in zip(patterns, patterns[1:] + patterns[:1], strict=True):
        assert check(hidden(frame, [one, other], dict(seen.seen)), layout.fiducials, known) < LIMIT
        covered = hidden(moved, [one, other], dict(beside))
        assert check(covered, layout.fiducials, known) > LIMIT
    nothing = checked(hidden(frame, patterns, dict(seen.seen)), layout.fiducials, known)
    assert nothing.residual == math.inf
    assert not set(nothing.seen) & set(nothing.expected)
    assert len(nothing.expected) >= 6


def test_markers_near_their_places_are_those_found_anywhere() -> None:
    """To the last bit where nothing else decides; one that is not there is not found."""
    frame, layout = frame_of("top"), layout_of()
    where = expected(
        layout.fiducials, frame.colour_k, (1920, 1080), mount_of("top").cell_from_camera
    )
    near = found_near(grey_of(frame.colour), where | {40: where[0]}, 40.0)
    anywhere = found_anywhere(frame.colour, range(50))
    assert set(near) <= set(anywhere)
    for pattern, corners in near.items():
        assert np.abs(corners - anywhere[pattern]).max() < 0.05
        assert np.abs(corners - where[pattern]).max() < 0.6


def test_too_few_markers_are_told_with_those_that_are_seen() -> None:
    """And so are no frames, and frames of two cameras."""
    frame, fiducials = frame_of("top"), layout_of().fiducials
    black = replace(frame, colour=np.zeros_like(frame.colour))
    with pytest.raises(FrameError, match="markers none are seen, too few for a pose; expected at"):
        calibrate([black], fiducials)
    with pytest.raises(FrameError, match="there is no frame"):
        calibrate([], fiducials)
    with pytest.raises(FrameError, match="frame 1 has other intrinsics or another size"):
        calibrate([frame, frame_of("front")], fiducials)


def test_a_plate_shows_its_pattern_in_a_white_rim() -> None:
    """Every pattern is read back from its own picture, upright."""
    for pattern in range(50):
        picture = plate_picture(pattern, 12)
        assert picture.shape == (96, 96)
        assert len(np.unique(np.concatenate((picture[0], picture[:, -1])))) == 1
        square = found_anywhere(np.repeat(picture[..., None], 3, axis=2), range(50))[pattern]
        assert np.abs(square - [(11.5, 11.5), (83.5, 11.5), (83.5, 83.5), (11.5, 83.5)]).max() < 1
    assert dictionary().markerSize == 4


def test_the_nominal_lens_has_the_mounts_angle_of_view() -> None:
    """A point at the picture's upper edge is seen at half the angle."""
    mount = mount_of("front")
    known = Calibration.nominal(mount)
    up = math.tan(mount.vertical_view / 2)
    ahead = mount.cell_from_camera.apply((0.0, -2.0 * up, 2.0))
    (at,) = projected(np.array([ahead]), known.colour_k, mount.cell_from_camera)
    assert at == pytest.approx([539.5, -0.5, 2.0])
    assert (known.depth_scale, known.markers) == (1.0, 0)
