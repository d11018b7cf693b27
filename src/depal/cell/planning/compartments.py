"""Compartments that hold what the cell has not put there, as their range sensors say (T2)."""

from collections.abc import Collection, Sequence

import numpy as np

from depal.cell.planning.promises import Promises
from depal.cell.workplace import Workplace
from depal.domain import BoxId, PlaceId
from depal.logistics.placing import PlaceMap

SLACK = 0.05
"""A box may stand that much nearer to the opening than the books say [m]."""


def stranger_in(
    booked: PlaceMap, profile: Sequence[float], promised: Collection[BoxId] = ()
) -> float | None:
    """How far in the nearest thing stands that the books do not know [m]; None where none does.

    What stands behind a booked box, as seen from the opening, is not seen.

    Args:
        booked: what stands in the compartment, as the cell believes.
        profile: how far in it is free in each of the strips of equal width that the range sensor
            tells apart, from the smallest y to the greatest [m].
        promised: boxes of the books that are not there yet.
    """
    width, _ = booked.place.opening
    edges = np.linspace(-width / 2, width / 2, len(profile) + 1)
    strip = width / len(profile)
    expected = np.full(len(profile), booked.place.depth)
    for box in booked.boxes:
        if box.id not in promised:
            # A box that stands a little to the side reaches into the next strip.
            right, left = box.corner[1] - strip, box.corner[1] + box.size[1] + strip
            behind = (edges[1:] > right) & (edges[:-1] < left)
            expected[behind] = np.minimum(expected[behind], box.corner[0])
    found = np.array(profile)
    strange = found < expected - SLACK
    return float(found[strange].min()) if strange.any() else None


class Compartments:
    """Reads the range sensors before something is put into a place.

    Attributes:
        blocked: places with something in them that the cell has not put there, and since when
            that is known [s]; as it was at the last look into each.
    """

    def __init__(self, work: Workplace, promises: Promises) -> None:
        """Nobody has looked yet."""
        self._work = work
        self._promises = promises
        self.blocked: dict[PlaceId, float] = {}

    async def as_booked(self, place: PlaceId) -> bool:
        """Looks into a place; whether nothing stands in it but what the books know."""
        profile = await self._work.ports.bays.profile(place)
        booked, promised = self._promises.books.at(place), self._promises.promised
        found = stranger_in(booked, profile, promised)
        was = place in self.blocked
        if found is None:
            self.blocked.pop(place, None)
        else:
            self.blocked.setdefault(place, self._work.now)
        if was != (found is not None):
            self._tell(place)
        return found is None

    async def look_again(self) -> None:
        """Looks into the places that are blocked: somebody may have cleared them."""
        for place in tuple(self.blocked):
            await self.as_booked(place)

    def _tell(self, place: PlaceId) -> None:
        storage = self._work.layout.storage(place).id
        strange = [each for each in self.blocked if self._work.layout.storage(each).id == storage]
        said = ", ".join(strange)
        self._work.tell([(f"{storage}.blocked", said or None)], "cell")
