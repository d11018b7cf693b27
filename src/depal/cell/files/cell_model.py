"""The shape of a cell file: what is in it, of which type, in which unit."""

from typing import Annotated

from pydantic import BaseModel, BeforeValidator, Field

from depal.cell.files.fiducials_model import FiducialEntry
from depal.cell.files.places_model import PlacesEntry
from depal.cell.files.quantities import (
    LISTED,
    THREE,
    TWO,
    Degrees,
    Edges,
    FloorPoint,
    Length,
    Name,
    PictureSize,
    Point,
    Rectangle,
    Speed,
    View,
    Word,
)
from depal.cell.files.robot_model import RobotEntry, three
from depal.cell.files.tool_model import SolidEntry, ToolEntry
from depal.cell.files.turns import looking, radians, turned
from depal.domain import (
    CameraMount,
    CellLayout,
    PalletStand,
    ReaderMount,
    SpeedLimits,
    Zone,
    cell_from_pallet,
)
from depal.geometry import OrientedBox
from depal.logistics.models import STRICT
from depal.logistics.quantities import Text, of_length


class PalletEntry(BaseModel):
    """Where pallets come to stand, their long side to the robot."""

    model_config = STRICT

    size: Edges = Field(
        description="length, width and deck height of the pallets that fit [m]",
        json_schema_extra=THREE,
    )
    front: FloorPoint = Field(
        description="x, y of the middle of the long side that faces the robot [m]",
        json_schema_extra=TWO,
    )
    turn: Degrees = Field(
        default=0.0,
        description="about the vertical through the front's middle; at 0 the front faces -x [deg]",
    )

    def as_stand(self) -> PalletStand:
        """The stand as the cell's own value."""
        size, (x, y) = three(self.size), self.front
        turn = turned((x, y, 0.0), yaw=self.turn)
        return PalletStand(turn @ cell_from_pallet(size, 0.0), size)


class CameraEntry(BaseModel):
    """A camera, upright in the picture; portrait where its pictures are higher than wide."""

    model_config = STRICT

    name: Name = Field(description="of the camera")
    at: Point = Field(description="x, y, z of its lens [m]", json_schema_extra=THREE)
    look_at: Point = Field(
        description="x, y, z of a point in the middle of its picture [m]", json_schema_extra=THREE
    )
    colour_size: PictureSize = Field(
        description="width and height of the colour picture [pixel]", json_schema_extra=TWO
    )
    depth_size: PictureSize = Field(
        description="width and height of the depth picture [pixel]", json_schema_extra=TWO
    )
    vertical_view: View = Field(description="angle from the top to the bottom of the picture [deg]")

    def as_mount(self) -> CameraMount:
        """The camera as the cell's own value."""
        return CameraMount(
            name=self.name,
            cell_from_camera=looking(three(self.at), three(self.look_at)),
            colour_size=(self.colour_size[0], self.colour_size[1]),
            depth_size=(self.depth_size[0], self.depth_size[1]),
            vertical_view=radians(self.vertical_view),
        )


class ReaderEntry(BaseModel):
    """The barcode reader that a held box is shown to."""

    model_config = STRICT

    at: Point = Field(description="x, y, z of its lens [m]", json_schema_extra=THREE)
    look_at: Point = Field(
        description="x, y, z of a point on its line of sight [m]", json_schema_extra=THREE
    )
    distance: Length = Field(description="from the lens to where a label is to be shown [m]")
    field: Rectangle = Field(
        description="width and height of what it sees there [m]", json_schema_extra=TWO
    )
    pixels: PictureSize = Field(
        description="width and height of its picture [pixel]", json_schema_extra=TWO
    )

    def as_mount(self) -> ReaderMount:
        """The reader as the cell's own value."""
        return ReaderMount(
            cell_from_reader=looking(three(self.at), three(self.look_at)),
            distance=self.distance,
            field=(self.field[0], self.field[1]),
            pixels=(self.pixels[0], self.pixels[1]),
        )


class FloorEntry(BaseModel):
    """A rectangle on the ground."""

    model_config = STRICT

    lower: FloorPoint = Field(description="its smallest x, y [m]", json_schema_extra=TWO)
    upper: FloorPoint = Field(description="its greatest x, y [m]", json_schema_extra=TWO)


class SafetyEntry(BaseModel):
    """What keeps people and the arm apart."""

    model_config = STRICT

    floor: FloorEntry = Field(
        description="the floor inside of the fence: no part of the arm or a held box leaves it"
    )


class SpeedsEntry(BaseModel):
    """How fast the arm may be, beside its axes' own limits."""

    model_config = STRICT

    flange: Speed = Field(description="of the flange in free space [m/s]")
    straight: Speed = Field(description="in straight moves near boxes [m/s]")
    set_down: Speed = Field(description="in the last part of setting a box down [m/s]")
    near: Speed = Field(default=0.25, description="of flange and tool while somebody is near [m/s]")


class FixtureEntry(SolidEntry):
    """A further solid thing, such as a mast: a cuboid along the cell's axes, or turned."""

    name: Text = Field(description="what it is")
    turn: Degrees = Field(default=0.0, description="about the vertical [deg]")

    def as_box(self) -> OrientedBox:
        """The cuboid in the cell frame."""
        return OrientedBox(turned(three(self.centre), yaw=self.turn), three(self.size))


class ZoneEntry(SolidEntry):
    """A volume that tasks may avoid: a cuboid along the cell's axes, or turned."""

    name: Word = Field(description="by which task files call it")
    turn: Degrees = Field(default=0.0, description="about the vertical [deg]")

    def as_zone(self) -> Zone:
        """The zone as the cell's own value."""
        return Zone(
            self.name, OrientedBox(turned(three(self.centre), yaw=self.turn), three(self.size))
        )


class CellEntry(BaseModel):
    """A cell: the robot's base at the origin, x to the pallet, y to the left, z up."""

    model_config = STRICT

    name: Text = Field(description="of the cell")
    robot: RobotEntry = Field(description="the arm")
    tool: ToolEntry = Field(description="the gripper")
    pallet: PalletEntry = Field(description="where pallets stand: size, front, turn")
    places: PlacesEntry = Field(description="where boxes go: aside, models, storages")
    camera: Annotated[
        tuple[CameraEntry, ...], LISTED, BeforeValidator(of_length(1, 8, "camera", "cameras"))
    ] = Field(
        description="a list of cameras; at least one sees the pallet's front",
        json_schema_extra={"minItems": 1, "maxItems": 8},
    )
    reader: ReaderEntry = Field(description="the barcode reader")
    safety: SafetyEntry = Field(description="the floor inside of the fence")
    speeds: SpeedsEntry = Field(description="flange, straight, set_down and near [m/s]")
    fixtures: Annotated[tuple[FixtureEntry, ...], LISTED] = Field(
        default=(), description="a list of further solid things: name, centre, size, turn"
    )
    fiducials: Annotated[tuple[FiducialEntry, ...], LISTED] = Field(
        default=(), description="a list of markers: id, size, at, normal, turn"
    )
    zones: Annotated[tuple[ZoneEntry, ...], LISTED] = Field(
        default=(), description="a list of volumes that tasks may avoid: name, centre, size, turn"
    )

    def as_layout(self) -> CellLayout:
        """The cell as the cell's own value; it must not contradict itself."""
        floor = self.safety.floor
        return CellLayout(
            name=self.name,
            floor=((floor.lower[0], floor.lower[1]), (floor.upper[0], floor.upper[1])),
            robot=self.robot.as_robot(),
            tool=self.tool.as_tool(),
            pallet=self.pallet.as_stand(),
            storages=self.places.as_storages(),
            aside=self.places.aside,
            cameras=tuple(camera.as_mount() for camera in self.camera),
            reader=self.reader.as_mount(),
            speeds=SpeedLimits(
                self.speeds.flange, self.speeds.straight, self.speeds.set_down, self.speeds.near
            ),
            fixtures=(
                *(fixture.as_box() for fixture in self.fixtures),
                *self.robot.as_plinth(),
            ),
            fiducials=tuple(fiducial.as_fiducial() for fiducial in self.fiducials),
            zones=tuple(zone.as_zone() for zone in self.zones),
        )
