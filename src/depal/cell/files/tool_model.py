"""The shape of `tool` in a cell file."""

from typing import Annotated

from pydantic import BaseModel, Field

from depal.cell.files.quantities import (
    LISTED,
    THREE,
    TWO,
    Cups,
    Degrees,
    Edges,
    Factor,
    Friction,
    Length,
    Mass,
    Point,
    Pressure,
    Rectangle,
    Seconds,
    Stiffness,
)
from depal.cell.files.robot_model import three
from depal.cell.files.turns import turned
from depal.domain import FRONT, LOWER, Suction, SuctionModule, Tool
from depal.geometry import OrientedBox, Pose
from depal.logistics.models import STRICT


class FaceEntry(BaseModel):
    """Where the cups of a module touch."""

    model_config = STRICT

    at: Point = Field(
        description="the middle of the plane of touch, in the flange's frame [m]",
        json_schema_extra=THREE,
    )
    roll: Degrees = Field(default=0.0, description="turn about the flange's x, first [deg]")
    pitch: Degrees = Field(default=0.0, description="turn about the flange's y, second [deg]")
    yaw: Degrees = Field(default=0.0, description="turn about the flange's z, last [deg]")

    def as_pose(self) -> Pose:
        """The face's frame, seen from the flange: x out of the face."""
        return turned(three(self.at), roll=self.roll, pitch=self.pitch, yaw=self.yaw)


class CupsEntry(BaseModel):
    """Cups in a grid around the middle of the face."""

    model_config = STRICT

    along_y: Cups = Field(description="how many cups along the face's y")
    along_z: Cups = Field(description="how many cups along the face's z")
    pitch: Length = Field(description="from cup to cup [m]")

    def as_centres(self) -> tuple[tuple[float, float], ...]:
        """The centres in the face's y and z, row by row from the smallest [m]."""
        return tuple(
            (_offset(j, self.along_y) * self.pitch, _offset(k, self.along_z) * self.pitch)
            for k in range(self.along_z)
            for j in range(self.along_y)
        )


class FrontEntry(BaseModel):
    """A module of suction cups."""

    model_config = STRICT

    face: FaceEntry = Field(description="where its cups touch: x out of the face")
    size: Rectangle = Field(
        description="extent along the face's y and z [m]", json_schema_extra=TWO
    )
    cups: CupsEntry = Field(description="its cups: along_y, along_z, pitch")

    def as_module(self, name: str, face: FaceEntry) -> SuctionModule:
        """The module with the given face as the cell's own value."""
        return SuctionModule(
            name, face.as_pose(), (self.size[0], self.size[1]), self.cups.as_centres()
        )


class LowerEntry(FrontEntry):
    """The module that faces down and can be hinged up."""

    folded_face: FaceEntry = Field(description="where its cups touch when it is hinged up")


class SuctionEntry(BaseModel):
    """What a cup does."""

    model_config = STRICT

    cup_diameter: Length = Field(description="of one cup [m]")
    vacuum: Pressure = Field(description="below the pressure around, on cardboard [Pa]")
    friction: Friction = Field(description="of a cup on cardboard")
    stroke: Length = Field(description="how far a bellows reaches beyond the plane of touch [m]")
    stiffness: Stiffness = Field(description="of one cup along its axis [N/m]")
    rise: Seconds = Field(description="until the vacuum stands [s]")
    vent: Seconds = Field(description="until a box is let go [s]")

    def as_suction(self) -> Suction:
        """The cup as the cell's own value."""
        return Suction(
            cup_radius=self.cup_diameter / 2,
            vacuum=self.vacuum,
            friction=self.friction,
            stroke=self.stroke,
            stiffness=self.stiffness,
            rise=self.rise,
            vent=self.vent,
        )


class SolidEntry(BaseModel):
    """A solid cuboid along the axes of its frame."""

    model_config = STRICT

    centre: Point = Field(description="x, y, z of its middle [m]", json_schema_extra=THREE)
    size: Edges = Field(description="edges along x, y, z [m]", json_schema_extra=THREE)

    def as_box(self) -> OrientedBox:
        """The cuboid as the cell's own value."""
        return OrientedBox(Pose(three(self.centre)), three(self.size))


class ToolEntry(BaseModel):
    """The gripper; its frame is the flange's: x out of it, z up when all axes are at zero."""

    model_config = STRICT

    mass: Mass = Field(description="of the tool [kg]")
    centre_of_mass: Point = Field(
        description="x, y, z from the flange [m]", json_schema_extra=THREE
    )
    safety: Factor = Field(description="plans count on the holding force divided by this")
    fold_time: Seconds = Field(description="how long the hinge takes [s]")
    suction: SuctionEntry = Field(description="what one cup does")
    front: FrontEntry = Field(description="the module that faces forward")
    lower: LowerEntry = Field(description="the module that faces down and can be hinged up")
    solids: Annotated[tuple[SolidEntry, ...], LISTED] = Field(
        description="a list of the solid parts that never move"
    )
    unfolded_solids: Annotated[tuple[SolidEntry, ...], LISTED] = Field(
        default=(), description="a list of the further solid parts with the lower module down"
    )
    folded_solids: Annotated[tuple[SolidEntry, ...], LISTED] = Field(
        default=(), description="a list of the further solid parts with the lower module up"
    )

    def as_tool(self) -> Tool:
        """The gripper as the cell's own value."""
        fixed, unfolded, folded = (
            tuple(solid.as_box() for solid in solids)
            for solids in (self.solids, self.unfolded_solids, self.folded_solids)
        )
        return Tool(
            mass=self.mass,
            centre_of_mass=three(self.centre_of_mass),
            suction=self.suction.as_suction(),
            modules=(
                self.front.as_module(FRONT, self.front.face),
                self.lower.as_module(LOWER, self.lower.face),
            ),
            folded_lower=self.lower.as_module(LOWER, self.lower.folded_face),
            shapes=fixed + unfolded,
            folded_shapes=fixed + folded,
            safety=self.safety,
            fold_time=self.fold_time,
        )


def _offset(index: int, count: int) -> float:
    return index - (count - 1) / 2
