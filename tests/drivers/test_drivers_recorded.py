"""A camera that plays folders, and the median of several exposures."""

import asyncio
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as some

from depal.drivers import RecordedCamera
from depal.drivers.median import temporal_median
from depal.errors import DeviceError, FrameError
from depal.geometry import Pose
from depal.perception.frames import RecordedFrame, write_frame_folder

K = ((40.0, 0.0, 31.5), (0.0, 40.0, 23.5), (0.0, 0.0, 1.0))
COUNTS = some.arrays(np.uint16, (5, 3, 4), elements=st.integers(0, 0xFFFE))


class Clock:
    """A clock that stands."""

    def now(self) -> float:
        """When."""
        return 7.5


def grey(value: int, pose: Pose | None = None) -> RecordedFrame:
    """A frame of one colour."""
    colour = np.full((48, 64, 3), value, dtype=np.uint8)
    return RecordedFrame(colour, np.full((48, 64), 1.5, dtype=np.float32), K, K, pose)


def played(camera: RecordedCamera, count: int) -> list[int]:
    """The brightness of the frames that come."""

    async def take() -> list[int]:
        return [int((await camera.take()).colour[0, 0, 0]) for _ in range(count)]

    return asyncio.run(take())


def test_frames_come_in_the_order_of_their_names(tmp_path: Path) -> None:
    """Stamped by the clock; after the last one the camera says so."""
    for name, value in (("b", 2), ("a", 1), ("c", 3)):
        write_frame_folder(tmp_path / name, grey(value, Pose()))
    camera = RecordedCamera(tmp_path, Clock())
    assert played(camera, 3) == [1, 2, 3]
    with pytest.raises(DeviceError, match="all 3 frames have been played"):
        asyncio.run(camera.take())
    again = asyncio.run(RecordedCamera(tmp_path / "b", Clock()).take())
    assert (again.taken, again.colour[0, 0, 0]) == (7.5, 2)


def test_a_frames_own_pose_wins_over_the_cameras(tmp_path: Path) -> None:
    """And without either the camera is refused at once."""
    there, other = Pose((1.0, 0.0, 0.0)), Pose((2.0, 0.0, 0.0))
    write_frame_folder(tmp_path / "a", grey(1, there))
    write_frame_folder(tmp_path / "b", grey(1))
    camera = RecordedCamera(tmp_path, Clock(), other)
    poses = [asyncio.run(camera.take()).cell_from_camera for _ in range(2)]
    assert poses == [there, other]
    with pytest.raises(FrameError, match="does not say where it was taken from"):
        RecordedCamera(tmp_path / "b", Clock())


def test_a_frame_that_is_damaged_later_stops_the_camera(tmp_path: Path) -> None:
    """With everything that is wrong with it."""
    for name in ("a", "b"):
        write_frame_folder(tmp_path / name, grey(1, Pose()))
    (tmp_path / "b" / "depth.png").unlink()
    camera = RecordedCamera(tmp_path, Clock())
    assert played(camera, 1) == [1]
    with pytest.raises(DeviceError, match=r"recorded camera: .*depth\.png: is missing"):
        asyncio.run(camera.take())


@given(COUNTS)
def test_the_median_is_one_of_the_measurements_and_in_their_middle(depths: np.ndarray) -> None:
    """At most half of a pixel's measurements lie on either side of it."""
    found = temporal_median(depths)
    for row, column in np.ndindex(found.shape):
        each = depths[:, row, column]
        measured = each[each > 0]
        if 2 * len(measured) < len(each):
            assert found[row, column] == 0
            continue
        assert found[row, column] in measured
        assert 2 * np.count_nonzero(measured < found[row, column]) <= len(measured)
        assert 2 * np.count_nonzero(measured > found[row, column]) <= len(measured)


@given(COUNTS, st.permutations(range(5)))
def test_the_order_of_exposures_does_not_matter(depths: np.ndarray, order: list[int]) -> None:
    """And neither the pictures that are given nor their order change."""
    before = depths.copy()
    assert np.array_equal(temporal_median(depths), temporal_median(depths[order]))
    assert np.array_equal(depths, before)


def test_a_frame_without_a_pose_becomes_one_in_the_cameras_own_frame() -> None:
    """Where nobody knows better."""
    frame = replace(grey(1), taken=3.0).as_frame()
    assert (frame.cell_from_camera, frame.taken) == (Pose(), 3.0)
