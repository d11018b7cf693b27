"""Laws of the parts of recognition: features, registration, small print, rectifying."""

import json
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from printed_faces import SIBLING, A, book_of_drawings, face_of, note_of

from depal.geometry import Pose
from depal.perception.faces import Facing, Rectangle
from depal.perception.pictures import side_size
from depal.perception.recognition import gallery_of, patch_of
from depal.perception.recognition.agreement import agreement, cosine_of
from depal.perception.recognition.details import SCALES, found_again, percentiles
from depal.perception.recognition.features import Features, features_of
from depal.perception.recognition.kernels import normal_equations, solved
from depal.perception.recognition.labels import label_ends, without_label
from depal.perception.recognition.rectifying import rectified
from depal.perception.recognition.registration import Motion, brought_back, registered
from depal.perception.recognition.trust import NAMES, Trust, shipped_trust
from depal.ports import Frame
from depal.simulation.imaging.prints.label import label_for

GALLERY = gallery_of(book_of_drawings(A), note_of(A))
PRINT = next(each for each in GALLERY.prints if each.side == "side")


@given(st.tuples(*[st.floats(0.1, 10.0)] * 3), st.integers(0, 5))
@settings(max_examples=20, deadline=None)
def test_gains_of_the_channels_leave_features_as_they_are(
    gains: tuple[float, float, float], seed: int
) -> None:
    """Exactly, up to rounding."""
    colour = np.random.default_rng(seed).uniform(20, 200, (40, 60, 3)).astype(np.float32)
    weights = np.ones((40, 60), dtype=np.float32)
    plain = features_of(colour, weights, 0.002)
    other = features_of(colour * np.array(gains, dtype=np.float32), weights, 0.002)
    np.testing.assert_allclose(other.values, plain.values, atol=2e-4)


@given(st.integers(0, 3), st.integers(0, 3))
def test_quarter_turns_add_up(one: int, other: int) -> None:
    """And four of them are none."""
    features = PRINT.levels[0]
    twice, once = features.turned(one).turned(other), features.turned((one + other) % 4)
    np.testing.assert_array_equal(twice.values, once.values)
    np.testing.assert_array_equal(twice.weights, once.weights)


@pytest.mark.parametrize("index", range(4))
def test_the_step_of_the_registration_is_the_slope_of_its_error(index: int) -> None:
    """Against finite differences of the weighted squares."""
    random = np.random.default_rng(5)
    smooth = np.cumsum(np.cumsum(random.normal(0, 0.02, (50, 60, 3)), axis=0), axis=1)
    printed = (smooth - smooth.mean(axis=(0, 1))).astype(np.float32)
    seen = printed[3:43, 4:52] + np.float32(0.01)
    ones, inner = np.ones(printed.shape[:2], np.float32), np.ones(seen.shape[:2], np.float32)
    base = np.array([0.31, -0.22, 0.012, 0.004, 0, 0, 0, 1e6, 1], dtype=np.float64)
    room, normal, right = np.zeros((3, 3)), np.zeros((7, 7)), np.zeros(7)

    def half_square(state: np.ndarray) -> float:
        motion = Motion(state[0], state[1], state[2], state[3])
        shape = seen.shape[:2]
        turned = Features(printed, ones, 1.0)
        back = inverse_laid(turned, motion, shape)
        return float(((seen - back) ** 2).sum()) / 2

    normal_equations(seen, inner, printed, ones, base, room, normal, right)
    step = np.zeros(9)
    step[index] = (1e-3, 1e-3, 2e-5, 2e-5)[index]
    slope = (half_square(base + step) - half_square(base - step)) / (2 * step[index])
    assert -right[index] == pytest.approx(slope, rel=0.05, abs=0.02 * abs(right[:4]).max())


@given(st.integers(1, 9), st.integers(0, 2**32 - 1))
def test_the_equations_of_a_step_are_solved_as_numpy_solves_them(n: int, seed: int) -> None:
    """Symmetric and positive ones."""
    random = np.random.default_rng(seed)
    root, right = random.normal(size=(n, n)), random.normal(size=n)
    matrix = root @ root.T + 0.1 * np.eye(n)
    found = right.copy()
    solved(matrix, found, np.zeros((n, n)))
    np.testing.assert_allclose(found, np.linalg.solve(matrix, right), rtol=1e-6, atol=1e-8)


@given(st.lists(st.floats(-9, 9, width=32), min_size=1), st.lists(st.floats(0, 100), min_size=1))
def test_percentiles_are_those_of_numpy(values: list[float], of: list[float]) -> None:
    """Of any number of values."""
    few = np.array(values, np.float32)
    expected = np.percentile(few.astype(float), of)
    np.testing.assert_allclose(percentiles(few, of), expected, rtol=1e-9, atol=1e-12)


def inverse_laid(printed: Features, motion: Motion, shape: tuple[int, int]) -> np.ndarray:
    """A print's features where they lie on what is seen, by plain bilinear interpolation."""
    rows, columns = np.mgrid[0 : shape[0], 0 : shape[1]].astype(float)
    x, y = columns - (shape[1] - 1) / 2, rows - (shape[0] - 1) / 2
    high, wide = printed.weights.shape
    c, s, k = math.cos(motion.turn), math.sin(motion.turn), 1 + motion.scale
    u = (wide - 1) / 2 + motion.x + k * (c * x - s * y)
    v = (high - 1) / 2 + motion.y + k * (s * x + c * y)
    i, j = np.floor(u).astype(int), np.floor(v).astype(int)
    a, b = (u - i)[..., None], (v - j)[..., None]
    p = printed.values
    upper = p[j, i] * (1 - a) + p[j, i + 1] * a
    lower = p[j + 1, i] * (1 - a) + p[j + 1, i + 1] * a
    return np.asarray(upper * (1 - b) + lower * b)


def test_a_print_agrees_with_itself_wholly() -> None:
    """Cosine one, nothing differs, all small print is found."""
    level = PRINT.levels[0]
    agreed = agreement(level, level)
    assert agreed.cosine == pytest.approx(1.0, abs=1e-5)
    assert agreed.worst == pytest.approx(0.0, abs=1e-5)
    assert agreed.worst_tone == pytest.approx(0.0, abs=1e-5)
    assert agreed.seen == pytest.approx(1.0)
    assert cosine_of(level, level) == pytest.approx(1.0, abs=1e-5)
    for scale, small in zip(SCALES, PRINT.small, strict=True):
        assert small.any()
        assert found_again(level, level, scale)[small].min() > 0.6


def test_another_word_is_missing_where_it_stands() -> None:
    """A sibling differs at its words, at the foot of its side, and not at its brand."""
    seen = face_of(SIBLING, "side").features
    motion = registered(seen, PRINT.levels[1], Motion())
    back = brought_back(seen, motion, PRINT.levels[0].weights.shape)
    found, small = found_again(back, PRINT.levels[1], SCALES[0]), PRINT.small[0]
    upper, lower = np.zeros_like(small), np.zeros_like(small)
    upper[: len(small) // 3], lower[-len(small) // 5 :] = True, True
    assert np.median(found[small & upper]) > 0.9
    assert np.percentile(found[small & lower], 20) < 0.4


@given(st.floats(0.07, 0.5), st.floats(0.05, 0.4))
def test_the_place_of_a_label_holds_every_label(width: float, height: float) -> None:
    """Of those that the simulated maker sticks on."""
    label = label_for((width, height))
    weights = without_label((round(height * 1000), round(width * 1000)), 0.001, (width, height))
    if label is None:
        return
    middle, below = weights.shape[1] / 2, weights.shape[0] / 2 + label.below * 1000
    half = (label.size[0] * 500, label.size[1] * 500)
    covered = weights[
        int(below - half[1]) + 1 : int(below + half[1]) - 1,
        int(middle - half[0]) + 1 : int(middle + half[0]) - 1,
    ]
    assert covered.max() == 0.0
    assert (height / 2 + label.below + label.size[1] / 2) / height <= label_ends(width, height)


@given(st.floats(-0.5, 0.5), st.floats(-0.15, 0.15), st.floats(-0.1, 0.1))
@settings(max_examples=15, deadline=None)
def test_a_face_is_laid_flat_from_anywhere(yaw: float, pitch: float, roll: float) -> None:
    """A chequered plane before a camera gives straight squares of the right size."""
    camera_from_face = Pose.from_yaw((0.02, -0.03, 1.5), roll) @ turned_y(yaw) @ turned_x(pitch)
    k = ((1400.0, 0.0, 399.5), (0.0, 1400.0, 299.5), (0.0, 0.0, 1.0))
    inward = camera_from_face.inverse
    rows, columns = np.mgrid[0:600, 0:800].astype(float)
    rays = np.stack(((columns - 399.5) / 1400, (rows - 299.5) / 1400, np.ones_like(rows)))
    turn, eye = np.array(inward.rotation), np.array(inward.translation)
    along = np.tensordot(turn, rays, axes=1)
    depth = -eye[2] / along[2]
    x, y = eye[0] + depth * along[0], eye[1] + depth * along[1]
    squares = ((np.floor(x / 0.03) + np.floor(y / 0.03)) % 2 * 150 + 50).astype(np.uint8)
    colour = np.repeat(squares[..., None], 3, axis=2)
    frame = Frame(0.0, colour, depth.astype(np.float32), k, k, Pose())
    patch = rectified([frame], Facing.FRONT, camera_from_face, (0.18, 0.12))
    assert patch is not None
    assert patch.known.all()
    height, width = patch.known.shape
    u = (np.arange(width) - (width - 1) / 2) * patch.step
    v = (np.arange(height) - (height - 1) / 2) * patch.step
    expected = (np.floor(u / 0.03)[None] + np.floor(v / 0.03)[:, None]) % 2 * 150 + 50
    assert (np.abs(patch.colour[..., 0] - expected) > 75).mean() < 0.08


def turned_y(angle: float) -> Pose:
    """A turn about y."""
    c, s = math.cos(angle), math.sin(angle)
    return Pose(rotation=((c, 0.0, s), (0.0, 1.0, 0.0), (-s, 0.0, c)))


def turned_x(angle: float) -> Pose:
    """A turn about x."""
    c, s = math.cos(angle), math.sin(angle)
    return Pose(rotation=((1.0, 0.0, 0.0), (0.0, c, -s), (0.0, s, c)))


def test_what_stands_before_a_face_hides_it() -> None:
    """Its pixels are not known; a face behind the camera is not seen at all."""
    k = ((700.0, 0.0, 199.5), (0.0, 700.0, 149.5), (0.0, 0.0, 1.0))
    depth = np.full((300, 400), 1.5, dtype=np.float32)
    depth[:, :200] = 1.2
    frame = Frame(0.0, np.full((300, 400, 3), 90, np.uint8), depth, k, k, Pose())
    pose = Pose((0.0, 0.0, 1.5))
    patch = rectified([frame], Facing.FRONT, pose, (0.2, 0.2))
    assert patch is not None
    assert not patch.known[:, :60].any()
    assert patch.known[:, -60:].all()
    assert rectified([frame], Facing.FRONT, Pose((0.0, 0.0, -1.5)), (0.2, 0.2)) is None
    assert rectified([], Facing.FRONT, pose, (0.2, 0.2)) is None


def test_a_patch_of_a_raster_has_the_face_in_its_middle() -> None:
    """With a margin around it."""
    from test_perception_sightings import raster_with  # noqa: PLC0415

    raster = raster_with([(A, "side", 0.4, 0.4, 0.1)])
    width, height = side_size(A, "side")
    patch = patch_of(raster, Rectangle(0.4, 0.4, width, height, 0.1), 0.0015)
    motion = registered(patch.features, PRINT.levels[1], Motion())
    assert max(abs(motion.x), abs(motion.y)) < 0.001
    assert abs(motion.turn) < 0.005


def test_the_trust_is_read_back_as_it_was_written() -> None:
    """And refused when it was trained with other numbers."""
    trust = shipped_trust()
    back = Trust.from_text(trust.as_text())
    numbers = np.zeros(len(NAMES))
    assert back.log_odds(numbers) == pytest.approx(trust.log_odds(numbers), abs=0.05)
    fields = json.loads(trust.as_text())
    fields["names"] = fields["names"][1:]
    with pytest.raises(ValueError, match="trained with other numbers; train it again"):
        Trust.from_text(json.dumps(fields))
