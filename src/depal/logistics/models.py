"""The shape of a delivery file: what is in it, of which type, in which unit."""

from typing import Annotated

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field
from pydantic.config import JsonDict

from depal.domain import Delivery, DeliveryLine, Gtin, Product, StackedCase
from depal.logistics.quantities import (
    MOST_CASES,
    Coordinate,
    Count,
    GtinText,
    Mass,
    Side,
    Text,
    of_length,
)

STRICT = ConfigDict(strict=True, extra="forbid", frozen=True, allow_inf_nan=False)
"""A number is a number, a key is a known key, and nothing changes afterwards."""

_three = BeforeValidator(of_length(3, 3, "number", "numbers"))
_THREE: JsonDict = {"minItems": 3, "maxItems": 3}
_listed = Field(strict=False)
"""JSON knows lists alone; strictness would ask for a tuple."""

Size = Annotated[tuple[Side, ...], _listed, _three]
Corner = Annotated[tuple[Coordinate, ...], _listed, _three]


class PalletEntry(BaseModel):
    """The pallet that the cases stand on."""

    model_config = STRICT

    size: Size = Field(
        description="length, width and deck height of the pallet [m]", json_schema_extra=_THREE
    )


class LineEntry(BaseModel):
    """One line of the note: how many cases of which product."""

    model_config = STRICT

    gtin: GtinText = Field(
        description="the case's trade item number in quotes, with its check digit"
    )
    name: Text = Field(description="what people call the product")
    size: Size = Field(
        description="length, width and height of a case standing upright [m]",
        json_schema_extra=_THREE,
    )
    mass: Mass = Field(description="mass of one full case [kg], above 0 and at most 1000")
    count: Count = Field(
        description="how many cases of the product came, a whole number from 1 to 10000"
    )

    def as_line(self) -> DeliveryLine:
        """The line as the cell's own value."""
        length, width, height = self.size
        product = Product(Gtin(self.gtin), self.name, (length, width, height), self.mass)
        return DeliveryLine(product, self.count)


class CaseEntry(BaseModel):
    """Where one case really stands."""

    model_config = STRICT

    gtin: GtinText = Field(description="trade item number of a product on the note, in quotes")
    corner: Corner = Field(
        description="x, y, z of the corner with the smallest coordinates, in the pallet's frame: "
        "x along its length, y along its width, z up from the deck [m]",
        json_schema_extra=_THREE,
    )
    size: Size = Field(
        description="edges of the case along x, y, z of the pallet's frame [m]",
        json_schema_extra=_THREE,
    )

    def as_case(self) -> StackedCase:
        """The case as the cell's own value."""
        (x, y, z), (a, b, c) = self.corner, self.size
        return StackedCase(Gtin(self.gtin), (x, y, z), (a, b, c))


class DeliveryEntry(BaseModel):
    """One delivery: the note, the pallet and, for simulation, how the cases stand on it."""

    model_config = STRICT

    id: Text = Field(description="the delivery's name, unique in its file")
    pallet: PalletEntry = Field(description="the pallet that the cases stand on")
    lines: Annotated[
        tuple[LineEntry, ...],
        _listed,
        BeforeValidator(of_length(1, MOST_CASES, "line", "lines")),
    ] = Field(
        description="the note: a list with one line per product",
        json_schema_extra={"minItems": 1, "maxItems": MOST_CASES},
    )
    stack: Annotated[
        tuple[CaseEntry, ...],
        _listed,
        BeforeValidator(of_length(1, MOST_CASES, "case", "cases")),
    ] = Field(
        default_factory=tuple,
        description="a list with every case's place on the pallet, in any order; "
        "left out where only the note is known",
        json_schema_extra={"minItems": 1, "maxItems": MOST_CASES},
    )

    def as_delivery(self) -> Delivery:
        """The delivery as the cell's own value."""
        length, width, deck_height = self.pallet.size
        return Delivery(
            id=self.id,
            pallet_size=(length, width, deck_height),
            lines=tuple(line.as_line() for line in self.lines),
            stack=tuple(case.as_case() for case in self.stack) or None,
        )
