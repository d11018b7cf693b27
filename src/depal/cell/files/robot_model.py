"""The shape of `robot` in a cell file."""

from typing import Annotated

from pydantic import BaseModel, BeforeValidator, Field

from depal.cell.files.quantities import (
    LISTED,
    SEVEN,
    SIX,
    THREE,
    AxisSpeed,
    Degrees,
    Height,
    Length,
    Mass,
    Offset,
    Point,
    Seconds,
    SixAngles,
)
from depal.cell.files.turns import radians
from depal.domain import ArmGeometry, Capsule, JointLimits, Joints, Robot
from depal.geometry import OrientedBox
from depal.logistics.models import STRICT
from depal.logistics.quantities import Text, of_length


class GeometryEntry(BaseModel):
    """Measures of an ortho-parallel arm with a spherical wrist."""

    model_config = STRICT

    a1: Offset = Field(description="axis 2 ahead of axis 1 [m]")
    a2: Offset = Field(description="axis 3 below the forearm's line, negative where above [m]")
    b: Offset = Field(default=0.0, description="lateral offset of the forearm [m]")
    c1: Length = Field(description="height of axis 2 above the base [m]")
    c2: Length = Field(description="length of the upper arm, from axis 2 to axis 3 [m]")
    c3: Length = Field(description="length of the forearm, to the wrist's centre [m]")
    c4: Length = Field(description="from the wrist's centre to the flange [m]")

    def as_geometry(self, plinth: float) -> ArmGeometry:
        """The measures as the cell's own value, whose origin is on the floor."""
        return ArmGeometry(self.a1, self.a2, self.b, self.c1 + plinth, self.c2, self.c3, self.c4)


class AxisEntry(BaseModel):
    """What one axis can do."""

    model_config = STRICT

    lower: Degrees = Field(description="smallest angle [deg]")
    upper: Degrees = Field(description="greatest angle [deg]")
    speed: AxisSpeed = Field(description="greatest speed [deg/s]")
    full_speed_in: Seconds = Field(description="how long it takes to its full speed [s]")


class CapsuleEntry(BaseModel):
    """A collision shape: a segment with a radius."""

    model_config = STRICT

    start: Point = Field(
        description="x, y, z of one end in the link's frame [m]", json_schema_extra=THREE
    )
    end: Point = Field(description="x, y, z of the other end [m]", json_schema_extra=THREE)
    radius: Length = Field(description="around the segment [m]")


class LinkEntry(BaseModel):
    """One body of the arm."""

    model_config = STRICT

    mass: Mass = Field(description="of the link [kg]")
    shapes: Annotated[tuple[CapsuleEntry, ...], LISTED] = Field(
        default=(), description="a list of what can collide: segments with a radius"
    )


class RobotEntry(BaseModel):
    """The arm."""

    model_config = STRICT

    name: Text = Field(description="the arm's type")
    geometry: GeometryEntry = Field(description="the arm's measures: a1, a2, b, c1, c2, c3, c4")
    axes: Annotated[
        tuple[AxisEntry, ...], LISTED, BeforeValidator(of_length(6, 6, "axis", "axes"))
    ] = Field(description="limits of the six axes, from the base", json_schema_extra=SIX)
    plinth: Height = Field(
        default=0.0, description="how high above the floor the arm is mounted, on a block [m]"
    )
    payload: Mass = Field(description="what the flange may carry, tool included [kg]")
    parked: SixAngles = Field(
        description="the six angles of the arm when idle, out of the camera's view [deg]",
        json_schema_extra=SIX,
    )
    links: Annotated[
        tuple[LinkEntry, ...], LISTED, BeforeValidator(of_length(7, 7, "link", "links"))
    ] = Field(
        description="the seven bodies of the arm, the base first, then one for each axis",
        json_schema_extra=SEVEN,
    )

    def as_robot(self) -> Robot:
        """The arm as the cell's own value."""
        speeds = [radians(axis.speed) for axis in self.axes]
        times = [axis.full_speed_in for axis in self.axes]
        limits = JointLimits(
            lower=_six([radians(axis.lower) for axis in self.axes]),
            upper=_six([radians(axis.upper) for axis in self.axes]),
            speed=_six(speeds),
            acceleration=_six([v / t for v, t in zip(speeds, times, strict=True)]),
        )
        return Robot(
            name=self.name,
            geometry=self.geometry.as_geometry(self.plinth),
            limits=limits,
            payload=self.payload,
            link_masses=tuple(link.mass for link in self.links),
            shapes=tuple(
                Capsule(
                    number,
                    self._raised(number, shape.start),
                    self._raised(number, shape.end),
                    shape.radius,
                )
                for number, link in enumerate(self.links)
                for shape in link.shapes
            ),
            parked=_six([radians(angle) for angle in self.parked]),
        )

    def as_plinth(self) -> tuple[OrientedBox, ...]:
        """The block below the base, as long and as wide as the base; none where there is none."""
        shapes = self.links[0].shapes
        if not self.plinth or not shapes:
            return ()
        ends = [(end, shape.radius) for shape in shapes for end in (shape.start, shape.end)]
        low = [min(end[axis] - radius for end, radius in ends) for axis in range(2)]
        high = [max(end[axis] + radius for end, radius in ends) for axis in range(2)]
        size = (high[0] - low[0], high[1] - low[1], self.plinth)
        return (OrientedBox.from_corner((low[0], low[1], 0.0), size),)

    def _raised(self, link: int, point: tuple[float, ...]) -> tuple[float, float, float]:
        """A point of a link; the frames of base and axis 1 have their origin on the floor."""
        x, y, z = three(point)
        return (x, y, z + self.plinth) if link <= 1 else (x, y, z)


def _six(values: list[float]) -> Joints:
    return (values[0], values[1], values[2], values[3], values[4], values[5])


def three(values: tuple[float, ...]) -> tuple[float, float, float]:
    """A checked list of three numbers as what it is."""
    return (values[0], values[1], values[2])
