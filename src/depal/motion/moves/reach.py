"""What every whole motion needs: checks for a hand, configurations for a pose, straight moves."""

import copy

import numpy as np

from depal.domain import CellLayout, Grasp
from depal.geometry import Pose, Vector3
from depal.motion.collision import Body, Checker, Hand, Margins, Scene, Upright, held_box
from depal.motion.collision.values import Array
from depal.motion.moves.margins import FURTHEST, TILT
from depal.motion.planning.free import FreePlanner
from depal.motion.planning.straight import straight_as_far

STRIDE = 4
"""So many configurations further it is asked again whether the arm can draw in."""


class Reach:
    """One cell's arm, and what can be asked of it.

    Attributes:
        layout: the cell.
        body: its arm, ready for checks.
        free: plans through free space.
        tilt: how far a held box may lean [rad].
    """

    def __init__(self, layout: CellLayout) -> None:
        """For a cell."""
        self.layout = layout
        self.tilt = TILT
        self.body = Body.of(layout)
        self.free = FreePlanner(self.body.kinematics, layout.robot.limits)
        self._speed = np.array(layout.robot.limits.speed)

    def leaning(self, tilt: float) -> "Reach":
        """The same arm with a held box that leans no further than this [rad]."""
        other = copy.copy(self)
        other.tilt = tilt
        return other

    def checker(
        self,
        scene: Scene,
        margins: Margins,
        grasp: Grasp | None = None,
        size: Vector3 | None = None,
        *,
        folded: bool = False,
    ) -> Checker:
        """The check for an empty hand, or for one that holds a box by a grasp."""
        tool = self.layout.tool
        if grasp is None or size is None:
            return Checker(self.body, Hand.of(tool, folded=folded), scene, margins)
        hand = Hand.of(tool, folded=grasp.folded, held=held_box(grasp, size))
        up = np.array(grasp.box_from_flange.rotation)[2].tolist()
        return Checker(self.body, hand, scene, margins, Upright((up[0], up[1], up[2]), self.tilt))

    def branches(self, pose: Pose, near: Array) -> Array:
        """The configurations for a pose of the flange, the nearest in time first, (k, 6)."""
        found = self.body.kinematics.solve(pose, near)
        if not len(found):
            return found
        times = (np.abs(found - near) / self._speed).max(axis=1)
        return found[np.argsort(times, kind="stable")]

    def way_out(
        self,
        start: Array,
        way: Vector3,
        near: Checker,
        clear: Checker,
        least: int = 0,
        also: Checker | None = None,
    ) -> Array | str:
        """Straight along a direction until all is clear and the arm can draw in.

        Args:
            start: (6,) where it begins [rad].
            way: the direction, of length 1.
            near: must hold all along.
            clear: must hold at the end.
            least: how many steps it has at least.
            also: must hold at the end as well: for another shape of the hand.

        Returns:
            (n, 6) [rad], or why there is no such way.
        """
        path = straight_as_far(self.body.kinematics, start, scaled(way, FURTHEST))
        if len(path) <= least:
            return "no reach to move straight out"
        row = clear.first_free(path[least:])
        if row is None:
            return clear.why(path[-1])
        blocked = near.first_hit(path)
        last = len(path) if blocked is None else blocked
        for end in range(least + row, last, STRIDE):
            if also is not None and not also.free(path[end]):
                continue
            if clear.free(path[end]) and self.free.is_open(clear, path[end]):
                return path[: end + 1].copy()
        return "no room to draw the arm in" if blocked is None else near.why(path[blocked])


def scaled(vector: Vector3, factor: float) -> Vector3:
    """A vector times a number."""
    x, y, z = vector
    return (factor * x, factor * y, factor * z)
