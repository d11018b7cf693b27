"""Calibrations in files: they come back, and what is wrong is told at once."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from depal.errors import FrameError
from depal.geometry import Pose
from depal.perception.calibration import (
    Calibration,
    DepthScale,
    calibrations_for,
    fields_of,
    nominal_k,
    read_calibrations,
)
from depal.perception.calibration.matrices import lens_of_rows, pose_of_rows, rows_of

KNOWN = Calibration(
    Pose((1.0, -2.0, 0.5)),
    DepthScale(1.0031, -0.002, 0.0004, 7),
    0.0004,
    {0: 0.0003, 10: 0.0005},
    nominal_k((1080, 1920), 1.2),
    nominal_k((720, 1280), 1.2),
)
VECTORS = st.tuples(*[st.floats(-3.0, 3.0)] * 3)


def kept(path: Path, **changes: object) -> Path:
    """A file with one camera, some of its fields replaced."""
    fields = json.loads(json.dumps({"cameras": fields_of({"front": KNOWN})}))
    fields["cameras"]["front"] |= changes
    path.write_text(json.dumps(fields))
    return path


def told(path: Path) -> list[str]:
    """Everything that is said about a file."""
    with pytest.raises(FrameError) as caught:
        read_calibrations(path)
    return [str(problem) for problem in caught.value.problems]


def test_what_is_written_comes_back(tmp_path: Path) -> None:
    """Every figure of it; what else the file says is left alone."""
    found = read_calibrations(kept(tmp_path / "c.json", remark="mounted anew"))["front"]
    assert found.seen == KNOWN.seen
    assert replace(found, seen=KNOWN.seen).cell_from_camera == KNOWN.cell_from_camera
    assert (found.depth, found.residual) == (KNOWN.depth, KNOWN.residual)
    assert (found.colour_k, found.depth_k) == (KNOWN.colour_k, KNOWN.depth_k)


@given(VECTORS, VECTORS)
def test_a_pose_comes_back_from_its_rows(shift: tuple[float, ...], turn: tuple[float, ...]) -> None:
    """Through JSON as well."""
    pose = Pose.from_arrays(shift, Rotation.from_rotvec(turn).as_matrix())
    back = pose_of_rows(json.loads(json.dumps(rows_of(pose))))
    assert isinstance(back, Pose)
    np.testing.assert_allclose(back.rotation, pose.rotation, atol=1e-9)
    assert back.translation == pose.translation


def test_everything_that_is_wrong_is_told_at_once(tmp_path: Path) -> None:
    """With the camera, and what was expected."""
    path = kept(
        tmp_path / "c.json",
        cell_from_camera=[[1, 2]],
        K=3,
        depth_scale=2.0,
        depth_offset=None,
        residual="small",
    )
    assert told(path) == [
        (
            "cameras.front.cell_from_camera: this is no matrix of 4 x 4 numbers; expected four "
            "rows of four numbers"
        ),
        "cameras.front.K: 3 is no matrix of 3 x 3 numbers; expected three rows of three numbers",
        "cameras.front.depth_scale: is 2.0; expected a number from 0.8 to 1.25",
        "cameras.front.depth_offset: is null; expected a number from -0.2 to 0.2",
        'cameras.front.residual: is "small"; expected a number from 0 to 1',
    ]


def test_a_file_that_is_none_is_told(tmp_path: Path) -> None:
    """With the command that writes one."""
    path = tmp_path / "c.json"
    assert told(path) == [
        (
            "cannot be read: No such file or directory; expected a file that depal calibrate "
            "--json wrote"
        )
    ]
    for text, said in (
        ("{", "is not JSON"),
        ("[]", "cameras: is missing"),
        ('{"cameras": {"a": 1}}', "is not an object"),
    ):
        path.write_text(text)
        assert said in told(path)[0]


def test_every_camera_of_a_cell_must_be_in_the_file(tmp_path: Path) -> None:
    """Those that are not are named, with what there is."""
    path = kept(tmp_path / "c.json")
    assert set(calibrations_for(path, ("front",))) == {"front"}
    with pytest.raises(FrameError, match="there is no camera 'top'; there is: front"):
        calibrations_for(path, ("front", "top"))


def test_a_lens_needs_two_positive_focal_lengths() -> None:
    """And no skew."""
    assert lens_of_rows([[5, 0, 1], [0, 6, 2], [0, 0, 1]]) == ((5, 0, 1), (0, 6, 2), (0, 0, 1))
    for rows in ([[-5, 0, 1], [0, 6, 2], [0, 0, 1]], [[5, 0, 1], [0, 6, 2], [0, 0, 2]]):
        assert lens_of_rows(rows) == "is no matrix of a pinhole camera without skew"
