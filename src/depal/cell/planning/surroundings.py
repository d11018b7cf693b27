"""What the arm must not touch, as the cell believes: the scene for the planner."""

from collections.abc import Callable, Iterable
from collections.abc import Set as AbstractSet

import numpy as np

from depal.cell.pile import Pile
from depal.domain import BoxId, CellLayout, Perceived, PlaceId, Zone
from depal.geometry import OrientedBox, Pose
from depal.logistics.placing import Spot
from depal.motion.collision import Scene, fixed_solids

SEAM = 0.01
"""A column below a box is this much smaller than the box, for poses are not exact [m]."""

STRANGE = "something before the camera"
"""What a look shows and no box explains is called so."""

EVERYWHERE = 100.0
"""An edge of the zone that a cell does not have: everything is in it [m]."""

THIN = 0.05
"""Lower columns are not worth a solid [m]."""

ShapeOf = Callable[[Perceived], OrientedBox]
"""The room that is kept clear for a box of the pile."""


def as_it_looks(box: Perceived) -> OrientedBox:
    """The box itself."""
    return box.shape


class Surroundings:
    """The cell's own solids, the pile, and what was put away; kept up to date by its owner."""

    def __init__(self, layout: CellLayout) -> None:
        """Nothing stands in any place yet."""
        self._fixed = fixed_solids(layout)
        self._deck = layout.pallet.cell_from_pallet.translation[2]
        self._zones = {zone.name: zone for zone in layout.zones}
        self._placed: dict[BoxId, tuple[PlaceId, OrientedBox]] = {}

    def put(self, box: BoxId, place: PlaceId, solid: OrientedBox) -> None:
        """A box stands, or will stand, in a place."""
        self._placed[box] = (place, solid)

    def take(self, box: BoxId) -> OrientedBox | None:
        """A box does not stand in a place any more."""
        entry = self._placed.pop(box, None)
        return None if entry is None else entry[1]

    def where(self, box: BoxId) -> OrientedBox | None:
        """A box that was put away, in the cell frame."""
        entry = self._placed.get(box)
        return None if entry is None else entry[1]

    def empty(self, places: Iterable[PlaceId]) -> None:
        """Places are empty again."""
        gone = set(places)
        self._placed = {box: entry for box, entry in self._placed.items() if entry[0] not in gone}

    def scene(
        self,
        pile: Pile,
        without: BoxId | None = None,
        zones: AbstractSet[str] = frozenset(),
        shape_of: ShapeOf = as_it_looks,
    ) -> Scene:
        """Everything that stands around, with the zones that are avoided.

        A zone that the cell does not have might be anywhere: nothing moves.

        Args:
            pile: on the pallet.
            without: a box that is left out.
            zones: that are avoided.
            shape_of: the room that is kept clear for each box of the pile.
        """
        cases = [(str(box.id), shape_of(box)) for box in pile.boxes if box.id != without]
        cases += [
            (f"what is under {box.id}", column)
            for box in pile.boxes
            if (column := self._column(box.shape)) is not None
        ]
        cases += [
            (f"what was under {box}", column)
            for box, shape in pile.bared.items()
            if (column := self._column(shape)) is not None
        ]
        cases += [(f"{STRANGE} {k}", solid) for k, solid in enumerate(pile.obstacles)]
        cases += [
            (f"what is under {STRANGE} {k}", column)
            for k, solid in enumerate(pile.obstacles)
            if (column := self._column(solid)) is not None
        ]
        cases += [(str(box), solid) for box, (_, solid) in self._placed.items() if box != without]
        return Scene.of(self._fixed, cases).with_zones([self._zone(name) for name in sorted(zones)])

    def _zone(self, name: str) -> Zone:
        size = (EVERYWHERE, EVERYWHERE, EVERYWHERE)
        unknown = Zone(f"{name}, which the cell does not have", OrientedBox(Pose(), size))
        return self._zones.get(name, unknown)

    def _column(self, box: OrientedBox) -> OrientedBox | None:
        """What carries a box, seen or not: everything below it down to the deck."""
        half = float(np.abs(np.array(box.pose.rotation))[2] @ np.array(box.size)) / 2
        x, y, z = box.centre
        low = z - half - SEAM
        if low - self._deck < THIN:
            return None
        middle = (x, y, (low + self._deck) / 2)
        width, depth = box.size[0] - 2 * SEAM, box.size[1] - 2 * SEAM
        return OrientedBox(Pose(middle, box.pose.rotation), (width, depth, low - self._deck))


def target_of(cell_from_place: Pose, spot: Spot, turn: Pose) -> Pose:
    """`cell_from_box` of a box at a spot, turned as it is held.

    Args:
        cell_from_place: of the place.
        spot: where.
        turn: `place_from_box` as far as it turns.
    """
    return cell_from_place @ Pose(spot.place_from_box.translation, turn.rotation)
