"""Where boxes go inside compartments, and the cell's own map of what stands where."""

from depal.logistics.placing.books import Books
from depal.logistics.placing.filling import Arrival, Filling, arrivals, measure_fill
from depal.logistics.placing.finding import can_stand, find_spots, is_full_for
from depal.logistics.placing.place_map import PlaceMap
from depal.logistics.placing.values import (
    MARGINS,
    Envelope,
    Held,
    Margins,
    Spot,
    Standing,
    envelopes,
)

__all__ = [
    "MARGINS",
    "Arrival",
    "Books",
    "Envelope",
    "Filling",
    "Held",
    "Margins",
    "PlaceMap",
    "Spot",
    "Standing",
    "arrivals",
    "can_stand",
    "envelopes",
    "find_spots",
    "is_full_for",
    "measure_fill",
]
