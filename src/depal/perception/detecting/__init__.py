"""The faces in a raster: proposals of both kinds, one score, no overlap."""

from depal.perception.detecting.expected import Expected
from depal.perception.detecting.finding import Finder, Found, Printed, Weighed
from depal.perception.detecting.implying import Implied, implied_by
from depal.perception.detecting.refuting import Refuted, RefutedFaces

__all__ = [
    "Expected",
    "Finder",
    "Found",
    "Implied",
    "Printed",
    "Refuted",
    "RefutedFaces",
    "Weighed",
    "implied_by",
]
