"""What the safety inputs mean for the work: only read, judged, told, asked before every start."""

from depal.cell.safety.judging import Judgement, facts_under, heard, judged, speed_under
from depal.cell.safety.starting import CautiousArm
from depal.cell.safety.watching import SafetyWatch

__all__ = [
    "CautiousArm",
    "Judgement",
    "SafetyWatch",
    "facts_under",
    "heard",
    "judged",
    "speed_under",
]
