"""The referee: the truth about the simulated cell, for reports and tests only."""

from collections import Counter
from dataclasses import dataclass

import numpy as np

from depal.domain import Gtin, Place, PlaceId
from depal.geometry import Pose
from depal.simulation.contacts import Collision
from depal.simulation.losses import Loss
from depal.simulation.world import World

PALLET = "pallet"
HAND = "hand"
FLOOR = "floor"
REMOVED = "removed"
ELSEWHERE = "elsewhere"

EDGE = 0.1
"""A box whose centre is this far outside the pallet still counts as on it [m]."""

LYING = 0.05
"""A box whose lowest corner is below this lies on the floor [m]."""

SLACK = 0.02
"""A box whose centre is this far outside a compartment still counts as in it [m]."""


@dataclass(frozen=True, slots=True)
class Truth:
    """One box as it is.

    Attributes:
        index: in the delivery's stack.
        gtin: its product.
        cell_from_box: its pose.
        where: a place's id, or "pallet", "hand", "floor", "removed", "elsewhere".
    """

    index: int
    gtin: Gtin
    cell_from_box: Pose
    where: str


@dataclass(frozen=True, slots=True)
class Summary:
    """What happened, in short.

    Attributes:
        boxes: by where they are.
        collisions: in the order in which they began.
        greatest_force: with which a held box pressed on something beyond its weight [N].
        lost: boxes that suction lost.
        astray: boxes on the floor or elsewhere: neither on the pallet nor in the hand nor put away.
        tipped: boxes in places that do not stand on one of their faces.
    """

    boxes: dict[str, int]
    collisions: tuple[Collision, ...]
    greatest_force: float
    lost: tuple[Loss, ...]
    astray: tuple[int, ...]
    tipped: tuple[int, ...]


class Referee:
    """Looks at the world without touching it."""

    def __init__(self, world: World) -> None:
        """The referee of this world."""
        self._world = world
        self._pallet_from_cell = world.layout.pallet.cell_from_pallet.inverse
        self._places = [
            (place, place.cell_from_place.inverse) for place in world.layout.places.values()
        ]
        self._settled = [world.box(case.index).translation for case in world.cases]

    def boxes(self) -> tuple[Truth, ...]:
        """Every box, in the order of the stack."""
        return tuple(self.box(case.index) for case in self._world.cases)

    def box(self, index: int) -> Truth:
        """One box."""
        world = self._world
        return Truth(index, world.cases[index].gtin, world.box(index), self.where(index))

    def product(self, index: int) -> Gtin:
        """What a box is."""
        return self._world.cases[index].gtin

    def where(self, index: int) -> str:
        """Where a box is: a place's id, or "pallet", "hand", "floor", "removed", "elsewhere"."""
        world = self._world
        if index in world.removed:
            return REMOVED
        if index in world.suction.held_boxes:
            return HAND
        pose = world.box(index)
        place = self._place(pose)
        if place is not None:
            return place
        if self._on_pallet(pose):
            return PALLET
        return FLOOR if self._lowest(index, pose) < LYING else ELSEWHERE

    def moved(self) -> float:
        """How far a box on the pallet is at the most from where it settled [m]."""
        ways = [
            float(np.linalg.norm(np.subtract(truth.cell_from_box.translation, settled)))
            for truth, settled in zip(self.boxes(), self._settled, strict=True)
            if truth.where == PALLET
        ]
        return max(ways, default=0.0)

    def summary(self) -> Summary:
        """What happened so far."""
        truths = self.boxes()
        known = {str(place.id) for place, _ in self._places}
        return Summary(
            dict(sorted(Counter(truth.where for truth in truths).items())),
            tuple(self._world.contacts.collisions),
            self._world.contacts.greatest,
            tuple(self._world.losses.lost),
            tuple(truth.index for truth in truths if truth.where in {FLOOR, ELSEWHERE}),
            tuple(truth.index for truth in truths if truth.where in known and _tilted(truth)),
        )

    def _place(self, pose: Pose) -> PlaceId | None:
        for place, place_from_cell in self._places:
            if _inside(place, place_from_cell.apply(pose.translation)):
                return place.id
        return None

    def _on_pallet(self, pose: Pose) -> bool:
        x, y, z = self._pallet_from_cell.apply(pose.translation)
        length, width, _ = self._world.layout.pallet.size
        return -EDGE < x < length + EDGE and -EDGE < y < width + EDGE and z > 0.0

    def _lowest(self, index: int, pose: Pose) -> float:
        half = np.array(self._world.cases[index].shape.size) / 2
        return pose.translation[2] - float(np.abs(np.array(pose.rotation[2])) @ half)


def _inside(place: Place, point: tuple[float, float, float]) -> bool:
    x, y, z = point
    width, height = place.opening
    return -SLACK < x < place.depth and abs(y) < width / 2 and 0.0 < z < height


def _tilted(truth: Truth) -> bool:
    """Whether none of a box's axes is upright within five degrees."""
    upright = np.cos(np.radians(5.0))
    return float(np.abs(np.array(truth.cell_from_box.rotation[2])).max()) < float(upright)
