"""The balance from examples: w and the weights of h, from recorded orders of unloading.

The paper sets w and the weights of h by hand, and leaves learning them to later work.
"""

from depal.selection.learning.choices import PARTS, Choice, Choices
from depal.selection.learning.estimate import learn
from depal.selection.learning.learned import Estimate, Finding, Learned
from depal.selection.learning.likelihood import probabilities
from depal.selection.learning.orders import (
    Departure,
    Order,
    Steps,
    Unloading,
    draw_departures,
    features_of,
    steps_of,
)

__all__ = [
    "PARTS",
    "Choice",
    "Choices",
    "Departure",
    "Estimate",
    "Finding",
    "Learned",
    "Order",
    "Steps",
    "Unloading",
    "draw_departures",
    "features_of",
    "learn",
    "probabilities",
    "steps_of",
]
