"""When the arm is out of the camera's view of the pallet."""

import asyncio
import math

from depal.cell.planning.facing import pallet_heading
from depal.cell.workplace import Workplace
from depal.domain import BoxId, Joints
from depal.motion.collision.values import Array
from depal.motion.kinematics import Kinematics
from depal.ports import Trajectory

AWAY = math.radians(40)
"""The view of the pallet is clear when the flange's heading is this far from the pallet's."""


class Viewing:
    """Tells when the pallet can be seen again."""

    def __init__(self, work: Workplace, kinematics: Kinematics) -> None:
        """Follows the flange.

        Args:
            work: told when a box counts as gone.
            kinematics: of the arm.
        """
        self._work = work
        self._kinematics = kinematics

    def clears(self, box: BoxId, trajectory: Trajectory) -> None:
        """The box counts as gone once the arm, which sets out now, is out of the view."""
        gone = self._work.gone(box)
        if not gone.is_set():
            delay = self._clear_at(trajectory)
            asyncio.get_running_loop().call_later(delay, gone.set)

    def covered(self) -> bool:
        """Whether the arm is before the pallet now."""
        return not self._is_away(self._work.ports.arm.joints())

    def _is_away(self, q: Joints | Array) -> bool:
        p = self._kinematics.flange(q).translation
        turn = math.atan2(p[1], p[0]) - pallet_heading(self._work.layout.pallet)
        return abs(math.atan2(math.sin(turn), math.cos(turn))) > AWAY

    def _clear_at(self, trajectory: Trajectory) -> float:
        for time, q in zip(trajectory.times, trajectory.positions, strict=True):
            if self._is_away(q):
                return float(time)
        return trajectory.duration
