"""The shape of `places` in a cell file: models of trolleys and shelves, and where they stand."""

from typing import Annotated

from pydantic import AfterValidator, BaseModel, BeforeValidator, Field, WithJsonSchema

from depal.cell.files.panels import Body, Level, places_of, solid_parts
from depal.cell.files.quantities import (
    LISTED,
    THREE,
    TWO,
    Degrees,
    Edges,
    FloorPoint,
    Height,
    Length,
    Name,
)
from depal.cell.files.robot_model import three
from depal.cell.files.turns import turned
from depal.domain import Storage, StorageKind
from depal.logistics.findings import shown
from depal.logistics.models import STRICT
from depal.logistics.quantities import of_length, refused

_KINDS = [kind.value for kind in StorageKind]


def _kind(value: str) -> str:
    if value not in _KINDS:
        raise refused(f"{shown(value)} is no kind of storage", " or ".join(_KINDS))
    return value


Kind = Annotated[str, AfterValidator(_kind), WithJsonSchema({"enum": [*_KINDS]})]


class LevelEntry(BaseModel):
    """One level: a place that is filled from the front."""

    model_config = STRICT

    floor: Height = Field(description="what boxes stand on, above the ground [m]")
    height: Length = Field(description="clear height above it [m]")


class ModelEntry(BaseModel):
    """A kind of trolley or shelf."""

    model_config = STRICT

    name: Name = Field(description="the model's name")
    kind: Kind = Field(description="trolley, which can be exchanged, or shelf")
    size: Edges = Field(description="width, depth and height over all [m]", json_schema_extra=THREE)
    wall: Length = Field(description="thickness of the sides and the back [m]")
    board: Length = Field(description="thickness of what boxes stand on [m]")
    base: Height = Field(default=0.0, description="height of the wheels and the frame [m]")
    levels: Annotated[
        tuple[LevelEntry, ...], LISTED, BeforeValidator(of_length(1, 20, "level", "levels"))
    ] = Field(
        description="a list of levels, the lowest first",
        json_schema_extra={"minItems": 1, "maxItems": 20},
    )

    def as_body(self) -> Body:
        """Its measures."""
        return Body(
            size=three(self.size),
            wall=self.wall,
            board=self.board,
            base=self.base,
            levels=tuple(Level(level.floor, level.height) for level in self.levels),
        )


class StorageEntry(BaseModel):
    """One trolley's bay, or one shelf."""

    model_config = STRICT

    name: Name = Field(description="its name; places are called name/level_1, from the lowest")
    model: Name = Field(description="the name of one of the models")
    front: FloorPoint = Field(
        description="x, y of the middle of its front [m]", json_schema_extra=TWO
    )
    turn: Degrees = Field(
        description="where one looks who looks into it: 0 along the cell's x, 90 along y [deg]"
    )

    def as_storage(self, model: ModelEntry) -> Storage:
        """The storage as the cell's own value."""
        x, y = self.front
        cell_from_storage = turned((x, y, 0.0), yaw=self.turn)
        body = model.as_body()
        return Storage(
            id=self.name,
            kind=StorageKind(model.kind),
            cell_from_storage=cell_from_storage,
            size=body.size,
            panels=solid_parts(body),
            places=places_of(body, self.name, cell_from_storage),
        )


class PlacesEntry(BaseModel):
    """Where boxes go."""

    model_config = STRICT

    aside: Name = Field(description="the name of the storage that boxes are set aside into")
    models: Annotated[
        tuple[ModelEntry, ...], LISTED, BeforeValidator(of_length(1, 50, "model", "models"))
    ] = Field(
        description="a list of kinds of trolleys and shelves",
        json_schema_extra={"minItems": 1, "maxItems": 50},
    )
    storages: Annotated[
        tuple[StorageEntry, ...], LISTED, BeforeValidator(of_length(1, 100, "storage", "storages"))
    ] = Field(
        description="a list of the trolleys' bays and the shelves",
        json_schema_extra={"minItems": 1, "maxItems": 100},
    )

    def as_storages(self) -> tuple[Storage, ...]:
        """The storages as the cell's own values; every model must exist."""
        models = {model.name: model for model in self.models}
        return tuple(storage.as_storage(models[storage.model]) for storage in self.storages)
