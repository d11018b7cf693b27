"""The requests of a run: when each came, what served it, and what left before it."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Self

from depal.domain import BoxId, Gtin, Request


@dataclass(frozen=True, slots=True)
class Wish:
    """A request and what became of it.

    Attributes:
        request: what is wanted.
        served: when its box left the pallet [s], None while it has not.
        box: the box that served it.
        boxes_before: how many boxes left the pallet between its arrival and its own.
        cancelled: whether it is not wanted any more.
        key: its name outside of the run; empty where it has none.
    """

    request: Request
    served: float | None = None
    box: BoxId | None = None
    boxes_before: int = 0
    cancelled: bool = False
    key: str = ""


class Wishes:
    """Requests that arrive over time; each is served once, by one box, and a box serves one."""

    def __init__(self, requests: Sequence[Request]) -> None:
        """Nothing has left the pallet yet."""
        self._wishes = [Wish(request) for request in requests]

    def __iter__(self) -> Iterator[Wish]:
        """The wishes in the order in which they were given."""
        return iter(tuple(self._wishes))

    def __len__(self) -> int:
        """How many there are."""
        return len(self._wishes)

    @classmethod
    def restored(cls, wishes: Sequence[Wish]) -> Self:
        """As they were before a restart."""
        found = cls(())
        found._wishes = list(wishes)
        return found

    def add(self, request: Request, key: str = "") -> None:
        """One more request; one of that key that is known already stays as it is."""
        if not key or all(wish.key != key for wish in self._wishes):
            self._wishes.append(Wish(request, key=key))

    def change(self, key: str, request: Request) -> bool:
        """The same request with another priority or due time; False where it has ended."""
        return self._replace(key, lambda wish: replace(wish, request=request))

    def cancel(self, key: str) -> bool:
        """A request is not wanted any more; False where it has ended."""
        return self._replace(key, lambda wish: replace(wish, cancelled=True))

    def _replace(self, key: str, changed: Callable[[Wish], Wish]) -> bool:
        for number, wish in enumerate(self._wishes):
            if wish.key == key and wish.served is None and not wish.cancelled:
                self._wishes[number] = changed(wish)
                return True
        return False

    def open(self, now: float) -> tuple[Request, ...]:
        """The requests that have arrived and are not served."""
        return tuple(wish.request for _, wish in self._waiting(now))

    def left(self, box: BoxId, gtin: Gtin | None, now: float) -> None:
        """A box has left the pallet: it serves the most important request that it can serve.

        Args:
            box: which.
            gtin: its product, None while nobody knows it; `identified` makes up for that.
            now: the time [s].
        """
        best = self._best(box, gtin, now)
        for number, wish in self._waiting(now):
            if number == best:
                self._wishes[number] = replace(wish, served=now, box=box)
            else:
                self._wishes[number] = replace(wish, boxes_before=wish.boxes_before + 1)

    def identified(self, box: BoxId, gtin: Gtin, now: float) -> None:
        """A box that had left unknown is of a product: it may serve a request after all."""
        if any(wish.box == box for wish in self._wishes):
            return
        best = self._best(box, gtin, now)
        if best is not None:
            wish = self._wishes[best]
            before = max(0, wish.boxes_before - 1)  # the box itself was counted
            self._wishes[best] = replace(wish, served=now, box=box, boxes_before=before)

    def doubted(self, box: BoxId) -> None:
        """A box that had left is not the product that it was taken for: it has served nothing."""
        for number, wish in enumerate(self._wishes):
            if wish.box == box and wish.request.box != box:
                before = wish.boxes_before + 1  # it has left, and did not serve
                self._wishes[number] = replace(wish, served=None, box=None, boxes_before=before)

    def _waiting(self, now: float) -> list[tuple[int, Wish]]:
        return [
            (number, wish)
            for number, wish in enumerate(self._wishes)
            if wish.served is None and not wish.cancelled and wish.request.arrived <= now
        ]

    def _best(self, box: BoxId, gtin: Gtin | None, now: float) -> int | None:
        fitting = [
            (wish.request.priority, -number)
            for number, wish in self._waiting(now)
            if wish.request.box == box or (gtin is not None and wish.request.gtin == gtin)
        ]
        return -max(fitting)[1] if fitting else None
