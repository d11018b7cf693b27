"""Pictures of a run: the cell in three dimensions, still and moving."""

from depal.app.pictures.files import save_animation, save_picture
from depal.app.pictures.painter import CellPainter

__all__ = ["CellPainter", "save_animation", "save_picture"]
