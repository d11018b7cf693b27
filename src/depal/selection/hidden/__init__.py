"""Boxes that nobody has seen: where they may be, and what to remove to find them."""

from depal.selection.hidden.belief import FEATURES, Belief, believed, features, softmax
from depal.selection.hidden.placing import SHARE, Placements, Scene, placements, window_of
from depal.selection.hidden.searching import Search, best_set, needed, sought
from depal.selection.hidden.volume import (
    NOBODY,
    STEP,
    Region,
    View,
    owners_of,
    shares_seen,
)

__all__ = [
    "FEATURES",
    "NOBODY",
    "SHARE",
    "STEP",
    "Belief",
    "Placements",
    "Region",
    "Scene",
    "Search",
    "View",
    "believed",
    "best_set",
    "features",
    "needed",
    "owners_of",
    "placements",
    "shares_seen",
    "softmax",
    "sought",
    "window_of",
]
