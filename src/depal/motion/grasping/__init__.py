"""Ways to hold a box, and what the suction carries."""

from depal.motion.grasping.candidates import grasps, refusal
from depal.motion.grasping.cone import cone_rows, greatest_lean
from depal.motion.grasping.holding import Holding, static_share

__all__ = ["Holding", "cone_rows", "grasps", "greatest_lean", "refusal", "static_share"]
