"""The memory of a pallet: every look is laid over what was believed before."""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from depal.domain import BoxId
from depal.geometry import Vector3
from depal.perception.faces import Look, SeenBox
from depal.perception.memory.anchors import between
from depal.perception.memory.matching import matched
from depal.perception.memory.parting import parted
from depal.perception.memory.remembered import MOVED, Remembered

PATIENCE = 6
"""So many looks in a row may miss a box before it is believed to be gone."""

GHOST = 0.03
"""A box in a picture this near to one that was just taken is that one, in an old picture [m]."""

FRESH = 1.0
"""A picture taken this shortly after a box has left may still show it [s]."""

ROW = 0.08
"""Bottoms that differ by less are one row, when boxes get their first names [m]."""

NEAR = 0.12
"""A box is where it was pointed at when its middle is within this [m]."""


@dataclass(frozen=True, slots=True)
class Memory:
    """The boxes that are believed to stand on the pallet, and the names that were given.

    Attributes:
        boxes: by the age of their names.
        gone: boxes that were taken, with the time; their names are never given again.
        named: how many names were given.
        places: names that somebody has given to places in advance, [m] in the cell frame.
        moved: boxes that the last look showed elsewhere than the looks before.
        denied: what was seen and is no box, as somebody said who stood beside it.
        patience: so many looks in a row may miss a box before it is believed to be gone.
    """

    boxes: tuple[Remembered, ...] = ()
    gone: tuple[tuple[Remembered, float], ...] = ()
    named: int = 0
    places: tuple[tuple[BoxId, Vector3], ...] = ()
    moved: frozenset[BoxId] = frozenset()
    denied: tuple[Remembered, ...] = ()
    patience: int = PATIENCE

    def __iter__(self) -> Iterator[Remembered]:
        """The boxes."""
        return iter(self.boxes)

    def __len__(self) -> int:
        """How many boxes are believed to stand there."""
        return len(self.boxes)

    def get(self, name: BoxId) -> Remembered | None:
        """A box by its name."""
        return next((box for box in self.boxes if box.name == name), None)

    @property
    def hidden(self) -> frozenset[BoxId]:
        """Boxes that the last look did not show, or not where those before did."""
        return frozenset(box.name for box in self.boxes if not box.settled)

    def update(self, look: Look, now: float) -> "Memory":
        """Lays a look over what was believed.

        Boxes keep their names where position, size and product allow; what has not moved is
        averaged; what the look misses is remembered with growing doubt; what nobody has seen
        before gets a name of its own; where two boxes share space, less is believed.

        Args:
            look: what one look has found.
            now: when its picture was taken [s].
        """
        new = [seen for seen in look.boxes if not self._is_ghost(seen, now)]
        pairs = matched(self.boxes, new)
        names = {pairs[index]: box.name for index, box in enumerate(self.boxes) if index in pairs}
        return self._laid_over(new, names, now)

    def told(self, named: Iterable[tuple[BoxId, SeenBox]], now: float) -> "Memory":
        """Lays a look over what was believed whose boxes have brought their names.

        Args:
            named: what the look has found; boxes that were taken stay away.
            now: when its picture was taken [s].
        """
        away = {box.name for box, _ in self.gone}
        found = [(name, seen) for name, seen in named if name not in away]
        names = {index: name for index, (name, _) in enumerate(found)}
        return self._laid_over([seen for _, seen in found], names, now, part=False)

    def without(self, name: BoxId, now: float) -> "Memory":
        """A box was taken."""
        box = self.get(name)
        if box is None:
            return self
        kept = tuple(other for other in self.boxes if other.name != name)
        return replace(self, boxes=kept, gone=(*self.gone, (box, now)))

    def forgetting(self, name: BoxId) -> "Memory":
        """A box is not there, somebody says: what looks like it is not believed again."""
        box = self.get(name)
        kept = tuple(other for other in self.boxes if other.name != name)
        return self if box is None else replace(self, boxes=kept, denied=(*self.denied, box))

    def back(self, name: BoxId, seen: SeenBox, now: float) -> "Memory":
        """A box stands on the pallet again."""
        kept = tuple(box for box in self.boxes if box.name != name)
        gone = tuple(entry for entry in self.gone if entry[0].name != name)
        return replace(self, boxes=(*kept, Remembered(name, seen, last=now)), gone=gone)

    def _is_ghost(self, seen: SeenBox, now: float) -> bool:
        """Whether this is a box that was taken, in an old picture, or one that never was."""
        old = [box for box, at in self.gone if now <= at + FRESH]
        return any(
            between(box.seen.shape, seen.shape).total < GHOST for box in (*old, *self.denied)
        )

    def _laid_over(
        self, new: Sequence[SeenBox], names: dict[int, BoxId], now: float, *, part: bool = True
    ) -> "Memory":
        before = {box.name: box for box in self.boxes}
        moved: set[BoxId] = set()
        after: dict[BoxId, Remembered] = {}
        for index, name in names.items():
            if name not in before:
                after[name] = Remembered(name, new[index], last=now)
                continue
            after[name] = before[name].again(new[index], now)
            if between(before[name].seen.shape, new[index].shape).shift > MOVED:
                moved.add(name)
                if not part:  # such a sight is not wrong
                    after[name] = Remembered(name, new[index], last=now)
        lasting = [
            after.get(box.name, box.unseen())
            for box in self.boxes
            if box.name in after or box.missed + 1 < self.patience
        ]
        lasting += [box for name, box in after.items() if name not in before]
        fresh, named = self._newly_named([new[k] for k in range(len(new)) if k not in names], now)
        boxes = (*lasting, *fresh)
        return replace(
            self,
            boxes=parted(boxes) if part else boxes,
            named=named,
            moved=frozenset(moved),
        )

    def _newly_named(self, new: Sequence[SeenBox], now: float) -> tuple[list[Remembered], int]:
        """Names for boxes that nobody has seen before: row by row from below, left to right."""
        taken = {box.name for box in self.boxes} | {box.name for box, _ in self.gone}
        promised = dict(self.places)
        number, out = self.named, []
        for seen in sorted(new, key=_reading_order):
            free = [name for name in promised if name not in taken]
            near = [n for n in free if math.dist(promised[n], seen.shape.centre) < NEAR]
            if near:
                name = min(near, key=lambda n: math.dist(promised[n], seen.shape.centre))
            else:
                number += 1
                while (name := BoxId(f"b{number}")) in promised or name in taken:
                    number += 1
            taken.add(name)
            out.append(Remembered(name, seen, last=now))
        return out, number


def _reading_order(seen: SeenBox) -> tuple[int, float, float]:
    x, y, z = seen.shape.centre
    return (round((z - seen.shape.size[2] / 2) / ROW), -y, x)
