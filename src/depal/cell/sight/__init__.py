"""How the cell sees with its cameras."""

from depal.cell.sight.camera_sight import CameraSight, Eyes
from depal.cell.sight.unexplained import unexplained

__all__ = ["CameraSight", "Eyes", "unexplained"]
