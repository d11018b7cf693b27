"""Recognition by print: where products' pictures appear, and what a face's print says."""

from depal.perception.recognition.believing import believed
from depal.perception.recognition.identity import Identity, Limits, Refinement, identify
from depal.perception.recognition.patches import Patch, patch_of
from depal.perception.recognition.prints import Gallery, Print, gallery_of
from depal.perception.recognition.sightings import Sighting, sightings

__all__ = [
    "Gallery",
    "Identity",
    "Limits",
    "Patch",
    "Print",
    "Refinement",
    "Sighting",
    "believed",
    "gallery_of",
    "identify",
    "patch_of",
    "sightings",
]
