"""Orthographic pictures of a pile: what faces the viewer, without perspective."""

from depal.perception.rasters.making import rasters_of
from depal.perception.rasters.region import Region

__all__ = ["Region", "rasters_of"]
