"""Beyond the paper: blocking by grasp direction, and the fewest removals, proven."""

from depal.selection.access.agenda import Agenda, Errand, lateness_of, planned
from depal.selection.access.closure import labelled
from depal.selection.access.geometry import (
    BEFORE,
    OVER,
    RESTS,
    crowding,
    free_ways,
    masks,
    standings,
)
from depal.selection.access.graph import NO_WAY, AccessGraph, by_open_ways
from depal.selection.access.program import Limits
from depal.selection.access.removal import Proof, Removal, fewest_removals
from depal.selection.access.ways import Mask, Way, Ways, mask_of, members

__all__ = [
    "BEFORE",
    "NO_WAY",
    "OVER",
    "RESTS",
    "AccessGraph",
    "Agenda",
    "Errand",
    "Limits",
    "Mask",
    "Proof",
    "Removal",
    "Way",
    "Ways",
    "by_open_ways",
    "crowding",
    "fewest_removals",
    "free_ways",
    "labelled",
    "lateness_of",
    "mask_of",
    "masks",
    "members",
    "planned",
    "standings",
]
