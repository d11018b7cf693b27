"""The shape of one line of a file of orders: a pallet, what was wanted, and who left when."""

from typing import Annotated

from pydantic import AfterValidator, BaseModel, BeforeValidator, Field
from pydantic.config import JsonDict

from depal.domain import BoxId, Detection, Gtin, Perceived, Recognition
from depal.geometry import OrientedBox
from depal.logistics.models import STRICT, Corner, Size
from depal.logistics.quantities import GtinText, Moment, Text, of_length, refused
from depal.logistics.request_model import RequestEntry
from depal.selection import PERCEIVED, Tolerances
from depal.selection.learning import Departure, Order

MOST = 1_000
"""No pallet has more boxes, and none more requests."""

LARGEST = 0.1
"""Places that are less certain say nothing of what blocks what [m]."""

_THREE: JsonDict = {"minItems": 3, "maxItems": 3}
_listed = Field(strict=False)


def _small(value: float) -> float:
    if not 0 <= value <= LARGEST:
        raise refused(f"{value:g} is not between 0 and {LARGEST:g} m")
    return value


Tolerance = Annotated[float, AfterValidator(_small)]


class BoxEntry(BaseModel):
    """One box as it stood before anything left."""

    model_config = STRICT

    box: Text = Field(description="the box's name, in quotes")
    centre: Corner = Field(
        description="x, y, z of the centre [m]: from the robot or the person forward, to the "
        "left of the pallet's middle, up",
        json_schema_extra=_THREE,
    )
    size: Size = Field(
        description="length, width and height along the box's own axes [m]",
        json_schema_extra=_THREE,
    )
    yaw: float = Field(default=0.0, description="by which the box is turned about z [rad]")
    gtin: GtinText = Field(default_factory=str, description="the product's number, in quotes")

    def as_perceived(self) -> Perceived:
        """The box as the selection knows it."""
        x, y, z = self.centre
        a, b, c = self.size
        shape = OrientedBox.upright((x, y, z), (a, b, c), self.yaw)
        if self.gtin:
            return Recognition(BoxId(self.box), shape, Gtin(self.gtin))
        return Detection(BoxId(self.box), shape)


Boxes = Annotated[
    tuple[BoxEntry, ...], _listed, BeforeValidator(of_length(1, MOST, "box", "boxes"))
]
Requests = Annotated[
    tuple[RequestEntry, ...], _listed, BeforeValidator(of_length(0, MOST, "request", "requests"))
]
Names = Annotated[tuple[Text, ...], _listed, BeforeValidator(of_length(1, MOST, "box", "boxes"))]
Times = Annotated[tuple[Moment, ...], _listed, BeforeValidator(of_length(0, MOST, "time", "times"))]


class OrderEntry(BaseModel):
    """One pallet and the order in which its boxes left."""

    model_config = STRICT

    pallet: Text = Field(description="the pallet's name, in quotes")
    boxes: Boxes = Field(description="all boxes that stood on it")
    requests: Requests = Field(default=(), description="what was wanted, as in a requests file")
    order: Names = Field(description="the names of the boxes that left, the first one first")
    tolerance: Tolerance = Field(
        default=PERCEIVED.overlap,
        description="how wrong the places may be [m], from 0 to 0.1",
    )
    times: Times = Field(
        default=(),
        description="when each of them left, since the start; needed for requests that came later",
    )

    def as_order(self) -> Order:
        """The order as the selection's own value.

        x_max is the farthest centre: a constant in every score, it decides nothing.
        """
        boxes = tuple(entry.as_perceived() for entry in self.boxes)
        times = self.times or (0.0,) * len(self.order)
        return Order(
            pallet=self.pallet,
            boxes=boxes,
            requests=tuple(entry.as_request() for entry in self.requests),
            departures=tuple(
                Departure(BoxId(name), at) for name, at in zip(self.order, times, strict=True)
            ),
            x_max=max(box.shape.centre[0] for box in boxes),
            tolerances=Tolerances(self.tolerance, 2 * self.tolerance),
        )
