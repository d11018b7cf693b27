"""The shape of `fiducials` in a cell file: markers that are fixed to the cell."""

from pydantic import BaseModel, Field

from depal.cell.files.quantities import THREE, Degrees, Direction, Length, Pattern, Point
from depal.cell.files.robot_model import three
from depal.cell.files.turns import looking, turned
from depal.domain import Fiducial
from depal.logistics.models import STRICT


class FiducialEntry(BaseModel):
    """A square marker on a plate that does not move."""

    model_config = STRICT

    id: Pattern = Field(description="which of the 50 patterns of ArUco's dictionary 4X4_50")
    size: Length = Field(description="edge of the black square, without its white rim [m]")
    at: Point = Field(description="x, y, z of its middle [m]", json_schema_extra=THREE)
    normal: Direction = Field(
        description="x, y, z of where it faces; [0, 0, 1] lies flat on the floor",
        json_schema_extra=THREE,
    )
    turn: Degrees = Field(
        default=0.0,
        description="clockwise as one looks at it; at 0 its upper edge is up, or to +x where it "
        "lies flat [deg]",
    )

    def as_fiducial(self) -> Fiducial:
        """The marker as the cell's own value; its normal must have a length."""
        (x, y, z), (a, b, c) = three(self.at), three(self.normal)
        upright = looking((x, y, z), (x - a, y - b, z - c))
        return Fiducial(self.id, self.size, upright @ turned((0.0, 0.0, 0.0), yaw=self.turn))
