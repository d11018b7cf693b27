"""Orthographic pictures of a pile: what faces the viewer, without perspective."""

from depal.perception.rasters.making import rasters_of
from depal.perception.rasters.region import Region
from depal.perception.rasters.taken import Taken, filled

__all__ = ["Region", "Taken", "filled", "rasters_of"]
