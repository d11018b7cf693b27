"""What the cell believes stands on the pallet: all looks together, and what one may have missed."""

import math
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from depal.domain import BoxId, Detection, Gtin, Perceived, Recognition
from depal.geometry import OrientedBox, Pose, Vector3
from depal.perception.faces import SeenBox
from depal.perception.memory import Memory, Remembered
from depal.perception.memory.anchors import resized_at_its_face
from depal.ports import View

MISSED = 20
"""So many looks in a row may miss a box, behind the arm say, before it is believed to be gone."""

EQUAL = 0.003
"""Error of a box whose sight tells none [m, rad]."""

HANGING = 0.08
"""A box whose bottom is higher than this above all that was seen below it stands on a box that has
not been found: no box is less high [m]."""

OVER = 0.015
"""Boxes that overlap on the ground by more than this may carry one another [m]."""


@dataclass(frozen=True, slots=True)
class Slack:
    """How wrong the sight of a box may be.

    Attributes:
        level: a box whose bottom is this near to what could carry it stands on it [m].
        square: one that is turned less than this against the pallet stands square on it [rad].
    """

    level: float = 0.010
    square: float = math.radians(1.5)


FINE = Slack()
"""Of a sight that is exact, and of boxes with a name."""

COARSE = Slack(0.025, math.radians(5.0))
"""Of a box without a name in a sight that measures with cameras. Often the top alone was seen, at a
distance that is the worst of what cameras measure; and what was taken for its edges may be those of
a shadow, askew by some degrees. Pallets are stacked square."""


@dataclass(frozen=True, slots=True)
class Deck:
    """The pallet under the boxes, which is known exactly.

    Attributes:
        height: of its top in the cell frame [m].
        yaw: of its long side in the cell frame [rad].
    """

    height: float
    yaw: float

    @classmethod
    def of(cls, cell_from_pallet: Pose) -> "Deck":
        """Of a pallet at a pose."""
        x, y = cell_from_pallet.rotation[0][0], cell_from_pallet.rotation[1][0]
        return cls(cell_from_pallet.translation[2], math.atan2(y, x))


class Pile:
    """The boxes on the pallet, kept from look to look.

    A sight that has no memory of its own gets one here: where a box has not moved, looks are
    averaged; a box that a look does not show is remembered where it was. A box that was taken does
    not come back by itself.
    """

    def __init__(self, deck: Deck | None = None) -> None:
        """Nothing was seen yet.

        Args:
            deck: what the boxes stand on, where it is known.

        `hidden`, `unsized` and `obstacles` are those of the last look; `remembered` is whether the
        sight has a memory of its own: such a sight measures with cameras, and errs; `bared` are
        boxes that have left since: what stands below them nobody has seen yet.
        """
        self._deck = deck
        self._memory = Memory(patience=MISSED)
        self._boxes: dict[BoxId, Perceived] = {}
        self._taken: dict[BoxId, float] = {}
        self._left: dict[BoxId, Gtin | None] = {}
        self._read: dict[BoxId, Gtin] = {}
        self._sizes: dict[BoxId, Vector3] = {}
        self._looks = 0
        self.remembered = False
        self._since: dict[BoxId, int] = {}
        self.hidden: frozenset[BoxId] = frozenset()
        self.unsized: frozenset[BoxId] = frozenset()
        self.obstacles: tuple[OrientedBox, ...] = ()
        self.bared: dict[BoxId, OrientedBox] = {}

    def see(self, view: View) -> None:
        """Takes over what a look has found."""
        found = {box.id: box for box in view.boxes if box.id not in self._taken}
        self._looks += 1
        for box in found:
            self._since.setdefault(box, self._looks)
        if view.obstacles is not None:
            self.bared = {}
        if view.remembered:
            self._boxes, self.remembered = found, True
            self.hidden, self.unsized = view.hidden, view.unsized
            if view.obstacles is not None:
                self.obstacles = view.obstacles
            return
        named = [(box.id, seen_as(box)) for box in found.values()]
        self._memory = self._memory.told(named, view.taken)
        self._boxes = {
            box.name: _perceived(box, found.get(box.name, self._boxes.get(box.name)))
            for box in self._memory
        }

    def take(self, box: BoxId, at: float = 0.0) -> None:
        """A box was lifted off [s]."""
        if box not in self._taken:
            there = self.get(box)
            if there is not None:
                self.bared[box] = there.shape
            self._left[box] = there.gtin if isinstance(there, Recognition) else None
        self.forget(box, at)

    def forget(self, box: BoxId, at: float = 0.0) -> None:
        """A box is not there, and never was: somebody has looked [s]."""
        self._taken.setdefault(box, at)
        self._boxes.pop(box, None)
        self._memory = self._memory.without(box, at)

    def put_back(self, box: Perceived) -> None:
        """A box stands on the pallet again; the next look says where."""
        self._taken.pop(box.id, None)
        self._left.pop(box.id, None)
        self._boxes[box.id] = box
        self._memory = self._memory.back(box.id, seen_as(box), 0.0)

    def identify(self, box: BoxId, gtin: Gtin) -> None:
        """A box that was only detected has been read: from now on it is recognised."""
        self._read[box] = gtin
        if box in self._left:
            self._left[box] = gtin

    def resize(self, box: BoxId, size: Vector3) -> None:
        """What was felt tells the size of a box better than what was seen [m, its own axes]."""
        self._sizes[box] = size

    def doubt(self, box: BoxId) -> None:
        """What a box was taken to be is not so."""
        self._read.pop(box, None)
        if box in self._left:
            self._left[box] = None

    @property
    def left_as(self) -> tuple[Gtin | None, ...]:
        """The products of the boxes that were lifted off; None where nobody knows."""
        return tuple(self._left.values())

    @property
    def departed(self) -> Mapping[BoxId, Gtin | None]:
        """The boxes that were lifted off, and their products where they are known."""
        return self._left

    def away(self, box: BoxId, at: float, gtin: Gtin | None) -> None:
        """A box was lifted off before anybody remembers [s]."""
        self._left[box] = gtin
        if gtin is not None:
            self._read[box] = gtin
        self.forget(box, at)

    def recall(self, boxes: Iterable[Perceived]) -> None:
        """What was believed before a restart is believed until a look says more."""
        self._boxes = {box.id: box for box in boxes}
        named = [(box.id, seen_as(box)) for box in self._boxes.values()]
        self._memory = self._memory.told(named, 0.0)

    @property
    def taken(self) -> Mapping[BoxId, float]:
        """The boxes that were lifted off, and when [s]."""
        return self._taken

    @property
    def boxes(self) -> tuple[Perceived, ...]:
        """What stands there, by name; level and square where it seems so."""
        known = [self._known(self._boxes[name]) for name in sorted(self._boxes)]
        if self._deck is None:
            return tuple(known)
        return settled(known, self._deck, self.unsized, COARSE if self.remembered else FINE)

    @property
    def unborne(self) -> tuple[OrientedBox, ...]:
        """What must stand below boxes that stand on nothing that was seen, in the cell frame.

        Such a box is no error of its own: what carries it has not been found yet.
        """
        return () if self._deck is None else props(self.boxes, self._deck)

    @property
    def strange(self) -> tuple[OrientedBox, ...]:
        """Where something stands that no box explains, in the cell frame.

        What looks show, and, of a sight that errs, what must be below boxes that hang in the air.
        """
        return (*self.obstacles, *(self.unborne if self.remembered else ()))

    def is_fresh(self, box: BoxId) -> bool:
        """Whether only the last look has shown a box, there were looks before it, and they err."""
        return self.remembered and 1 < self._looks == self._since.get(box)

    def get(self, box: BoxId) -> Perceived | None:
        """A box by its name."""
        return next((found for found in self.boxes if found.id == box), None)

    def __len__(self) -> int:
        """How many boxes stand there."""
        return len(self._boxes)

    def _known(self, box: Perceived) -> Perceived:
        gtin = self._read.get(box.id)
        if box.id in self._sizes and isinstance(box, Detection):
            box = replace(box, shape=resized_at_its_face(box.shape, self._sizes[box.id]))
        if gtin is None:
            return box
        if isinstance(box, Recognition):
            return replace(box, gtin=gtin)
        return Recognition(box.id, box.shape, gtin)


def seen_as(box: Perceived) -> SeenBox:
    """A box of a sight that tells no errors: all looks are equally good."""
    gtin = box.gtin if isinstance(box, Recognition) else None
    return SeenBox(box.shape, 1.0, np.eye(6) * EQUAL**2, gtin=gtin)


def _perceived(box: Remembered, last: Perceived | None) -> Perceived:
    """A remembered box; its product is what the last look has told."""
    if isinstance(last, Recognition):
        return replace(last, shape=box.seen.shape)
    return Detection(box.name, box.seen.shape)


def settled(
    boxes: Iterable[Perceived],
    deck: Deck,
    unsized: Collection[BoxId] = (),
    unnamed: Slack = FINE,
) -> tuple[Perceived, ...]:
    """Boxes as they can stand: square to the pallet, and on what carries them, where it is near.

    Args:
        boxes: upright, in the cell frame.
        deck: what the lowest stand on.
        unsized: boxes of which an edge is a guess: their faces stay where they were seen.
        unnamed: how wrong the sight of boxes without a name may be; of others it is better.

    Returns:
        The same boxes in the same order.
    """
    listed = list(boxes)
    done: dict[BoxId, Perceived] = {}
    for box in sorted(listed, key=lambda each: (_bottom(each.shape), each.id)):
        size, centre = box.shape.size, box.shape.centre
        quarter = math.pi / 2
        off = _yaw(box.shape) - deck.yaw
        away = off - quarter * round(off / quarter)
        slack = FINE if isinstance(box, Recognition) else unnamed
        yaw = _yaw(box.shape) - (away if abs(away) < slack.square else 0.0)
        bottom = _bottom(box.shape)
        if box.id not in unsized:
            below = [other.shape for other in done.values()]
            bottom = _carried(box.shape, below, deck, slack.level)
        x, y, _ = centre
        pose = Pose.from_yaw((x, y, bottom + size[2] / 2), yaw)
        done[box.id] = replace(box, shape=OrientedBox(pose, size))
    return tuple(done[box.id] for box in listed)


def props(boxes: Iterable[Perceived], deck: Deck) -> tuple[OrientedBox, ...]:
    """What must stand below boxes that hang in the air, from their bottoms down to what was seen.

    Args:
        boxes: upright, as they stand, in the cell frame.
        deck: what the lowest stand on.
    """
    shapes = [box.shape for box in boxes]
    out = []
    for box in shapes:
        bottom = _bottom(box)
        tops = (_bottom(other) + other.size[2] for other in shapes if _over(box, other))
        floor = max((top for top in tops if top < bottom + COARSE.level), default=deck.height)
        if bottom - floor > HANGING:
            x, y, _ = box.centre
            pose = Pose((x, y, (bottom + floor) / 2), box.pose.rotation)
            out.append(OrientedBox(pose, (*box.size[:2], bottom - floor)))
    return tuple(out)


def _carried(box: OrientedBox, below: list[OrientedBox], deck: Deck, level: float) -> float:
    """The height of what carries a box, where something near does; else of its bottom [m]."""
    bottom = _bottom(box)
    tops = [(_bottom(other) + other.size[2], other) for other in below]
    near = [(top, other) for top, other in tops if abs(top - bottom) < level]
    heights = [deck.height, *(top for top, other in near if _over(box, other))]
    nearest = min(heights, key=lambda height: abs(height - bottom))
    return nearest if abs(nearest - bottom) < level else bottom


def _over(box: OrientedBox, other: OrientedBox) -> bool:
    """Whether two upright boxes overlap on the ground, roughly: by their bounding rectangles."""
    one, two = _reach(box), _reach(other)
    return all(
        abs(a - b) < (r + s) / 2 - OVER
        for a, b, r, s in zip(box.centre[:2], other.centre[:2], one, two, strict=True)
    )


def _reach(box: OrientedBox) -> tuple[float, float]:
    along, across = (
        sum(abs(turn) * edge for turn, edge in zip(row, box.size, strict=True))
        for row in box.pose.rotation[:2]
    )
    return along, across


def _bottom(box: OrientedBox) -> float:
    return box.centre[2] - box.size[2] / 2


def _yaw(box: OrientedBox) -> float:
    return math.atan2(box.pose.rotation[1][0], box.pose.rotation[0][0])
