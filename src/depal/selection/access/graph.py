"""The AND/OR graph as a graph: each box waits for the blockers of the best of its ways.

So Algorithm 1 works on it as on G, with its scores, fates and reasons. What differs: which boxes
block which, that the boxes to remove for the next request go before all others, and that each
request's removals come with their proven minimum.
"""

from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from depal.domain import Approach, BoxId, Perceived, Request
from depal.selection.access.agenda import Errand, planned
from depal.selection.access.closure import labelled
from depal.selection.access.geometry import BEFORE, OVER, RESTS, Codes
from depal.selection.access.removal import Removal, fewest_removals
from depal.selection.access.ways import Mask, Way, Ways, members
from depal.selection.blocking import Aim
from depal.selection.decision import Refused
from depal.selection.graph import BlockingGraph
from depal.selection.links import Array, Links, link
from depal.selection.relations import Relation
from depal.selection.walks import find_cycle

G = TypeVar("G")

NO_WAY = "the tool has no way to it, whatever leaves before"
"""Why a box without blockers cannot be taken."""


def by_open_ways(
    graph: "AccessGraph", grasp_for: Callable[[Perceived], G | Refused]
) -> Callable[[Perceived], G | Refused]:
    """Asks for a grasp only where a way is open."""

    def grasp(box: Perceived) -> G | Refused:
        return grasp_for(box) if graph.approaches(box.id) else Refused(NO_WAY)

    return grasp


class AccessGraph:
    """Who blocks whom by the ways that are open; for one selection, as it does not change.

    Attributes:
        ways: the AND/OR graph over the slots.
    """

    def __init__(
        self,
        boxes: BlockingGraph,
        ways: Ways,
        codes: Codes,
        *,
        pace: float = 1.0,
        now: float = 0.0,
        sought: Sequence[tuple[Request, Mask]] = (),
    ) -> None:
        """The graph of boxes and the ways to take them.

        Args:
            boxes: what is perceived, in numbered slots.
            ways: over the slots.
            codes: (slots, slots) how boxes stand to each other, see `geometry.standings`.
            pace: how long one box takes [s].
            now: the time [s since the start of the run].
            sought: pending requests, each with the slots to empty first to find what it wants
                (`depal.selection.hidden.sought`); they take their turn among the others.
        """
        self._sought = tuple(sought)
        self._boxes = boxes
        self.ways = ways
        self._pace, self._now = pace, now
        self._removals: dict[int, Removal | None] = {}
        self._links = _linked(len(boxes.by_slot()), ways, codes)

    @property
    def links(self) -> Links:
        """The edges from each box to the blockers of the best of its ways."""
        return self._links

    @property
    def prisms(self) -> Array:
        """(slots, 8), one prism per slot."""
        return self._boxes.prisms

    @property
    def used_slots(self) -> npt.NDArray[np.intp]:
        """The slots that hold a box, rising."""
        return self._boxes.used_slots

    def __len__(self) -> int:
        """How many boxes there are."""
        return len(self._boxes)

    def at(self, slot: int) -> Perceived:
        """The box in a slot."""
        return self._boxes.at(slot)

    def by_slot(self) -> tuple[Perceived | None, ...]:
        """What is in each slot."""
        return self._boxes.by_slot()

    def slot_of(self, box: BoxId) -> int | None:
        """The slot of a box, or None when it is not perceived."""
        return self._boxes.slot_of(box)

    def geometric_rank(self) -> npt.NDArray[np.int64]:
        """(slots,) the order that settles ties."""
        return self._boxes.geometric_rank()

    def cycle(self) -> tuple[BoxId, ...]:
        """One cycle of blockers, each by the best of its ways; or nothing."""
        return tuple(self.at(slot).id for slot in find_cycle(self._links, self.prisms))

    def approaches(self, box: BoxId) -> frozenset[Approach]:
        """From where a box can be taken now."""
        slot = self._boxes.slot_of(box)
        ways = () if slot is None else self.ways.of[slot]
        return frozenset(way.approach for way in ways if not way.blockers)

    def removal(self, slot: int) -> Removal | None:
        """The fewest removals for the box in a slot; None where it can never be taken."""
        if slot not in self._removals:
            self._removals[slot] = fewest_removals(self.ways, 1 << slot)
        return self._removals[slot]

    def removals(self, slot: int) -> tuple[int, int]:
        """How many boxes are to leave before a box, and the proven minimum of them.

        For a box that can never be taken: all the others.
        """
        found = self.removal(slot)
        everything = len(self) - 1
        return (everything, everything) if found is None else (found.actions, found.least)

    def ahead(self, aims: Sequence[Aim]) -> tuple[frozenset[int], ...]:
        """Per request, in the order of service, the boxes that leave for it."""
        errands: list[Errand] = []
        for aim in aims:
            slot = self._boxes.slot_of(aim.box)
            found = None if slot is None else self.removal(slot)
            if found is not None:
                errands.append(Errand(aim.request.priority, found.boxes, _due(aim.request)))
        errands += [
            Errand(request.priority, boxes & self.ways.present, _due(request))
            for request, boxes in self._sought
        ]
        order = planned(errands, self._pace, self._now).order
        return tuple(frozenset(members(errands[number].boxes)) for number in order)


def _due(request: Request) -> float:
    """When a request should be served: without a due time, at once [s]."""
    return request.arrived if request.due is None else request.due


def _linked(slots: int, ways: Ways, codes: Codes) -> Links:
    """Edges from each box to the blockers of its best way; in a ring of waiting, of its first."""
    labels = labelled(ways)
    best: list[Way] = []
    for box in members(ways.present):
        way = labels[box][1] if box in labels else next(iter(ways.of[box]), None)
        if way is not None:
            best.append(way)
    links = Links.empty(slots, max(1, sum(way.blockers.bit_count() for way in best)))
    for box in members(ways.present):
        links.slots[box, 0] = 0
    for way in best:
        for blocker in members(way.blockers):
            link(links, way.box, blocker, int(_relation(int(codes[way.box, blocker]), way)))
    return links


def _relation(code: int, way: Way) -> Relation:
    """How a blocker of a way stands to its box."""
    upper = code & OVER if way.approach is Approach.VERTICAL else code & RESTS
    found = Relation.ON_TOP if upper else Relation(0)
    if way.approach is Approach.HORIZONTAL and code & BEFORE:
        found |= Relation.OCCLUDES
    return found or Relation.CROWDS
