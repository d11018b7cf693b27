"""How firmly a pile stands: contact patches, forces, margins in g, and a guard for selections."""

from depal.selection.stability.certificate import EDGE, Certificate, Direction, Proof
from depal.selection.stability.doubt import CAMERA, SURE, Doubt, weigh
from depal.selection.stability.guard import THRESHOLD, Guarded, PassedOver, guard
from depal.selection.stability.patches import KNOWN, SEEN, TouchRule
from depal.selection.stability.pile import DIRECTIONS, Friction, StandingPile
from depal.selection.stability.program import LEAST
from depal.selection.stability.watch import Watch

__all__ = [
    "CAMERA",
    "DIRECTIONS",
    "EDGE",
    "KNOWN",
    "LEAST",
    "SEEN",
    "SURE",
    "THRESHOLD",
    "Certificate",
    "Direction",
    "Doubt",
    "Friction",
    "Guarded",
    "PassedOver",
    "Proof",
    "StandingPile",
    "TouchRule",
    "Watch",
    "guard",
    "weigh",
]
