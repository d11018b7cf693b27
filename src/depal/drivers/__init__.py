"""Real devices behind the ports, and recorded ones."""

from depal.drivers.realsense import RealSenseCamera
from depal.drivers.recorded import RecordedCamera

__all__ = ["RealSenseCamera", "RecordedCamera"]
