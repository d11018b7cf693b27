"""What planning needs to know of the axes, and how it measures: by time."""

from typing import NamedTuple

from depal.geometry import loop_kernel
from depal.motion.collision.values import Array


class Axes(NamedTuple):
    """What a search needs to know of the arm's axes.

    Attributes:
        speed: (6,) [rad/s].
        lower: (6,) [rad].
        upper: (6,) [rad].
        step: of the checks along edges [m].
    """

    speed: Array
    lower: Array
    upper: Array
    step: float


@loop_kernel
def span(a: Array, b: Array, speed: Array) -> float:
    """The time of the straight joint line between two configurations at full speed [s]."""
    most = 0.0
    for axis in range(6):
        most = max(most, abs(a[axis] - b[axis]) / speed[axis])
    return most
