"""What the cell believes stands on the pallet: the last look, and what a look may have missed."""

from dataclasses import replace

from depal.domain import BoxId, Gtin, PalletStand, Perceived, Recognition
from depal.ports import View

MISSED = 3
"""So many looks in a row may miss a box before it is believed to be gone."""


def above_deck(view: View, stand: PalletStand) -> View:
    """The view with boxes that seem to be sunk into the pallet's deck lifted onto it.

    A picture is a few millimetres off; a box that stands in wood could not be taken.
    """
    deck = stand.cell_from_pallet.translation[2]
    return replace(view, boxes=tuple(_lifted(box, deck) for box in view.boxes))


def _lifted(box: Perceived, deck: float) -> Perceived:
    sunk = deck - float(box.shape.corners[:, 2].min())
    if sunk <= 0.0:
        return box
    x, y, z = box.shape.centre
    pose = replace(box.shape.pose, translation=(x, y, z + sunk))
    return replace(box, shape=replace(box.shape, pose=pose))


class Pile:
    """The boxes on the pallet, kept from look to look.

    A box that a look does not show may be hidden by the arm or by others; it is remembered where
    it was. A box that was taken does not come back by itself.
    """

    def __init__(self) -> None:
        """Nothing was seen yet."""
        self._boxes: dict[BoxId, Perceived] = {}
        self._missed: dict[BoxId, int] = {}
        self._taken: set[BoxId] = set()
        self._read: dict[BoxId, Gtin] = {}

    def see(self, view: View) -> None:
        """Takes over what a look has found."""
        found = {box.id: box for box in view.boxes if box.id not in self._taken}
        for name in list(self._boxes):
            if name in found:
                self._missed[name] = 0
                continue
            self._missed[name] = self._missed.get(name, 0) + 1
            if self._missed[name] >= MISSED:
                del self._boxes[name]
        self._boxes.update(found)

    def take(self, box: BoxId) -> None:
        """A box was lifted off."""
        self._taken.add(box)
        self._boxes.pop(box, None)

    def put_back(self, box: Perceived) -> None:
        """A box stands on the pallet again; the next look says where."""
        self._taken.discard(box.id)
        self._boxes[box.id] = box

    def identify(self, box: BoxId, gtin: Gtin) -> None:
        """A box that was only detected has been read: from now on it is recognised."""
        self._read[box] = gtin

    @property
    def boxes(self) -> tuple[Perceived, ...]:
        """What stands there, by name."""
        return tuple(self._known(self._boxes[name]) for name in sorted(self._boxes))

    def get(self, box: BoxId) -> Perceived | None:
        """A box by its name."""
        found = self._boxes.get(box)
        return None if found is None else self._known(found)

    def __len__(self) -> int:
        """How many boxes stand there."""
        return len(self._boxes)

    def _known(self, box: Perceived) -> Perceived:
        gtin = self._read.get(box.id)
        if gtin is None:
            return box
        if isinstance(box, Recognition):
            return replace(box, gtin=gtin)
        return Recognition(box.id, box.shape, gtin)
