"""The place of a face by its edges, finer than a raster tells."""

from depal.perception.refining.edges import Refined, refined

__all__ = ["Refined", "refined"]
