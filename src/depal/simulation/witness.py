"""Which box of the stack the cell means by a name: what somebody saw who stood beside it."""

import math
from collections.abc import Mapping

import numpy as np

from depal.domain import BoxId
from depal.geometry import Vector3
from depal.simulation.referee import PALLET, Referee
from depal.simulation.world import World

NEAR = 0.10
"""A place that is pointed at is this far outside of the box that is meant at the most [m]."""


def name_of(index: int) -> BoxId:
    """What a box of the stack is called by a sight that knows the truth: b1 is the first."""
    return BoxId(f"b{index + 1}")


class Witness:
    """The cell has names of its own for boxes; a name means the box that was in the hand.

    Nothing of this reaches the cell: the worker and the reports ask.
    """

    def __init__(self, world: World) -> None:
        """Has seen nothing yet."""
        self._world = world
        self._referee = Referee(world)
        self._indices: dict[BoxId, int] = {}

    @property
    def indices(self) -> Mapping[BoxId, int]:
        """The boxes that names mean, by their index in the stack."""
        return self._indices

    def lifted(self, name: BoxId, now: float) -> None:
        """The cell says that the arm holds a box of this name."""
        self._world.advance(now)
        held = self._world.suction.held_boxes
        if held:
            masses = self._world.cases
            self.means(name, max(held, key=lambda index: (masses[index].mass, -index)))

    def means(self, name: BoxId, index: int) -> None:
        """A name means this box."""
        self._indices[name] = index

    def find(self, name: BoxId, at: Vector3 | None = None) -> int | None:
        """The box of a name; one that nobody has seen in the hand is where it is pointed at.

        Args:
            name: in the cell.
            at: where the cell believes its middle, in the cell frame [m].

        Returns:
            Its index in the stack; None where no such box is there.
        """
        if name in self._indices:
            return self._indices[name]
        if at is None:
            return next((c.index for c in self._world.cases if name_of(c.index) == name), None)
        return self.nearest(at)

    def nearest(self, at: Vector3) -> int | None:
        """The box on the pallet that a place lies in or near; None where there is none [m]."""
        used = set(self._indices.values())
        found: list[tuple[float, float, int]] = []
        for case in self._world.cases:
            if case.index in used or self._referee.where(case.index) != PALLET:
                continue
            pose = self._world.box(case.index)
            inside = np.abs(np.array(pose.inverse.apply(at))) - np.array(case.shape.size) / 2
            out = float(np.linalg.norm(np.maximum(inside, 0.0)))
            if out <= NEAR:
                found.append((out, math.dist(at, pose.translation), case.index))
        return min(found)[2] if found else None
