"""From planned paths to trajectories, with this cell's speeds and this box's suction."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from depal.domain import CellLayout, Joints
from depal.motion.collision import Checker
from depal.motion.collision.values import Array
from depal.motion.grasping import Holding
from depal.motion.kinematics import Kinematics
from depal.motion.moves import Kind, Part
from depal.motion.planning.straight import straight
from depal.motion.timing import Leg, time_path
from depal.ports import Trajectory

GENTLE = 0.7
"""Share of the straight speed at which a box is pulled out of the pile."""

HERE = 0.01
"""A plan is good for an arm that stands this near to where it begins [rad]."""


@dataclass(frozen=True, slots=True)
class Timing:
    """Times paths for one cell.

    Attributes:
        layout: the cell.
        speed: share of the arm's full speed.
        cone: whether the suction's limits are respected; switched off by tests alone.
        most: tells what the flange may not exceed whatever the share [m/s].
    """

    layout: CellLayout
    speed: float = 1.0
    cone: bool = True
    most: Callable[[], float] = lambda: math.inf

    def along(
        self,
        parts: Sequence[Part],
        holding: Holding | None = None,
        checker: Checker | None = None,
        pace: float = 1.0,
    ) -> Trajectory | None:
        """The fastest trajectory along some parts; None where the suction would not hold.

        Args:
            parts: one after the other.
            holding: what hangs on the cups.
            checker: corners are rounded where it finds nothing near.
            pace: further share of the speed.
        """
        legs = [
            Leg(
                part.path,
                curve=part.kind is Kind.STRAIGHT,
                speed=self._speed_of(part, first=number == 0),
                touching=part.touching,
            )
            for number, part in enumerate(parts)
        ]
        held, speed = holding if self.cone else None, pace * self.speed
        rounded = None if checker is None else checker.path_free
        timed = time_path(legs, self.layout.robot, held=held, clear=rounded, speed=speed)
        if timed is not None and not np.isfinite(timed.positions).all():
            timed = time_path(legs, self.layout.robot, held=held, speed=speed)
        return timed

    def _speed_of(self, part: Part, *, first: bool) -> float:
        """Of the flange [m/s]; out of the pile, where a motion begins, a box may rub: gently.

        The share shrinks it further, so a limit that is absolute grows by it first.
        """
        speeds, most = self.layout.speeds, min(self.most(), part.most) / self.speed
        if part.kind is Kind.FREE:
            return min(speeds.flange, most)
        return min(speeds.straight * (GENTLE if first and part.touching else 1.0), most)

    def slowly(self, part: Part, holding: Holding | None = None) -> Trajectory | None:
        """Along a straight part at the speed at which boxes are set down."""
        speed = min(self.layout.speeds.set_down, self.most() / self.speed)
        leg = Leg(part.path, curve=True, speed=speed, touching=part.touching)
        held = holding if self.cone else None
        return time_path([leg], self.layout.robot, held=held, speed=self.speed)


def rebased(path: Array, start: Array) -> Array:
    """A path that begins elsewhere: the difference fades out along it.

    Args:
        path: (n, 6) [rad].
        start: (6,) where the arm really is, not far from the path's start [rad].
    """
    share = np.linspace(1.0, 0.0, len(path))[:, None]
    out: Array = path + share * (start - path[0])
    return out


def straight_to_end(kinematics: Kinematics, path: Array, start: Array) -> Array:
    """A straight move of the flange that begins elsewhere, to the same end.

    Near a stretched wrist a rest some millimetres off turns two axes by a lot against each other,
    and a difference that fades out along the path would swing the tool (`rebased`).

    Args:
        kinematics: of the arm.
        path: (n, 6) straight, at constant orientation [rad].
        start: (6,) where the arm really is, not far from the path's start [rad].

    Returns:
        (m, 6) [rad]; the path with a difference that fades out where there is no straight one.
    """
    begin, end = kinematics.frames(start)[6][:, 3], kinematics.frames(path[-1])[6][:, 3]
    x, y, z = (end - begin).tolist()
    way = straight(kinematics, start, (x, y, z))
    if way is None or not stands_at(way[-1], path[-1]):
        return rebased(path, start)
    way[-1] = path[-1]
    return way


def stands_at(here: Joints | Array, there: Joints | Array) -> bool:
    """Whether an arm stands where a plan begins."""
    return bool(np.abs(np.array(here) - np.array(there)).max() < HERE)
