"""The AND/OR graph of access: a box leaves by any one of its ways, when all that block it are gone.

The paper joins "placed on" and "occluding" into one relation (section II-C), so every box waits
for both. Here a box has ways: from above, from the front, with this tool or another. Each way
names all boxes that must leave first (AND); any one way is enough (OR).
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Self

from depal.domain import Approach

Mask = int
"""A set of boxes: bit b stands for box b."""


@dataclass(frozen=True, slots=True)
class Way:
    """One way to take one box.

    Attributes:
        box: its number.
        approach: from above (vertical) or from the front (horizontal).
        blockers: the boxes that must leave first.
    """

    box: int
    approach: Approach
    blockers: Mask


@dataclass(frozen=True, slots=True)
class Ways:
    """All ways to take all boxes.

    Attributes:
        present: the boxes that are there.
        of: per box number its ways, those with few blockers first; none that another one of the
            same box makes superfluous.
    """

    present: Mask
    of: tuple[tuple[Way, ...], ...]

    @classmethod
    def among(cls, present: Iterable[int], ways: Iterable[Way]) -> Self:
        """Of boxes with these numbers; blockers that are not present do not count.

        Args:
            present: the numbers of the boxes that are there.
            ways: of any boxes, in any order.
        """
        there = mask_of(present)
        listed: list[list[Way]] = [[] for _ in range(there.bit_length())]
        for way in ways:
            if there >> way.box & 1:
                listed[way.box].append(Way(way.box, way.approach, way.blockers & there))
        return cls(there, tuple(tuple(_needed(each)) for each in listed))

    def without(self, gone: Mask) -> "Ways":
        """The same after some boxes have left."""
        left = self.present & ~gone
        kept = (way for ways in self.of for way in ways)
        return Ways.among(members(left), kept)

    def free(self, gone: Mask = 0) -> Mask:
        """The boxes that can be taken now, or when those of `gone` have left."""
        left = self.present & ~gone
        return mask_of(
            box for box in members(left) if any(not way.blockers & left for way in self.of[box])
        )

    def peeled(self, among: Mask | None = None) -> Mask:
        """The boxes that can leave one after the other, while all others stay.

        Args:
            among: only these may leave; None for all.
        """
        may = self.present if among is None else among & self.present
        gone = 0
        while True:
            left = self.present & ~gone
            more = mask_of(
                box
                for box in members(may & ~gone)
                if any(not way.blockers & left for way in self.of[box])
            )
            if not more:
                return gone
            gone |= more


def mask_of(boxes: Iterable[int]) -> Mask:
    """The set of these boxes."""
    mask = 0
    for box in boxes:
        mask |= 1 << box
    return mask


def members(mask: Mask) -> Iterator[int]:
    """The boxes of a set, rising."""
    while mask:
        low = mask & -mask
        yield low.bit_length() - 1
        mask ^= low


def _needed(ways: Sequence[Way]) -> list[Way]:
    """Without those that need all that another one needs; of equals the first stays."""
    kept: list[Way] = []
    for way in sorted(ways, key=lambda each: each.blockers.bit_count()):
        if not any(way.blockers & other.blockers == other.blockers for other in kept):
            kept.append(way)
    return kept
