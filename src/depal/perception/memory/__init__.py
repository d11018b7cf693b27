"""What is believed of the boxes after all looks: names, poses, doubts, the note."""

from depal.perception.memory.memory import Memory
from depal.perception.memory.remembered import Remembered
from depal.perception.memory.tally import Surplus, Tally, tally_of

__all__ = ["Memory", "Remembered", "Surplus", "Tally", "tally_of"]
