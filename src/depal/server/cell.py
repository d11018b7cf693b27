"""The running cell as the use cases see it; everything may be called from any thread."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from depal.domain import CellLayout, Delivery, Request
from depal.errors import DepalError
from depal.server.cellstate import CellState


@dataclass(frozen=True, slots=True)
class Settings:
    """What an integrator may change while the cell stands, each within its bounds.

    Attributes:
        w: the weight of Eq. (3), in [0, 1].
        speed: the share of the arm's full speed, in (0, 1].
        policy: "paper" or "access".
    """

    w: float = 0.5
    speed: float = 1.0
    policy: str = "paper"


@dataclass(frozen=True, slots=True)
class Order:
    """A delivery that is to be emptied.

    Attributes:
        run: its number; journal and record carry it.
        delivery: with its stack where the world is simulated.
        requests: those that wait, by key.
    """

    run: int
    delivery: Delivery
    requests: tuple[tuple[str, Request], ...] = ()


class Refusal(DepalError):  # noqa: N818 - it is an answer, and no fault
    """What was asked for cannot be done in this state; the text says why and what can."""


Watcher = Callable[[CellState], None]


class Cell(Protocol):
    """The cell behind the use cases.

    Commands return once the cell has taken them; a `Refusal` says why one cannot be taken.
    """

    @property
    def layout(self) -> CellLayout:
        """The cell file."""
        ...

    def state(self) -> CellState:
        """What is so now; cheap, and never waits."""
        ...

    def watch(self, watcher: Watcher) -> Callable[[], None]:
        """Calls a function with every new state, on the cell's thread; returns what ends that."""
        ...

    def start(self, order: Order | None = None) -> None:
        """Begins with an order, or goes on after a stop, a hold or a restart."""
        ...

    def hold(self, source: str) -> None:
        """Nothing new begins; the arm finishes what it does."""
        ...

    def resume(self, source: str) -> None:
        """Goes on after a hold."""
        ...

    def stop_after_box(self, source: str) -> None:
        """Finishes the box in hand, then stops."""
        ...

    def add_request(self, key: str, request: Request) -> None:
        """One more request, honoured at the next selection."""
        ...

    def change_request(self, key: str, request: Request) -> None:
        """A request with another priority or due time."""
        ...

    def cancel_request(self, key: str) -> None:
        """A request is not wanted any more."""
        ...

    def answer(self, question: str, choice: str, source: str) -> None:
        """A person has answered a question."""
        ...

    def set(self, settings: Settings) -> None:
        """Other settings from the next selection and the next motion on."""
        ...

    def why(self, box: str) -> str:
        """Why the last selection took a box, or did not, in words."""
        ...

    def picture(self) -> bytes:
        """The last camera picture with what was seen in it, as JPEG; empty where there is none."""
        ...
