"""From faces to boxes."""

from depal.perception.assembling.boxes import boxes_of

__all__ = ["boxes_of"]
