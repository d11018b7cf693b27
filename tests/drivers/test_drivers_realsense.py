"""A RealSense behind the port, by a software device where `pyrealsense2` is installed."""

# ruff: noqa: ANN401 - pyrealsense2 has no types
import asyncio
import importlib
import sys
import types
from typing import Any

import numpy as np
import pytest

from depal.drivers import RealSenseCamera
from depal.drivers.realsense import load_realsense
from depal.errors import DeviceError, MissingPartError
from depal.geometry import Pose

COLOUR, DEPTH = (320, 240), (160, 120)
POSE = Pose((1.0, 2.0, 3.0))


class Clock:
    """A clock that stands."""

    def now(self) -> float:
        """When."""
        return 7.5


def realsense() -> Any:
    """The module; the test is skipped where it does not load, with the reason."""
    try:
        return load_realsense()
    except MissingPartError as error:
        pytest.skip(str(error))


class SoftwareDevice:
    """A RealSense without hardware: pictures are pushed in and come out of a syncer."""

    def __init__(self, rs: Any) -> None:
        """Two sensors, one syncer, nothing pushed yet."""
        self.rs, self.pushed = rs, 0
        self.device = rs.software_device()
        self.depth_sensor, self.colour_sensor = map(self.device.add_sensor, ("Depth", "Color"))
        self.depth_sensor.add_read_only_option(rs.option.depth_units, 0.0005)
        self.depth = self.depth_sensor.add_video_stream(
            self.stream(rs.stream.depth, 0, DEPTH, 2, rs.format.z16, 150.0)
        )
        self.colour = self.colour_sensor.add_video_stream(
            self.stream(rs.stream.color, 1, COLOUR, 3, rs.format.rgb8, 300.0)
        )
        same = rs.extrinsics()
        same.rotation, same.translation = [1, 0, 0, 0, 1, 0, 0, 0, 1], [0, 0, 0]
        self.depth.register_extrinsics_to(self.colour, same)
        self.device.create_matcher(rs.matchers.dlr_c)
        self.syncer = rs.syncer(100)
        for sensor, profile in (
            (self.depth_sensor, self.depth),
            (self.colour_sensor, self.colour),
        ):
            sensor.open(profile)
            sensor.start(self.syncer)

    def stream(
        self, kind: Any, uid: int, size: tuple[int, int], bytes_each: int, form: Any, focal: float
    ) -> Any:
        """What a stream is."""
        rs = self.rs
        lens = rs.intrinsics()
        lens.width, lens.height = size
        lens.fx = lens.fy = focal
        lens.ppx, lens.ppy = (size[0] - 1) / 2, (size[1] - 1) / 2
        lens.model, lens.coeffs = rs.distortion.none, [0.0] * 5
        stream = rs.video_stream()
        stream.type, stream.index, stream.uid = kind, 0, uid
        stream.width, stream.height = size
        stream.fps, stream.bpp, stream.fmt, stream.intrinsics = 30, bytes_each, form, lens
        return stream

    def push(self, depth: np.ndarray, colour: np.ndarray) -> None:
        """One exposure of both."""
        for sensor, profile, pixels, each in (
            (self.depth_sensor, self.depth, depth, 2),
            (self.colour_sensor, self.colour, colour, 3),
        ):
            frame = self.rs.software_video_frame()
            frame.stride, frame.bpp, frame.pixels = each * pixels.shape[1], each, pixels
            frame.timestamp = 33.0 * self.pushed
            frame.domain = self.rs.timestamp_domain.hardware_clock
            frame.frame_number = self.pushed
            frame.profile = profile.as_video_stream_profile()
            if each == 2:
                frame.depth_units = 0.0005
            sensor.on_video_frame(frame)
        self.pushed += 1


def test_without_the_module_an_error_says_how_to_install_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It is optional."""
    monkeypatch.setitem(sys.modules, "pyrealsense2", None)
    with pytest.raises(MissingPartError, match=r"pip install 'depal\[realsense\]'"):
        RealSenseCamera.started(Clock(), POSE)


def test_a_module_that_does_not_load_says_which_library_it_misses(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """On a machine without libusb the wheel installs and does not load."""

    def fails(name: str) -> types.ModuleType:
        raise ImportError(f"libusb-1.0.so.0: cannot open shared object file, for {name}")

    monkeypatch.setattr(importlib, "import_module", fails)
    with pytest.raises(MissingPartError, match=r"does not load: libusb.*libusb-1\.0-0"):
        load_realsense()


def test_depth_is_a_median_on_the_colours_pixels() -> None:
    """Through the software device: sizes, intrinsics, units, the middle of the exposures."""
    device = SoftwareDevice(realsense())
    camera = RealSenseCamera(device.syncer, Clock(), POSE, exposures=5, timeout=1.0)
    colour = np.random.default_rng(0).integers(0, 255, (*COLOUR[::-1], 3), dtype=np.uint8)
    for number in range(8):
        outlier = 400 if number % 3 == 2 else 0
        device.push(np.full(DEPTH[::-1], 3000 + number + outlier, dtype=np.uint16), colour)
    frame = asyncio.run(camera.take())
    assert frame.taken == 7.5
    assert frame.cell_from_camera == POSE
    assert frame.colour.shape == (*COLOUR[::-1], 3)
    assert np.array_equal(frame.colour, colour)
    assert frame.depth.shape == COLOUR[::-1]
    assert frame.depth[100:140, 100:200] == pytest.approx(1.5, abs=0.004)
    assert frame.colour_k == ((300.0, 0.0, 159.5), (0.0, 300.0, 119.5), (0.0, 0.0, 1.0))
    assert frame.depth_k == frame.colour_k


def test_a_camera_that_falls_silent_is_told() -> None:
    """With how many pictures came before."""
    device = SoftwareDevice(realsense())
    camera = RealSenseCamera(device.syncer, Clock(), POSE, exposures=4, timeout=0.1)
    for _ in range(2):
        device.push(np.full(DEPTH[::-1], 3000, np.uint16), np.zeros((*COLOUR[::-1], 3), np.uint8))
    with pytest.raises(DeviceError, match=r"no picture came within 0\.1 s after [012] of 4"):
        camera.collected()


def test_no_camera_is_told() -> None:
    """With what is connected."""
    realsense()
    with pytest.raises(DeviceError, match=r"RealSense: .*; connected: "):
        RealSenseCamera.started(Clock(), POSE, serial="")
