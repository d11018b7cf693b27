"""The requests of a run: when each came, what served it, and what left before it."""

from collections.abc import Sequence
from dataclasses import dataclass

from depal.domain import BoxId, Gtin, Request


@dataclass(frozen=True, slots=True)
class Wish:
    """A request and what became of it.

    Attributes:
        request: what is wanted.
        served: when its box left the pallet [s], None while it has not.
        box: the box that served it.
        boxes_before: how many boxes left the pallet between its arrival and its own.
    """

    request: Request
    served: float | None = None
    box: BoxId | None = None
    boxes_before: int = 0


class Wishes:
    """Requests that arrive over time; each is served once, by one box."""

    def __init__(self, requests: Sequence[Request]) -> None:
        """Nothing has left the pallet yet."""
        self._wishes = [Wish(request) for request in requests]


    @property
    def all(self) -> tuple[Wish, ...]:
        """Every wish, in the order in which they were given."""
        return tuple(self._wishes)

    def add(self, request: Request) -> None:
        """One more request."""
        self._wishes.append(Wish(request))

    def open(self, now: float) -> tuple[Request, ...]:
        """The requests that have arrived and are not served."""
        return tuple(
            wish.request
            for wish in self._wishes
            if wish.served is None and wish.request.arrived <= now
        )

    def left(self, box: BoxId, gtin: Gtin | None, now: float) -> None:
        """A box has left the pallet: it serves the most important request that it can serve."""
        fitting = [
            number
            for number, wish in enumerate(self._wishes)
            if wish.served is None
            and wish.request.arrived <= now
            and (wish.request.box == box or (gtin is not None and wish.request.gtin == gtin))
        ]
        best = max(fitting, key=lambda n: (self._wishes[n].request.priority, -n), default=None)
        for number, wish in enumerate(self._wishes):
            if number == best:
                self._wishes[number] = Wish(wish.request, now, box, wish.boxes_before)
            elif wish.served is None and wish.request.arrived <= now:
                self._wishes[number] = Wish(wish.request, None, None, wish.boxes_before + 1)
