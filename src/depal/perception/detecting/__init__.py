"""The faces in a raster: proposals of both kinds, one score, no overlap."""

from depal.perception.detecting.expected import Expected
from depal.perception.detecting.finding import Finder, Found, Printed
from depal.perception.detecting.refuting import Refuted, RefutedFaces

__all__ = ["Expected", "Finder", "Found", "Printed", "Refuted", "RefutedFaces"]
