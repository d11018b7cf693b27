"""Ways to hold a box, and what the suction carries."""

from depal.motion.grasping.candidates import grasps, refusal
from depal.motion.grasping.holding import Holding, static_share

__all__ = ["Holding", "grasps", "refusal", "static_share"]
