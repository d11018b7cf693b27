"""Fast conservative collision checks: boxes by separating axes, the arm by spheres on capsules."""

from depal.motion.collision.checker import STEP, Body, Checker, Upright
from depal.motion.collision.checking import Margins
from depal.motion.collision.values import Hand, Scene, fixed_solids, held_box

__all__ = [
    "STEP",
    "Body",
    "Checker",
    "Hand",
    "Margins",
    "Scene",
    "Upright",
    "fixed_solids",
    "held_box",
]
