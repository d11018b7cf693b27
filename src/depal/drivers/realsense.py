"""A RealSense camera, through `pyrealsense2`, which is loaded when a camera is first asked for."""

# ruff: noqa: ANN401 - pyrealsense2 has no types
import asyncio
import importlib
from typing import Any, Protocol

import numpy as np

from depal.drivers.median import temporal_median
from depal.errors import DeviceError, MissingPartError
from depal.executive.clock import Clock
from depal.geometry import Matrix3, Pose
from depal.ports import Frame

EXPOSURES = 10
"""Depth is the median of so many pictures."""

TIMEOUT = 2.0
"""So long a picture may take to come [s]."""

WARM_UP = 15
"""So many pictures pass after the start until the exposure has settled."""

INCOMPLETE = 3
"""So many sets without colour or depth are passed over for each that is whole."""


class FrameSets(Protocol):
    """Where sets of pictures come from: a pipeline, or the syncer of a software device."""

    def wait_for_frames(self, timeout_ms: int) -> Any:
        """The next set; RuntimeError where none comes in time."""
        ...


def load_realsense() -> Any:
    """The module `pyrealsense2`.

    Raises:
        MissingPartError: it is not installed, or a system library that it needs is not.
    """
    try:
        return importlib.import_module("pyrealsense2")
    except ModuleNotFoundError as error:
        raise MissingPartError(
            "a RealSense camera needs pyrealsense2: pip install 'depal[realsense]'"
        ) from error
    except ImportError as error:
        raise MissingPartError(
            f"pyrealsense2 is installed but does not load: {error}; its system library is in the "
            "package libusb-1.0-0 of Debian and Ubuntu"
        ) from error


class RealSenseCamera:
    """Colour and depth, depth brought to the colour's pixels and to a median over time."""

    def __init__(
        self,
        sets: FrameSets,
        clock: Clock,
        cell_from_camera: Pose,
        *,
        exposures: int = EXPOSURES,
        timeout: float = TIMEOUT,
    ) -> None:
        """A camera whose pictures already come.

        Args:
            sets: a pipeline that was started, or a syncer.
            clock: what frames are stamped with.
            cell_from_camera: the pose of its colour lens: z forward, x right, y down.
            exposures: depth is the median of so many.
            timeout: so long each may take to come [s].

        Raises:
            MissingPartError: `pyrealsense2` is not there.
        """
        rs = load_realsense()
        self._sets, self._clock, self._pose = sets, clock, cell_from_camera
        self._exposures, self._timeout = exposures, timeout
        self._align = rs.align(rs.stream.color)

    @classmethod
    def started(
        cls,
        clock: Clock,
        cell_from_camera: Pose,
        *,
        serial: str = "",
        colour_size: tuple[int, int] = (1920, 1080),
        depth_size: tuple[int, int] = (1280, 720),
        rate: int = 15,
    ) -> "RealSenseCamera":
        """Starts a connected camera and lets its exposure settle.

        Args:
            clock: what frames are stamped with.
            cell_from_camera: the pose of its colour lens.
            serial: its number; empty for the only one.
            colour_size: width and height of the colour picture [pixel].
            depth_size: the same of the depth picture.
            rate: pictures a second.

        Raises:
            MissingPartError: `pyrealsense2` is not there.
            DeviceError: no such camera is connected, or it cannot do this.
        """
        rs = load_realsense()
        pipeline, config = rs.pipeline(), rs.config()
        if serial:
            config.enable_device(serial)
        config.enable_stream(rs.stream.color, *colour_size, rs.format.rgb8, rate)
        config.enable_stream(rs.stream.depth, *depth_size, rs.format.z16, rate)
        try:
            pipeline.start(config)
            for _ in range(WARM_UP):
                pipeline.wait_for_frames(round(TIMEOUT * 1000))
        except RuntimeError as error:
            named = f"RealSense {serial}" if serial else "RealSense"
            there = [one.get_info(rs.camera_info.serial_number) for one in rs.context().devices]
            connected = ", ".join(there) or "none"
            raise DeviceError(f"{named}: {error}; connected: {connected}") from error
        return cls(pipeline, clock, cell_from_camera)

    async def take(self) -> Frame:
        """One picture; the loop is free while the exposures come.

        Raises:
            DeviceError: no picture came in time.
        """
        return await asyncio.to_thread(self.collected)

    def collected(self) -> Frame:
        """The same, blocking.

        Raises:
            DeviceError: no picture came in time.
        """
        depths = list[np.ndarray[tuple[int, int], np.dtype[np.uint16]]]()
        colour = depth = None
        for _ in range(INCOMPLETE * self._exposures):
            if len(depths) == self._exposures:
                break
            try:
                aligned = self._align.process(self._next(len(depths)))
            except RuntimeError as error:
                raise DeviceError(f"RealSense: {error}") from error
            colour_here, depth_here = aligned.get_color_frame(), aligned.get_depth_frame()
            if colour_here and depth_here:
                colour, depth = colour_here, depth_here
                depths.append(np.array(depth.get_data(), dtype=np.uint16))
        if colour is None or depth is None or len(depths) < self._exposures:
            raise DeviceError(
                f"RealSense: {len(depths)} of {self._exposures} pictures had colour and depth"
            )
        counts = temporal_median(np.stack(depths))
        metres = (counts * np.float64(depth.get_units())).astype(np.float32)
        pixels = np.array(colour.get_data(), dtype=np.uint8)
        k = _matrix(colour.profile.as_video_stream_profile().intrinsics)
        return Frame(self._clock.now(), pixels, metres, k, k, self._pose)

    def _next(self, have: int) -> Any:
        """The next set of pictures."""
        try:
            found = self._sets.wait_for_frames(round(self._timeout * 1000))
        except RuntimeError as error:
            raise DeviceError(
                f"RealSense: no picture came within {self._timeout:g} s after {have} of "
                f"{self._exposures}: {error}"
            ) from error
        return found.as_frameset() if hasattr(found, "as_frameset") else found


def _matrix(lens: Any) -> Matrix3:
    """Intrinsics as rows; the pictures of a D400 come without distortion."""
    return ((lens.fx, 0.0, lens.ppx), (0.0, lens.fy, lens.ppy), (0.0, 0.0, 1.0))
