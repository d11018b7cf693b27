"""Boxes of one look made to agree: their faces, their cameras, and what carries them."""

from depal.perception.settling.draft import Draft, Place
from depal.perception.settling.settled import settled

__all__ = ["Draft", "Place", "settled"]
