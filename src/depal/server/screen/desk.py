"""What the screen asks of the use cases, for one person: the only way from here to the cell."""

import asyncio
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, TypeVar

from depal.domain import CellLayout, Product
from depal.server.cell import Settings
from depal.server.cellstate import CellState
from depal.server.roles import Principal, Role

T = TypeVar("T")


class Refused(Exception):  # noqa: N818 - no error of the screen: what was asked cannot be done
    """What was asked for cannot be done; the text says why, for people.

    Attributes:
        problems: all that is wrong, where it is more than one thing.
    """

    def __init__(self, text: str, problems: Sequence[str] = ()) -> None:
        """Says why."""
        super().__init__(text)
        self.problems = tuple(problems)


@dataclass(frozen=True, slots=True)
class Waiting:
    """A delivery in the queue.

    Attributes:
        id: of the upload.
        name: of the delivery.
        boxes: how many its note promises.
        by: who uploaded it.
        state: queued, running, done or cancelled.
    """

    id: str
    name: str
    boxes: int
    by: str
    state: str = "queued"


@dataclass(frozen=True, slots=True)
class Run:
    """A run that is or was.

    Attributes:
        number: of it.
        delivery: its name.
        state: running, done or aborted.
        began: when, for people.
        stored: how many boxes were stored.
        boxes: how many there were.
    """

    number: int
    delivery: str
    state: str
    began: str
    stored: int | None = None
    boxes: int | None = None


@dataclass(frozen=True, slots=True)
class Person:
    """An account."""

    name: str
    role: Role


@dataclass(frozen=True, slots=True)
class Token:
    """A store system's way in.

    Attributes:
        id: of it.
        name: what it is for.
        expires: until when it is good, for people.
    """

    id: str
    name: str
    expires: str


class Desk(Protocol):
    """A person's side of the use cases; each may raise `Refused`, none runs on the loop."""

    @property
    def who(self) -> Principal:
        """Who asks."""
        ...

    @property
    def layout(self) -> CellLayout:
        """The cell."""
        ...

    def state(self) -> CellState:
        """Of the cell."""
        ...

    def picture(self) -> bytes:
        """The camera's last one; empty where there is none."""
        ...

    def deliveries(self) -> Sequence[Waiting]:
        """Those that wait or are worked on, the next first."""
        ...

    def upload(self, name: str, content: bytes) -> Sequence[Waiting]:
        """Adds the deliveries of a file to the queue."""
        ...

    def sample(self) -> Sequence[Waiting]:
        """Adds a delivery that ships with the package."""
        ...

    def move_delivery(self, delivery: str, steps: int) -> None:
        """Earlier or later in the queue."""
        ...

    def cancel_delivery(self, delivery: str) -> None:
        """Not to be emptied any more."""
        ...

    def start(self, delivery: str | None) -> None:
        """Begins with a delivery, or goes on."""
        ...

    def hold(self) -> None:
        """Nothing new begins."""
        ...

    def resume(self) -> None:
        """Goes on."""
        ...

    def stop_after_box(self) -> None:
        """Finishes the box in hand."""
        ...

    def answer(self, question: str, choice: str) -> None:
        """Answers a question."""
        ...

    def products(self) -> Sequence[Product]:
        """Those that the store knows, by name."""
        ...

    def put_product(self, product: Product) -> None:
        """Keeps what a product is called, measures and weighs."""
        ...

    def product_picture(self, gtin: str) -> bytes:
        """Its front; empty where there is none."""
        ...

    def put_picture(self, gtin: str, content: bytes) -> None:
        """Keeps a product's front."""
        ...

    def add_request(
        self, gtin: str | None, box: str | None, priority: float, minutes: float | None
    ) -> None:
        """Asks for a product or a box."""
        ...

    def change_request(self, key: str, priority: float, minutes: float | None) -> None:
        """Another priority or due time."""
        ...

    def cancel_request(self, key: str) -> None:
        """Not wanted any more."""
        ...

    def runs(self) -> Sequence[Run]:
        """Every run, the latest first."""
        ...

    def record(self, number: int) -> Path:
        """The folder with the record of a run."""
        ...

    def settings(self) -> Settings:
        """Of the cell."""
        ...

    def put_settings(self, settings: Settings) -> None:
        """Other settings."""
        ...

    def people(self) -> Sequence[Person]:
        """The accounts."""
        ...

    def add_person(self, name: str, role: Role, password: str) -> None:
        """A new account."""
        ...

    def change_role(self, name: str, role: Role) -> None:
        """Somebody may do more or less."""
        ...

    def set_password(self, name: str, password: str) -> None:
        """Another password."""
        ...

    def remove_person(self, name: str) -> None:
        """Somebody leaves."""
        ...

    def tokens(self) -> Sequence[Token]:
        """The ways in for systems."""
        ...

    def add_token(self, name: str, days: int) -> str:
        """A new one, which is shown this once."""
        ...

    def revoke_token(self, token: str) -> None:
        """Good no more."""
        ...


async def asked(function: Callable[..., T], *arguments: object) -> T:
    """Calls a use case away from the loop, which it must not keep."""
    return await asyncio.to_thread(function, *arguments)
