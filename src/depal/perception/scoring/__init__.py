"""How likely a rectangle is a face of one box."""

from depal.perception.scoring.features import NAMES, described
from depal.perception.scoring.model import FaceScore, shipped_score
from depal.perception.scoring.parts import doubts

__all__ = ["NAMES", "FaceScore", "described", "doubts", "shipped_score"]
