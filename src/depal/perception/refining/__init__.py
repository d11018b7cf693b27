"""The place of a face by its depths, its print and its edges, finer than a raster tells."""

from depal.perception.refining.belief import Belief, moved
from depal.perception.refining.depths import by_depths
from depal.perception.refining.printed import by_print
from depal.perception.refining.sides import by_sides

__all__ = ["Belief", "by_depths", "by_print", "by_sides", "moved"]
