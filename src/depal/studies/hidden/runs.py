"""A request for a box that nobody has seen, carried out box by box under three policies.

The referee knows the truth: only what is truly free can be taken. After each box there is a look.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.selection.access import Mask, Ways, fewest_removals, free_ways, members
from depal.selection.hidden import believed, sought
from depal.selection.relations import EXACT
from depal.studies.hidden.looking import Looks, true_place
from depal.studies.retrieval.runs import Scores, joined, reached

Array = npt.NDArray[np.float64]

REGION_SHARE = 0.8
"""Of the belief, in the region that is tested against the truth."""


@dataclass(frozen=True, slots=True)
class Hidden:
    """A pallet with a request for a box that the first look does not show.

    Attributes:
        prisms: (n, 8) of all boxes.
        requested: the wanted box.
        scores: of the boxes, and the priority of the request.
        graph: per box those that block it under G.
        ways: how the boxes can truly be taken.
    """

    prisms: Array
    requested: int
    scores: Scores
    graph: Sequence[Mask]
    ways: Ways

    @property
    def size(self) -> tuple[float, float, float]:
        """The size that the note has [m]."""
        length, width, height = (2 * self.prisms[self.requested, 3:6]).tolist()
        return length, width, height

    def seen_ways(self, seen: Mask) -> Ways:
        """How the seen boxes could be taken if there were no others."""
        return free_ways(self.prisms, EXACT, members(seen))


def by_paper(trial: Hidden) -> int | None:
    """The policy `paper`, w = .9: what nobody has seen waits.

    Returns:
        Boxes stored before the requested one; None where it was never free.
    """
    both, looks = joined(trial.graph, trial.ways), Looks.first(trial.prisms)
    for count in range(len(trial.prisms)):
        free = both.free(looks.gone) & looks.seen
        if not free:
            return None
        wanted = 0
        if looks.seen >> trial.requested & 1:
            known = [blockers & looks.seen for blockers in trial.graph]
            wanted = reached(known, trial.requested)
        best = min(members(free), key=lambda box: trial.scores.key(box, wanted))
        if best == trial.requested:
            return count
        looks.remove(best)
        looks.look()
    raise AssertionError


def by_access(trial: Hidden, *, searches: bool) -> int | None:
    """The policy `access`: by h until the box is seen, or towards where it may be.

    Args:
        trial: the pallet and its request.
        searches: whether the belief pulls the search.

    Returns:
        Boxes stored before the requested one; None where it was never free.
    """
    looks = Looks.first(trial.prisms)
    for count in range(len(trial.prisms)):
        free = trial.ways.free(looks.gone) & looks.seen
        if not free:
            return None
        if free >> trial.requested & 1:
            return count
        ahead = _ahead(trial, looks, free, searches=searches)
        best = min(members(free & ahead or free), key=trial.scores.rank.__getitem__)
        looks.remove(best)
        looks.look()
    raise AssertionError


def _ahead(trial: Hidden, looks: Looks, free: Mask, *, searches: bool) -> Mask:
    """The boxes that go before all others."""
    ways = _corrected(trial.seen_ways(looks.seen), free)
    if looks.seen >> trial.requested & 1:
        plan = fewest_removals(ways, 1 << trial.requested)
        return 0 if plan is None else plan.boxes
    if not searches:
        return 0
    search = sought(looks.scene(), trial.size, trial.prisms, ways)
    return 0 if search is None else search.boxes


def _corrected(ways: Ways, free: Mask) -> Ways:
    """The same without ways that look open and are not: the referee has refused them."""
    kept = (way for each in ways.of for way in each if way.blockers or free >> way.box & 1)
    return Ways.among(members(ways.present), kept)


def held_by_region(trial: Hidden) -> tuple[float, float, float]:
    """Whether the region of the belief after the first look holds the box.

    Returns:
        The part of the true place that is in it, in [0, 1]; the region's volume and the hidden
        volume in cells.
    """
    looks = Looks.first(trial.prisms)
    scene = looks.scene()
    belief = believed(scene, trial.size, trial.prisms[list(members(looks.seen))])
    held = belief.region_holding(REGION_SHARE)
    place = true_place(belief.placements, trial.prisms[trial.requested])
    inside = 0.0 if place is None else float(held[place])
    return inside, float(held.sum()), float(len(held))
