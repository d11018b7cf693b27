"""The shape of one fault in a file of faults."""

from typing import Annotated

from pydantic import BaseModel, Field, WithJsonSchema
from pydantic.functional_validators import AfterValidator

from depal.logistics.models import STRICT
from depal.logistics.quantities import Moment, Share, refused
from depal.simulation.faults.catalogue import CATALOGUE, Phase
from depal.simulation.faults.plan import Fault, When


def _whole(value: int) -> int:
    if value < 0:
        raise refused(f"{value} is below 0")
    return value


def _from_one(value: int) -> int:
    if value < 1:
        raise refused(f"{value} is below 1")
    return value


Index = Annotated[int, AfterValidator(_whole), WithJsonSchema({"type": "integer", "minimum": 0})]
"""A number of a box or a step, from 0."""

Ordinal = Annotated[
    int, AfterValidator(_from_one), WithJsonSchema({"type": "integer", "minimum": 1})
]
"""The number of a chance, from 1."""

Name = Annotated[str, WithJsonSchema({"enum": list(CATALOGUE)})]
PhaseName = Annotated[str, WithJsonSchema({"enum": [phase.value for phase in Phase]})]

NONE = -1
"""Stands for a number that the file does not name."""


def _none() -> int:
    return NONE


class WhenEntry(BaseModel):
    """All that must hold at a chance for the fault; nothing for its first chance."""

    model_config = STRICT

    box: Index = Field(
        default_factory=_none,
        description="the box in the hand or under the cups, by its index in the stack, from 0",
    )
    step: Index = Field(
        default_factory=_none, description="how many boxes the arm has lifted before, from 0"
    )
    time: Moment = Field(
        default=0.0, description="not before this time of the run: 95 s, 2 min or a number"
    )
    p: Share = Field(
        default_factory=_none, description="the probability at each chance, a number from 0 to 1"
    )
    phase: PhaseName = Field(default_factory=str, description="what the cell is doing, in a word")
    nth: Ordinal = Field(
        default=1, description="at the so-manieth chance at which all the rest holds, from 1"
    )


class FaultEntry(BaseModel):
    """A fault, when it strikes, and how long it lasts."""

    model_config = STRICT

    fault: Name = Field(description="the fault's id in the catalogue, such as G3")
    when: WhenEntry = Field(
        default_factory=WhenEntry, description="an object with box, step, time, p and phase"
    )
    duration: Moment = Field(
        default_factory=_none, description="how long it lasts: 3 s, 2 min or a number of seconds"
    )

    def as_fault(self) -> Fault:
        """The fault as the simulator's own value."""
        when = self.when
        return Fault(
            self.fault,
            When(
                None if when.box == NONE else when.box,
                None if when.step == NONE else when.step,
                when.time,
                None if when.p == NONE else when.p,
                Phase(when.phase) if when.phase else None,
                when.nth,
            ),
            None if self.duration == NONE else self.duration,
        )
