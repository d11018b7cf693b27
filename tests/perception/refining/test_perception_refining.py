"""A face is found by its depths, its print and its sides, wherever it is thought to be."""

import math

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.geometry import Pose
from depal.perception.faces import Facing
from depal.perception.recognition.patches import FINE, Patch
from depal.perception.recognition.rectifying import rectified
from depal.perception.refining import Belief, Sides, by_depths, by_print, moved
from depal.perception.refining.belief import (
    DEPTH,
    HEIGHT,
    STATES,
    SWING,
    TURN,
    WIDTH,
    U,
    V,
    flow,
    told,
)
from depal.ports import Frame

SIZE = (0.3, 0.2)
K = ((900.0, 0.0, 480.0), (0.0, 900.0, 360.0), (0.0, 0.0, 1.0))
CAMERA = Pose((0.5, -0.3, -1.5))
"""`face_from_camera`: the face's own axes, from aside and from above."""

WIDE = Belief.around((0.006, 0.006, 0.01, 0.03, 0.02, 5e-4, 5e-4))
steps = st.tuples(
    st.floats(-0.004, 0.004),
    st.floats(-0.004, 0.004),
    st.floats(-0.005, 0.005),
    st.floats(-0.015, 0.015),
    st.floats(-0.01, 0.01),
)


def picture(contrast: float) -> np.ndarray:
    """(h, w, 3) blobs of colour on a box, one pixel per millimetre; dark around it."""
    random = np.random.default_rng(5)
    small = 155 + contrast * random.uniform(-95, 95, (14, 20, 3)).astype(np.float32)
    face = cv2.resize(small, (300, 200), interpolation=cv2.INTER_CUBIC)
    whole = np.full((300, 400, 3), 25.0, dtype=np.float32)
    whole[50:250, 50:350] = face
    return np.clip(whole, 1, 255).astype(np.uint8)


def frame_of(cell_from_face: Pose, contrast: float = 1.0) -> Frame:
    """What a camera at `CAMERA` sees of a face with a dark plane around it."""
    camera_from_face = CAMERA.inverse @ cell_from_face
    turn, shift = np.array(camera_from_face.rotation), np.array(camera_from_face.translation)
    from_picture = np.array([[1e-3, 0.0, -0.1995], [0.0, 1e-3, -0.1495], [0.0, 0.0, 1.0]])
    warp = np.array(K) @ np.column_stack((turn[:, :2], shift)) @ from_picture
    colour = cv2.warpPerspective(picture(contrast), warp, (960, 720), borderValue=(25, 25, 25))
    v, u = np.mgrid[0:720, 0:960]
    rays = np.stack(((u - K[0][2]) / K[0][0], (v - K[1][2]) / K[1][1], np.ones_like(u)), axis=-1)
    depth = (turn[:, 2] @ shift) / (rays @ turn[:, 2])
    return Frame(0.0, np.asarray(colour, np.uint8), depth.astype(np.float32), K, K, CAMERA)


def patch_of(frame: Frame) -> Patch:
    """The face laid flat, where it is thought to be."""
    patch = rectified([frame], Facing.FRONT, Pose(), SIZE)
    assert patch is not None
    return patch


def whole(step: tuple[float, ...]) -> np.ndarray:
    """(7,) a step of a face as large as it is thought to be."""
    return np.array([*step, 0.0, 0.0])


@given(steps, st.floats(-0.15, 0.15), st.floats(-0.1, 0.1))
def test_points_of_a_moved_face_are_seen_where_the_flow_says(
    step: tuple[float, ...], x: float, y: float
) -> None:
    """To first order, in the picture that is laid flat where the face is thought to be."""
    small = whole(step) * 0.01
    eye = np.array(CAMERA.translation)
    point = np.array(moved(Pose(), small).apply((x, y, 0.0)))
    seen = eye + (point - eye) * (-eye[2] / (point[2] - eye[2]))
    expected = flow(np.array([x]), np.array([y]), CAMERA.translation)[0] @ small
    assert seen[:2] - (x, y) == pytest.approx(expected, abs=2e-7)


@given(steps)
def test_beliefs_are_the_same_from_wherever_they_are_told(step: tuple[float, ...]) -> None:
    """A step that has been made is no longer expected; what is known stays as exact."""
    belief = WIDE + told(np.eye(STATES), whole(step), np.full(STATES, 1e-3))
    there = belief.from_there(belief.mean)
    assert there.mean == pytest.approx(np.zeros(STATES), abs=1e-12)
    assert np.allclose(there.covariance, belief.covariance)


@pytest.mark.parametrize("seed", range(4))
def test_depths_tell_how_deep_a_face_lies_and_how_it_is_swung(seed: int) -> None:
    """A plane is found exactly, but for what faces usually stand out."""
    step = whole((0.0, 0.0, *np.random.default_rng(seed).uniform(-0.012, 0.012, 2), 0.0))
    found = by_depths(frame_of(moved(Pose(), step)), Pose(), SIZE)
    assert found is not None
    belief, away = found
    mean = np.linalg.lstsq(belief.information, belief.pull, rcond=None)[0]
    assert away == pytest.approx(1.5)
    assert mean[SWING] == pytest.approx(step[SWING], abs=2e-4)
    assert mean[DEPTH] == pytest.approx(step[DEPTH] + 0.001, abs=3e-4)


def test_without_depths_nothing_is_said() -> None:
    """A face that stereo cannot see."""
    frame = frame_of(Pose())
    frame.depth[:] = 0.0
    assert by_depths(frame, Pose(), SIZE) is None


@pytest.mark.parametrize("seed", range(6))
def test_a_print_tells_five_numbers_of_a_face(seed: int) -> None:
    """The swing too: what is seen from aside is foreshortened."""
    random = np.random.default_rng(seed)
    step = whole(tuple(random.uniform(-1, 1, 5) * (0.003, 0.003, 0.004, 0.012, 0.008)))
    printed = patch_of(frame_of(Pose()))
    seen = patch_of(frame_of(moved(Pose(), step)))
    rim = round((printed.margin + 0.008) / FINE)
    features = printed.features
    features.weights[:rim] = features.weights[-rim:] = 0.0
    features.weights[:, :rim] = features.weights[:, -rim:] = 0.0
    belief = by_print(seen.features, features, CAMERA.translation, WIDE, [(0.0, 0.0, 0.0)])
    mean = np.linalg.lstsq(belief.information, belief.pull, rcond=None)[0]
    assert mean[[U, V]] == pytest.approx(step[[U, V]], abs=5e-4)
    assert mean[DEPTH] == pytest.approx(step[DEPTH], abs=2e-3)
    assert mean[[SWING, TURN]] == pytest.approx(step[[SWING, TURN]], abs=2e-3)


@pytest.mark.parametrize("seed", range(6))
def test_sides_tell_where_a_face_is_in_its_plane(seed: int) -> None:
    """Where its depth and its swing are known."""
    random = np.random.default_rng(seed)
    step = whole((*random.uniform(-0.005, 0.005, 2), 0.0, 0.0, float(random.uniform(-0.02, 0.02))))
    known = Belief.around((0.006, 0.006, 1e-4, 1e-4, 0.02, 5e-4, 5e-4))
    patch = patch_of(frame_of(moved(Pose(), step), 0.1))
    mean = (known + Sides.of(patch).told(known)).mean
    assert mean[[U, V]] == pytest.approx(step[[U, V]], abs=1e-3)
    assert mean[TURN] == pytest.approx(step[TURN], abs=math.radians(0.25))


def test_sides_choose_the_size_that_suits_them_and_measure_one_that_nobody_knows() -> None:
    """The face is 12 mm wider and 10 mm higher than it was thought to be."""
    frame = frame_of(Pose(), 0.1)
    patch = rectified([frame], Facing.FRONT, Pose(), (SIZE[0] - 0.012, SIZE[1] - 0.01))
    assert patch is not None
    sizes = np.array([(0.0, 0.0), (0.012, 0.01), (-0.01, 0.012), (0.02, -0.004)])
    assert Sides.of(patch).grown(WIDE, sizes) == 1
    unknown = Belief.around((0.006, 0.006, 1e-4, 1e-4, 0.01, 0.01, 0.01))
    mean = (unknown + Sides.of(patch).told(unknown)).mean
    assert mean[[WIDTH, HEIGHT]] == pytest.approx((0.012, 0.01), abs=2e-3)
