"""Frame folders: what is written comes back, and what is wrong is told at once."""

import json
import math
import tempfile
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import depal.perception.frames
from depal.errors import FrameError
from depal.geometry import Matrix3, Pose
from depal.perception.frames import (
    RecordedFrame,
    frame_folders,
    read_frame_folder,
    registered,
    write_frame_folder,
)

REALS = st.floats(-5.0, 5.0)
EDGES = st.floats(0.01, 2.0)


def lens(width: int, height: int, focal: float = 1.2) -> Matrix3:
    """Plausible intrinsics of a picture."""
    f = focal * width
    return ((f, 0.0, (width - 1) / 2), (0.0, f, (height - 1) / 2), (0.0, 0.0, 1.0))


@st.composite
def poses(draw: st.DrawFn) -> Pose:
    """Any rigid pose."""
    turn = Rotation.from_rotvec([draw(st.floats(-3.0, 3.0)) for _ in range(3)])
    return Pose.from_arrays([draw(REALS) for _ in range(3)], turn.as_matrix())


@st.composite
def frames(draw: st.DrawFn) -> RecordedFrame:
    """Any frame: with depth of its own size or not, with masks and sizes or not."""
    random = np.random.default_rng(draw(st.integers(0, 1 << 32)))
    width, height = draw(st.integers(16, 40)), draw(st.integers(16, 40))
    own = draw(st.booleans())
    deep = (draw(st.integers(16, 40)), draw(st.integers(16, 40))) if own else (width, height)
    depth = random.uniform(0.2, 6.5, deep[::-1]).astype(np.float32)
    depth[random.random(depth.shape) < 0.2] = 0.0
    sizes = st.none() | st.lists(st.tuples(EDGES, EDGES, EDGES), max_size=3).map(tuple)
    return RecordedFrame(
        random.integers(0, 256, (height, width, 3), dtype=np.uint8),
        depth,
        lens(width, height),
        lens(*deep) if own else lens(width, height),
        draw(st.none() | poses()),
        draw(sizes),
        tuple(random.random((height, width)) < 0.5 for _ in range(draw(st.integers(0, 2)))),
        draw(st.floats(0.0, 1e6)),
    )


@pytest.fixture(name="kept")
def _kept(tmp_path: Path) -> Path:
    """A sound frame's folder."""
    colour = np.full((48, 64, 3), 90, dtype=np.uint8)
    depth = np.full((48, 64), 1.5, dtype=np.float32)
    mask = np.zeros((48, 64), dtype=bool)
    frame = RecordedFrame(colour, depth, lens(64, 48), lens(64, 48), Pose(), None, (mask,))
    write_frame_folder(tmp_path / "f", frame)
    return tmp_path / "f"


def told(path: Path) -> list[str]:
    """Everything that is said about a folder."""
    with pytest.raises(FrameError) as caught:
        read_frame_folder(path)
    assert caught.value.source == str(path)
    return [str(problem) for problem in caught.value.problems]


def edited(path: Path, **changes: object) -> Path:
    """The folder with some keys of its description replaced; None takes one away."""
    file = path / "frame.json"
    fields = json.loads(file.read_text()) | changes
    file.write_text(json.dumps({key: value for key, value in fields.items() if value != "gone"}))
    return path


def test_the_package_hands_out_these_names() -> None:
    """A change here is a change for its users."""
    assert sorted(depal.perception.frames.__all__) == [
        "RecordedFrame",
        "frame_folders",
        "problems_of",
        "read_frame_folder",
        "registered",
        "write_frame_folder",
    ]


@settings(max_examples=25)
@given(frames())
def test_what_is_written_comes_back(frame: RecordedFrame) -> None:
    """Depth to half a unit, everything else as it was."""
    with tempfile.TemporaryDirectory() as folder:
        write_frame_folder(Path(folder) / "f", frame)
        back = read_frame_folder(Path(folder) / "f")
    assert np.array_equal(back.colour, frame.colour)
    assert np.abs(back.depth - frame.depth).max() <= 0.00005 + 1e-6
    assert np.array_equal(back.depth > 0, frame.depth > 0)
    assert (back.colour_k, back.depth_k) == (frame.colour_k, frame.depth_k)
    assert (back.sizes, back.taken) == (frame.sizes, frame.taken)
    assert all(map(np.array_equal, back.masks, frame.masks))
    assert len(back.masks) == len(frame.masks)
    assert (back.cell_from_camera is None) == (frame.cell_from_camera is None)
    if back.cell_from_camera is not None and frame.cell_from_camera is not None:
        one, other = back.cell_from_camera, frame.cell_from_camera
        assert one.translation == other.translation
        np.testing.assert_allclose(one.rotation, other.rotation, atol=1e-9)


def test_a_frame_replaces_the_one_that_stood_in_its_folder(kept: Path) -> None:
    """Its masks too."""
    frame = replace(read_frame_folder(kept), masks=(), taken=4.0)
    write_frame_folder(kept, frame)
    back = read_frame_folder(kept)
    assert (back.masks, back.taken) == ((), 4.0)


def test_a_depth_that_is_too_far_for_the_unit_counts_as_not_measured(kept: Path) -> None:
    """It must not come back as another depth."""
    far = replace(read_frame_folder(kept), depth=np.full((48, 64), 7.0, dtype=np.float32))
    write_frame_folder(kept, far)
    assert not read_frame_folder(kept).depth.any()
    write_frame_folder(kept, far, unit=0.001)
    assert read_frame_folder(kept).depth == pytest.approx(7.0, abs=5e-4)


def test_everything_that_is_wrong_is_told_at_once(kept: Path) -> None:
    """Not only the first thing."""
    (kept / "depth.png").unlink()
    (kept / "color.png").write_bytes(b"no picture")
    edited(kept, K="gone", depth_unit="gone", cell_from_camera=[[1, 2], [3, 4]])
    assert told(kept) == [
        (
            "frame.json, K: is missing; expected three rows of three numbers: "
            "[[fx, 0, cx], [0, fy, cy], [0, 0, 1]], in pixels"
        ),
        "frame.json, depth_unit: is missing; expected metres per count of depth.png, such as 0.001",
        (
            "frame.json, cell_from_camera: this is no matrix of 4 x 4 numbers; expected four rows "
            "of four numbers, the last 0 0 0 1, or null"
        ),
        "color.png: is no picture that can be read; expected a PNG picture",
        "depth.png: is missing; expected a PNG picture",
    ]


@pytest.mark.parametrize(
    ("key", "value", "said"),
    [
        ("K", [[60, 0, 31], [0, 60, 23]], "no matrix of 3 x 3 numbers"),
        ("K", [[60, 9, 31], [0, 60, 23], [0, 0, 1]], "is no matrix of a pinhole camera"),
        ("K", [[600, 0, 31], [0, 600, 23], [0, 0, 1]], "fx 600 is 6 degrees across a picture 64"),
        ("K", [[60, 0, 3], [0, 60, 23], [0, 0, 1]], "far from the middle of 64 x 48 pixels"),
        ("K", [[60, 0, 31], [0, 90, 23], [0, 0, 1]], "do not belong to one lens"),
        ("K", [[60, 0, 31], [0, True, 23], [0, 0, 1]], "this is no matrix of 3 x 3 numbers"),
        ("depth_K", [[600, 0, 31], [0, 600, 23], [0, 0, 1]], "depth_K: fx 600 is 6 degrees"),
        ("depth_unit", 1000, "1000 is no unit of a depth picture; counts per metre?"),
        ("depth_unit", 0, "0 is no unit of a depth picture; expected metres per count"),
        ("depth_unit", "mm", '"mm" is no number'),
        ("cell_from_camera", np.diag([2, 1, 1, 1]).tolist(), "3 from unit length"),
        ("cell_from_camera", np.diag([-1, 1, 1, 1]).tolist(), "is no rigid pose: it mirrors"),
        ("cell_from_camera", np.full((4, 4), 1).tolist(), "its last row is 1 1 1 1"),
        ("cell_from_camera", [[1, 0, 0, 800], *np.eye(4)[1:].tolist()], "is 800 m away"),
        ("sizes", 3, "3 is no list; expected a list of [length, width, height] in metres"),
        ("sizes", [[0.1, 0.2, 0.3], [0.1, 0.2]], "sizes[1]: this is no size"),
        ("sizes", [[300, 200, 100]], "sizes[0]: this is no size"),
        ("taken", "noon", '"noon" is no time'),
        ("depth_units", 0.001, "depth_units: is no key of a frame; did you mean 'depth_unit'?"),
    ],
)
def test_a_description_that_cannot_be_used_says_why(
    kept: Path, key: str, value: object, said: str
) -> None:
    """One problem each, with what was expected."""
    (problem,) = told(edited(kept, **{key: value}))
    assert said in problem


def test_a_text_that_is_no_description_is_told(kept: Path) -> None:
    """As JSON sees it."""
    for text, said in (("{", "is not JSON"), ("[1]", "is not an object"), ("[" * 9**5, "not JSON")):
        (kept / "frame.json").write_text(text)
        (problem,) = told(kept)
        assert said in problem


def test_pictures_of_wrong_sizes_and_depths_are_told(kept: Path) -> None:
    """A mask and a depth picture of other sizes, a depth picture of 8 bits."""
    cv2.imwrite(str(kept / "masks" / "a.png"), np.zeros((10, 20), dtype=np.uint8))
    cv2.imwrite(str(kept / "depth.png"), np.zeros((10, 20), dtype=np.uint16))
    assert told(kept) == [
        "masks/a.png: is 20 x 10, color.png 64 x 48; expected the same size",
        (
            "depth.png: is 20 x 10, color.png 64 x 48; expected the same size, or depth_K in "
            "frame.json"
        ),
    ]
    (kept / "masks" / "a.png").unlink()
    cv2.imwrite(str(kept / "depth.png"), np.zeros((48, 64, 3), dtype=np.uint8))
    expected = "depth.png: has 3 channel(s) of 8 bits; expected one channel of 16 bits"
    assert told(kept) == [expected]


def test_a_rounded_rotation_is_made_square(kept: Path) -> None:
    """People write four digits."""
    turn = np.round(Rotation.from_euler("xyz", (0.3, -0.7, 1.1)).as_matrix(), 4)
    rows = np.eye(4)
    rows[:3, :3] = turn
    pose = read_frame_folder(edited(kept, cell_from_camera=rows.tolist())).cell_from_camera
    assert pose is not None
    found = np.array(pose.rotation)
    np.testing.assert_allclose(found @ found.T, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(found, turn, atol=2e-4)


def test_folders_are_found_by_name_and_a_wrong_path_is_told(kept: Path, tmp_path: Path) -> None:
    """A frame's own folder, a folder of them, a folder without any, no folder."""
    other = tmp_path / "e"
    write_frame_folder(other, read_frame_folder(kept))
    assert frame_folders(kept) == (kept,)
    assert frame_folders(tmp_path) == (other, kept)
    with pytest.raises(FrameError, match="holds no frame"):
        frame_folders(kept / "masks")
    with pytest.raises(FrameError, match="there is no such folder"):
        frame_folders(tmp_path / "nowhere")
    assert told(tmp_path / "nowhere")[0].startswith("there is no such folder; expected a folder")


def test_registered_depth_lies_where_the_colour_sees_it() -> None:
    """A plane askew keeps its depths; outside of the depth picture nothing is measured."""
    colour_k, depth_k = lens(90, 60, 1.1), lens(60, 40, 1.4)

    def plane(k: Matrix3, width: int, height: int) -> np.ndarray:
        x = (np.arange(width) - k[0][2])[None, :] / k[0][0]
        y = (np.arange(height) - k[1][2])[:, None] / k[1][1]
        return (2.0 / (1.0 + 0.3 * x - 0.2 * y)).astype(np.float32)

    found = registered(plane(depth_k, 60, 40), depth_k, colour_k, (90, 60))
    true = plane(colour_k, 90, 60)
    inside = found > 0
    assert 0.5 < inside.mean() < 0.8
    assert not inside[:, :5].any()
    half_a_pixel = 0.5 / depth_k[0][0]
    assert np.abs(found - true)[inside].max() < 2.4**2 / 2.0 * (0.3 + 0.2) * half_a_pixel
    same = registered(true, colour_k, colour_k, (90, 60))
    assert np.array_equal(same, true)


def test_depth_counts_are_metres_by_the_unit(kept: Path) -> None:
    """A picture that another program wrote."""
    cv2.imwrite(str(kept / "depth.png"), np.full((48, 64), 1234, dtype=np.uint16))
    depth = read_frame_folder(edited(kept, depth_unit=0.001)).depth
    assert math.isclose(float(depth[3, 4]), 1.234, rel_tol=1e-6)
    assert depth.dtype == np.float32
