"""How the cell sees with its cameras."""

from depal.cell.sight.camera_sight import Book, CameraSight, Eyes

__all__ = ["Book", "CameraSight", "Eyes"]
