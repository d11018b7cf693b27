"""The shape of one request in a file of requests."""

import math

from pydantic import BaseModel, Field
from pydantic.config import JsonDict

from depal.domain import BoxId, Gtin, Request
from depal.logistics.models import STRICT
from depal.logistics.quantities import GtinText, Moment, Share, Text

_EITHER: JsonDict = {"oneOf": [{"required": ["gtin"]}, {"required": ["box"]}]}


def _never() -> float:
    return math.inf


class RequestEntry(BaseModel):
    """A product or one perceived box that is wanted: either `gtin` or `box`."""

    model_config = {**STRICT, "json_schema_extra": _EITHER}

    at: Moment = Field(
        default=0.0,
        description="when the request comes, since the start of the run: "
        "95 s, 2 min, 1 h or a number of seconds",
    )
    gtin: GtinText = Field(
        default_factory=str, description="the wanted product's trade item number, in quotes"
    )
    box: Text = Field(default_factory=str, description="the wanted box's name")
    priority: Share = Field(description="importance of the request, a number from 0 to 1")
    due: Moment = Field(
        default_factory=_never,
        description="when the request should be served, since the start of the run: "
        "95 s, 2 min, 1 h or a number of seconds",
    )

    def as_request(self) -> Request:
        """The request as the cell's own value."""
        return Request(
            priority=self.priority,
            gtin=Gtin(self.gtin) if self.gtin else None,
            box=BoxId(self.box) if self.box else None,
            arrived=self.at,
            due=None if math.isinf(self.due) else self.due,
        )
