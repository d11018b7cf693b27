"""Boxes that were lost by suction: the hold gave way, and they fell."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

from depal.domain.cup_group import Break
from depal.simulation.holds import Broken

FALL = 0.03
"""A box that sank by more than this after its hold broke has fallen [m]."""

WATCHED = 0.5
"""It is looked at so long after [s]."""

KNOCK = 0.1
"""A contact of the hand so shortly before is what broke the hold [s]."""


class Cause(Enum):
    """Why a hold gave way."""

    ACCELERATION = "acceleration"
    KNOCK = "knock"


@dataclass(frozen=True, slots=True)
class Loss:
    """A box that fell from the hand.

    Attributes:
        at: when the hold gave way [s].
        box: which box.
        cause: what loaded it.
        why: the limit that was passed.
    """

    at: float
    box: int
    cause: Cause
    why: Break


class LossWatch:
    """Tells the holds that gave way while the box stood from those that let it fall.

    Attributes:
        lost: in order.
    """

    def __init__(self) -> None:
        """Nothing is lost yet."""
        self.lost: list[Loss] = []
        self._open: list[tuple[Loss, float]] = []

    def gave_way(self, broken: Broken, height: float, touched: float) -> None:
        """A hold broke.

        Args:
            broken: the hold.
            height: of the box's centre then [m].
            touched: when the hand last touched something [s].
        """
        knocked = broken.at - touched <= KNOCK
        cause = Cause.KNOCK if knocked else Cause.ACCELERATION
        self._open.append((Loss(broken.at, broken.box, cause, broken.why), height))

    def look(self, now: float, height_of: Callable[[int], float]) -> None:
        """Decides on the holds that broke long enough ago."""
        for pair in [pair for pair in self._open if now - pair[0].at >= WATCHED]:
            self._open.remove(pair)
            loss, height = pair
            if height - height_of(loss.box) > FALL:
                self.lost.append(loss)
