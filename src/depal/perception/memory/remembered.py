"""One box as all looks together show it."""

from dataclasses import dataclass, replace

from depal.domain import BoxId, Gtin
from depal.geometry import Vector3
from depal.perception.faces import SeenBox
from depal.perception.memory.anchors import aligned, between, resized_at_its_face
from depal.perception.memory.fusing import fused

MOVED = 0.015
"""A box that a look shows this far from where it was has moved; nearer is noise [m]."""

FULL = 5
"""So many looks at a box are as good as any number."""

FORGETTING = 0.5
"""What a box is believed in after a look that should have shown it and did not."""

NAMED = 2.0
"""A name that could be believed speaks for a box as much as so many looks without one."""

OTHER_SIZE = 0.012
"""Sizes that differ by more are not the same size seen twice [m]."""


@dataclass(frozen=True, slots=True)
class Remembered:
    """A box that is believed to stand on the pallet.

    Attributes:
        name: its own, kept from look to look.
        seen: as all looks since it last moved show it.
        looks: how many these are.
        missed: how many looks in a row did not show it.
        last: when a look last showed it [s].
        rival: where the last look showed it, if that was elsewhere: one look may be wrong.
    """

    name: BoxId
    seen: SeenBox
    looks: int = 1
    missed: int = 0
    last: float = 0.0
    rival: SeenBox | None = None

    @property
    def settled(self) -> bool:
        """Whether the last look showed it, and where those before did."""
        return not self.missed and self.rival is None

    @property
    def belief(self) -> float:
        """How much speaks for the box: what looks have shown, and what they have not."""
        named = NAMED if self.seen.gtin is not None else 1.0
        return self.seen.score * named * min(self.looks, FULL) * FORGETTING**self.missed

    @property
    def centre(self) -> Vector3:
        """Of the box, in the cell frame [m]."""
        return self.seen.shape.centre

    def again(self, seen: SeenBox, now: float) -> "Remembered":
        """A look shows it: averaged where it has not moved, else as two looks show it."""
        before = self.seen
        turned = replace(seen, shape=aligned(seen.shape, before.shape))
        if between(before.shape, turned.shape).shift > MOVED:
            return self._elsewhere(turned, now)
        if before.sized and not turned.sized:
            shape = resized_at_its_face(turned.shape, before.shape.size)
            turned = replace(turned, shape=shape, sized=True)
        gtin = _agreed(before, turned)
        if (turned.sized and not before.sized) or self._resized(turned):
            return Remembered(self.name, replace(turned, gtin=gtin), last=now)
        kept = replace(fused(before, turned, self.looks), gtin=gtin)
        return Remembered(self.name, kept, self.looks + 1, last=now)

    def _elsewhere(self, seen: SeenBox, now: float) -> "Remembered":
        """A look shows it elsewhere: believed when the next one agrees with it."""
        if self.looks > 1 and self._is_worse(seen):
            return replace(self, looks=self.looks - 1, missed=0, last=now, rival=None)
        rival = self.rival
        if rival is None or between(rival.shape, seen.shape).shift > MOVED:
            return replace(self, missed=0, last=now, rival=seen)
        there = Remembered(self.name, rival, last=now)
        return there.again(seen, now)

    def _resized(self, seen: SeenBox) -> bool:
        """Whether a look has learned another size, and knows better: by the product's print."""
        differ = max(abs(a - b) for a, b in zip(self.seen.shape.size, seen.shape.size, strict=True))
        return differ > OTHER_SIZE and (seen.gtin is not None or self.seen.gtin is None)

    def _is_worse(self, seen: SeenBox) -> bool:
        """Whether a look tells less than those before: another size, and no name where one was."""
        differ = max(abs(a - b) for a, b in zip(self.seen.shape.size, seen.shape.size, strict=True))
        return self.seen.gtin is not None and seen.gtin is None and differ > OTHER_SIZE

    def unseen(self) -> "Remembered":
        """A look does not show it."""
        return replace(self, missed=self.missed + 1, rival=None)


def _agreed(before: SeenBox, seen: SeenBox) -> Gtin | None:
    """The product of a box: what a look can name stays known; two names are none."""
    if before.gtin is None or seen.gtin is None or before.gtin == seen.gtin:
        return seen.gtin if before.gtin is None else before.gtin
    return None
