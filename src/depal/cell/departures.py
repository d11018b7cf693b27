"""What became of each box that left the pallet for good, in order."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import Enum

from depal.domain import Approach, BoxId, Gtin, PlaceId


class Fate(Enum):
    """How a box ended."""

    STORED = "stored"
    SET_ASIDE = "set aside"
    BY_PERSON = "taken by a person"
    LOST = "lost"


@dataclass(frozen=True, slots=True)
class Departure:
    """One box that left the pallet for good.

    Attributes:
        box: its perceived name.
        gtin: its product, None where nobody could tell.
        grasp: how it was held; None where the arm never held it.
        place: where it stands now; None where that is no place of the cell.
        fate: how it ended.
        reason: why it was not stored; empty where it was.
        at: when it left the pallet [s].
    """

    box: BoxId
    gtin: Gtin | None
    grasp: Approach | None
    place: PlaceId | None
    fate: Fate
    reason: str
    at: float


class Departures:
    """The boxes that have left; a box leaves once."""

    def __init__(self) -> None:
        """All boxes are still there."""
        self._left: dict[BoxId, float] = {}
        self._ended: dict[BoxId, Departure] = {}

    def leaves(self, box: BoxId, at: float) -> None:
        """A box has been lifted off the pallet; what becomes of it is said later."""
        self._left.setdefault(box, at)

    def returns(self, box: BoxId) -> None:
        """A box was put back, or fell back onto the pallet."""
        self._left.pop(box, None)

    def ends(self, departure: Departure) -> None:
        """What became of a box is known; the first word on it counts."""
        self._left.setdefault(departure.box, departure.at)
        left = replace(departure, at=self._left[departure.box])
        self._ended.setdefault(departure.box, left)

    def has_left(self, box: BoxId) -> bool:
        """Whether a box is off the pallet."""
        return box in self._left

    def has_ended(self, box: BoxId) -> bool:
        """Whether it is known what became of a box."""
        return box in self._ended

    @property
    def times(self) -> Mapping[BoxId, float]:
        """When each box that is off the pallet left it [s], in that order."""
        return self._left

    @property
    def count(self) -> int:
        """How many boxes are off the pallet."""
        return len(self._left)

    @property
    def sequence(self) -> tuple[Departure, ...]:
        """The boxes whose end is known, in the order in which they left the pallet."""
        order = {box: rank for rank, box in enumerate(self._left)}
        ended = self._ended.values()
        return tuple(sorted(ended, key=lambda departure: order[departure.box]))
