"""Ways to hold a box, and what the suction carries."""

from depal.motion.grasping.bulk import EXACT, resized, swollen
from depal.motion.grasping.candidates import grasps, refusal
from depal.motion.grasping.cone import cone_rows, greatest_lean
from depal.motion.grasping.holding import Holding, in_a_row, static_share

__all__ = [
    "EXACT",
    "Holding",
    "cone_rows",
    "grasps",
    "greatest_lean",
    "in_a_row",
    "refusal",
    "resized",
    "static_share",
    "swollen",
]
