"""The place of a face by its depths, its print and its edges, finer than a raster tells."""

from depal.perception.refining.belief import Belief, moved
from depal.perception.refining.depths import by_depths
from depal.perception.refining.printed import by_print
from depal.perception.refining.sides import Sides

__all__ = ["Belief", "Sides", "by_depths", "by_print", "moved"]
