"""People and the store's systems as the controller sees them."""

from dataclasses import dataclass
from typing import Protocol

from depal.domain import BoxId, Gtin, PlaceId
from depal.geometry import Vector3

TAKEN = "taken"
"""The answer that promises: the person has taken the box that it is about out of the cell."""


@dataclass(frozen=True, slots=True)
class Question:
    """Something that only a person can say or do.

    Attributes:
        id: of this question; the same one may be asked again.
        text: what is asked, as a sentence.
        choices: the answers to choose from; the last is the careful one.
        about: the box, the trolley or the place that it is about.
        at: where the middle of that box is, for a picture of it, in the cell frame [m].
        gtin: the product of that box, where it is known.
    """

    id: str
    text: str
    choices: tuple[str, ...]
    about: str
    at: Vector3 | None = None
    gtin: Gtin | None = None


class Person(Protocol):
    """The supervising person."""

    async def ask(self, question: Question) -> str:
        """Asks and waits for as long as it takes; returns one of the choices.

        For an exchange of a trolley the answer comes when the new trolley is locked in its bay.
        """
        ...


@dataclass(frozen=True, slots=True)
class Movement:
    """A case has gone into a place.

    Attributes:
        id: of this movement; told twice, it counts once.
        box: which case.
        gtin: of which product; None where nobody could tell.
        place: where it stands now.
        at: when [s].
    """

    id: str
    box: BoxId
    gtin: Gtin | None
    place: PlaceId
    at: float


class StoreSystem(Protocol):
    """The store's management system."""

    async def places_for(self, gtin: Gtin) -> tuple[PlaceId, ...]:
        """Where a product belongs, best first; empty where the store does not know it.

        Raises:
            DeviceError: no answer came in time.
        """
        ...

    async def moved(self, movement: Movement) -> None:
        """Takes note of a case that was put away."""
        ...
