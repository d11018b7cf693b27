"""What would have changed a choice: the value of w, a request, a box that is gone.

Scores are linear in w and, piece by piece, in each priority: a choice turns only where two lines
cross. The crossings are the candidates; just beyond the first at which another box is best, it
is the one that is chosen.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import Enum

import numpy as np
import numpy.typing as npt

from depal.domain import BoxId, Request
from depal.selection.situation import Situation

Array = npt.NDArray[np.float64]

BEYOND = 1e-6
"""So far beyond a crossing it is seen what is chosen there."""


class Kind(Enum):
    """What is changed."""

    W = "w"
    PRIORITY = "priority"
    WITHDRAWN = "request withdrawn"
    WISH = "request added"
    REMOVAL = "box removed"


class Side(Enum):
    """On which side of the value the choice is another."""

    BELOW = "below"
    ABOVE = "above"


@dataclass(frozen=True, slots=True)
class Change:
    """One change after which another box is chosen.

    Attributes:
        kind: of what.
        then: the box that is chosen instead; None for none.
        subject: the request or box that it is about, as in "box b3"; empty for w.
        value: of w or of the priority, where the choice turns; None where there is none.
        side: of that value.
    """

    kind: Kind
    then: BoxId | None
    subject: str = ""
    value: float | None = None
    side: Side | None = None

    @property
    def text(self) -> str:
        """In words."""
        then = "nothing can be grasped" if self.then is None else f"{self.then} is chosen"
        value = "" if self.value is None else f"{self.value:.3f}"
        side = "" if self.side is None else f" {self.side.value}"
        match self.kind:
            case Kind.W:
                return f"with w{side} {value} {then}"
            case Kind.PRIORITY:
                return f"with p of the request for {self.subject}{side} {value} {then}"
            case Kind.WITHDRAWN:
                return f"without the request for {self.subject} {then}"
            case Kind.WISH:
                return f"with a request for {self.subject}, p{side} {value}, {then}"
            case _:
                return f"were {self.subject} gone, {then}"


def by_w(now: Situation, target: BoxId) -> Iterator[Change]:
    """Down to which w, and up to which, the target is chosen."""
    mine = now.free.index(target)
    # s_target - s_other is a line in w, from `at_0` to `at_1`.
    at_0, at_1 = now.h[mine] - now.h, now.l[mine] - now.l
    with np.errstate(divide="ignore", invalid="ignore"):
        crossings = at_0 / (at_0 - at_1)
    seen: set[Side] = set()
    for value, side in _ordered(crossings[np.isfinite(crossings)], now.rule.w):
        beyond = value + _STEPS[side]
        if side in seen or not 0.0 <= beyond <= 1.0:
            continue
        if (then := now.best(now.l, beyond)) != target:
            seen.add(side)
            yield Change(Kind.W, then, value=value, side=side)


def by_priority(now: Situation, target: BoxId) -> Iterator[Change]:
    """Per request the priorities down to and up to which the target is chosen."""
    if now.rule.w == 0.0:
        return
    for number, request in enumerate(now.requests):
        low = now.inherited(_changed(now, number, 0.0))
        high = now.inherited(_changed(now, number, 1.0))
        pulled = high > low
        share = now.rule.w
        score = share * low + (1 - share) * now.h
        # Where w p + (1 - w) h of a pulled box meets the score of another box without r.
        with np.errstate(over="ignore"):  # a weight near 0 meets others far beyond 1 only
            meeting = (score[None, :] - (1 - share) * now.h[pulled, None]) / share
        meeting = meeting[np.isfinite(meeting)]
        seen: set[Side] = set()
        for value, side in _ordered(meeting, request.priority):
            beyond = value + _STEPS[side]
            if side in seen or not 0.0 <= beyond <= 1.0:
                continue
            l = np.where(pulled, np.maximum(low, beyond), low)  # noqa: E741
            if (then := now.best(l, share)) != target:
                seen.add(side)
                yield Change(Kind.PRIORITY, then, request.wanted, value, side)


def by_withdrawal(now: Situation, target: BoxId) -> Iterator[Change]:
    """The requests without which another box is chosen."""
    for number, request in enumerate(now.requests):
        others = [*now.requests[:number], *now.requests[number + 1 :]]
        if (then := now.again(requests=others)) != target:
            yield Change(Kind.WITHDRAWN, then, request.wanted)


def by_wish(now: Situation, target: BoxId) -> Iterator[Change]:
    """The weakest request for a box that would have it chosen."""
    wishes = [wish for box in now.free if box != target for wish in wish_for(now, box)]
    yield from sorted(wishes, key=lambda wish: wish.value or 0.0)[:1]


def wish_for(now: Situation, box: BoxId) -> Iterator[Change]:
    """From which priority on a request for a free box has it chosen, where one can."""
    w, mine = now.rule.w, now.free.index(box)
    if w == 0.0:
        return
    best = float(np.max(w * now.l + (1 - w) * now.h))
    value = (best - (1 - w) * float(now.h[mine])) / w
    if value + BEYOND <= 1.0:
        yield Change(Kind.WISH, box, f"box {box}", value, Side.ABOVE)


def by_removal(now: Situation, target: BoxId) -> Iterator[Change]:
    """The boxes on top of the pile without which another box is chosen."""
    for box in sorted(now.graph.leaves() - {target}):
        if (then := now.again(without=[box])) != target:
            yield Change(Kind.REMOVAL, then, f"box {box}")


def shares_for(now: Situation, box: BoxId) -> Iterator[Change]:
    """From which w on, or down to which, a free box is chosen; nothing where for none."""
    mine = now.free.index(box)
    low, high = 0.0, 1.0
    pairs = zip((now.h[mine] - now.h).tolist(), (now.l[mine] - now.l).tolist(), strict=True)
    for begin, end in pairs:
        # Its score minus the other's is a line in w, from `begin` at 0 to `end` at 1.
        if begin < 0.0:
            low = max(low, begin / (begin - end)) if end > 0.0 else np.inf
        elif end < 0.0:
            high = min(high, begin / (begin - end))
    if low + 2 * BEYOND < high:
        above = now.rule.w <= low
        value, side = (low, Side.ABOVE) if above else (high, Side.BELOW)
        yield Change(Kind.W, box, value=value, side=side)


_STEPS = {Side.BELOW: -BEYOND, Side.ABOVE: BEYOND}


def _changed(now: Situation, number: int, priority: float) -> list[Request]:
    requests = list(now.requests)
    requests[number] = replace(requests[number], priority=priority)
    return requests


def _ordered(values: Array, start: float) -> Iterator[tuple[float, Side]]:
    """The values on each side of a start, the nearest first."""
    for value in np.unique(values[values <= start])[::-1].tolist():
        yield value, Side.BELOW
    for value in np.unique(values[values >= start]).tolist():
        yield value, Side.ABOVE
