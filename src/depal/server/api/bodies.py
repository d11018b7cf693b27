"""What is sent to the API, checked before anything else sees it."""

from datetime import datetime
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, model_validator

Share = Annotated[float, Field(ge=0.0, le=1.0)]

PHRASE = "four words are enough"

Text = Annotated[str, Field(min_length=1, max_length=200)]


class Body(BaseModel):
    """Nothing beside what is declared is taken, and numbers are numbers."""

    model_config = ConfigDict(extra="forbid", strict=False, allow_inf_nan=False)


class NewRequest(Body):
    """A product or a box that is wanted."""

    gtin: Text | None = Field(None, examples=["12000823098180"])
    box: Text | None = Field(None, examples=["b7"])
    priority: Share = Field(0.5, description="p in [0, 1]")
    due: datetime | None = Field(None, description="RFC 3339, with its time zone")
    due_in: Annotated[float, Field(ge=0.0, le=2592000.0)] | None = Field(
        None, description="seconds from now, instead of due"
    )

    @model_validator(mode="after")
    def _one(self) -> "NewRequest":
        if (self.gtin is None) == (self.box is None):
            raise ValueError("expected either gtin or box")
        _one_due(self.due, self.due_in)
        return self


class ChangedRequest(Body):
    """Another priority, or another due time; what is not named stays as it is."""

    priority: Share | None = Field(None, examples=[0.9])
    due: datetime | None = Field(None, description="RFC 3339; null for no due time any more")
    due_in: Annotated[float, Field(ge=0.0, le=2592000.0)] | None = Field(
        None, description="seconds from now, instead of due"
    )

    @model_validator(mode="after")
    def _one(self) -> "ChangedRequest":
        _one_due(self.due, self.due_in)
        return self

    @property
    def keeps_due(self) -> bool:
        """Whether nothing is said of when it is due."""
        return self.due_in is None and "due" not in self.model_fields_set


def _one_due(due: datetime | None, due_in: float | None) -> None:
    if due is not None and due_in is not None:
        raise ValueError("expected due or due_in, not both")
    if due is not None and due.tzinfo is None:
        raise ValueError("due has no time zone")


class Start(Body):
    """What is to be started."""

    delivery: Text | None = Field(
        None, description="the next in the queue where none is named", examples=["dev-000"]
    )


class Position(Body):
    """Where in the queue."""

    position: Annotated[int, Field(ge=1, le=10000, examples=[1])]


class NewSettings(Body):
    """The settings of the cell."""

    w: Annotated[Share, Field(examples=[0.5])]
    speed: Annotated[float, Field(ge=0.05, le=1.0, examples=[0.8])]
    policy: Annotated[str, Field(pattern="^(paper|access)$", examples=["paper"])]


class NewProduct(Body):
    """What is known of a product."""

    name: Annotated[Text, Field(examples=["biscuits, 12 packets"])]
    size: tuple[float, float, float] = Field(
        description="length, width, height [m]", examples=[[0.365, 0.202, 0.254]]
    )
    mass: Annotated[float, Field(gt=0.0, le=100.0)] = Field(
        description="of a full case [kg]", examples=[5.4]
    )


class Assignment(Body):
    """Where a product belongs, best first."""

    places: Annotated[list[Text], Field(max_length=200, examples=[["trolley_1/level_1"]])]


class Choice(Body):
    """The answer to a question."""

    choice: Annotated[Text, Field(description="one of the question's", examples=["taken"])]


class SignIn(Body):
    """A name and a password."""

    name: Annotated[str, Field(min_length=1, max_length=40, examples=["anna"])]
    password: Annotated[str, Field(min_length=1, max_length=200, examples=[PHRASE])]


class FirstAccount(SignIn):
    """The first account, with the code that the cell has printed."""

    code: Annotated[str, Field(min_length=1, max_length=100)]


class NewPerson(SignIn):
    """A person."""

    role: Annotated[str, Field(pattern="^(viewer|operator|integrator)$", examples=["operator"])]


class NewRole(Body):
    """A role."""

    role: Annotated[str, Field(pattern="^(viewer|operator|integrator)$", examples=["operator"])]


class NewPassword(Body):
    """A password."""

    password: Annotated[str, Field(min_length=1, max_length=200, examples=[PHRASE])]


class NewToken(Body):
    """A token for a service."""

    name: Annotated[str, Field(min_length=1, max_length=60, examples=["the till"])]
    days: Annotated[float, Field(gt=0.0, le=365.0)] = 90.0
