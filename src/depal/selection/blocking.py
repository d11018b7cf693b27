"""What the selection asks of a rule that says which box blocks which."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt

from depal.domain import BoxId, Perceived, Request
from depal.selection.links import Array, Links


@dataclass(frozen=True, slots=True)
class Aim:
    """A request and the perceived box that would serve it with the fewest removals.

    Attributes:
        request: what is wanted.
        box: the perceived box that it aims at.
        removals: the boxes that are to leave before it: |T(box)| - 1 under G.
        least: the proven minimum of them under the same rule of what blocks what.
    """

    request: Request
    box: BoxId
    removals: int
    least: int


class Blocking(Protocol):
    """The perceived boxes in numbered slots, and the edges from each to those that block it."""

    @property
    def links(self) -> Links:
        """The edges between slots."""

    @property
    def prisms(self) -> Array:
        """(slots, 8), one prism per slot."""

    @property
    def used_slots(self) -> npt.NDArray[np.intp]:
        """The slots that hold a box, rising."""

    def __len__(self) -> int:
        """How many boxes there are."""

    def at(self, slot: int) -> Perceived:
        """The box in a slot."""

    def by_slot(self) -> tuple[Perceived | None, ...]:
        """What is in each slot."""

    def slot_of(self, box: BoxId) -> int | None:
        """The slot of a box, or None when it is not perceived."""

    def geometric_rank(self) -> npt.NDArray[np.int64]:
        """(slots,) the order that settles ties."""

    def cycle(self) -> tuple[BoxId, ...]:
        """One cycle of blockers, or nothing."""

    def removals(self, slot: int) -> tuple[int, int]:
        """How many boxes are to leave before a box, and the proven minimum of them."""

    def ahead(self, aims: Sequence[Aim]) -> tuple[frozenset[int], ...]:
        """Slots whose boxes go before all others, set by set, whatever their scores."""
