"""What the screen asks of the use cases, for one person: the only way from here to the cell."""

import asyncio
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol, TypeVar

from depal.domain import CellLayout, Product
from depal.server.cellstate import CellState
from depal.server.roles import Principal

T = TypeVar("T")


class Refused(Exception):  # noqa: N818 - no error of the screen: what was asked cannot be done
    """What was asked for cannot be done; the text says why, for people."""


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


class Desk(Protocol):
    """A person's side of the use cases; each may raise `Refused`."""

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

    def deliveries(self) -> Sequence[Waiting]:
        """Those that wait or are worked on, the next first."""
        ...

    def upload(self, name: str, text: str) -> Sequence[Waiting]:
        """Adds deliveries to the queue."""
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
        """Those that can be asked for, by name."""
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


async def asked(function: Callable[..., T], *arguments: object) -> T:
    """Calls a use case away from the loop, which it must not keep."""
    return await asyncio.to_thread(function, *arguments)
