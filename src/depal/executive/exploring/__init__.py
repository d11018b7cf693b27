"""Every state of an allocated task: dead ends, livelocks, broken exclusion, half changes."""

from depal.executive.exploring.explorer import explore
from depal.executive.exploring.result import Exploration, Hazard, HazardKind, TraceStep, Wait
from depal.executive.exploring.together import together

__all__ = ["Exploration", "Hazard", "HazardKind", "TraceStep", "Wait", "explore", "together"]
