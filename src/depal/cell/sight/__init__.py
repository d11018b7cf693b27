"""How the cell sees with its cameras."""

from depal.cell.sight.camera_sight import CameraSight, Eyes
from depal.cell.sight.learning import extended_by
from depal.cell.sight.unexplained import unexplained

__all__ = ["CameraSight", "Eyes", "extended_by", "unexplained"]
