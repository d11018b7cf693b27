"""Frames: kept in folders, read back, and judged before anything is grasped on them."""

from depal.perception.frames.checks import problems_of
from depal.perception.frames.folders import frame_folders, read_frame_folder, write_frame_folder
from depal.perception.frames.recorded import RecordedFrame, registered

__all__ = [
    "RecordedFrame",
    "frame_folders",
    "problems_of",
    "read_frame_folder",
    "registered",
    "write_frame_folder",
]
