"""Where one face may end and the next begin: lines in colour and in depth."""

from depal.perception.seams.directions import directions_of
from depal.perception.seams.evidence import Seams, seams_along, seams_of

__all__ = ["Seams", "directions_of", "seams_along", "seams_of"]
