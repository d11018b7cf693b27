"""A camera that plays frames from folders."""

import asyncio
from dataclasses import replace
from pathlib import Path

from depal.errors import DeviceError, FrameError, Problem
from depal.executive.clock import Clock
from depal.geometry import Pose
from depal.perception.frames import frame_folders, read_frame_folder
from depal.ports import Frame


class RecordedCamera:
    """Frames of a folder in the order of their names, one a picture."""

    def __init__(
        self,
        path: Path,
        clock: Clock,
        cell_from_camera: Pose | None = None,
        *,
        exposure: float = 0.0,
    ) -> None:
        """Finds the frames; each is read when its turn comes.

        Args:
            path: a folder of frame folders, or one frame's.
            clock: what its frames are stamped with.
            cell_from_camera: where they were taken from, if they do not know it themselves.
            exposure: how long a picture takes [s].

        Raises:
            FrameError: there is no frame, or the first one cannot be used.
        """
        self._folders = frame_folders(path)
        self._clock, self._pose, self._exposure = clock, cell_from_camera, exposure
        self._played = 0
        first = read_frame_folder(self._folders[0])
        if first.cell_from_camera is None and cell_from_camera is None:
            what = "does not say where it was taken from"
            expected = "cell_from_camera in frame.json, or a calibrated camera"
            raise FrameError(str(self._folders[0]), [Problem("", what, expected)])

    async def take(self) -> Frame:
        """The next frame.

        Raises:
            DeviceError: all have been played, or this one cannot be used.
        """
        await asyncio.sleep(self._exposure)
        if self._played == len(self._folders):
            raise DeviceError(f"recorded camera: all {self._played} frames have been played")
        folder = self._folders[self._played]
        self._played += 1
        try:
            recorded = read_frame_folder(folder)
        except FrameError as error:
            raise DeviceError(f"recorded camera: {error}") from error
        return replace(recorded.as_frame(self._pose), taken=self._clock.now())
