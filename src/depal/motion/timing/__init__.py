"""When the arm is where: rounded corners, limits of axes, flange and suction, fastest motions."""

from depal.motion.timing.blending import Clear, Smoother
from depal.motion.timing.legs import Leg, Path
from depal.motion.timing.timing import bound_time, full_speed_time, smooth, time_path, time_smooth

__all__ = [
    "Clear",
    "Leg",
    "Path",
    "Smoother",
    "bound_time",
    "full_speed_time",
    "smooth",
    "time_path",
    "time_smooth",
]
