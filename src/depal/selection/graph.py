"""The graph G of the perceived boxes, kept up to date from look to look and pick to pick."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.domain import BoxId, Perceived
from depal.errors import PileError, Problem, did_you_mean
from depal.geometry import PRISM_WIDTH, first_unsound, prism_of, prisms_of
from depal.selection.blocking import Aim
from depal.selection.building import link_prisms
from depal.selection.links import (
    BUILT,
    EMPTY,
    NONE,
    Array,
    Links,
    link_one,
    relate_to_all,
    remove,
    unlink,
)
from depal.selection.relations import CLASH, PERCEIVED, Relation, Tolerances
from depal.selection.score import geometric_rank
from depal.selection.walks import blockers_of, find_cycle, mark_reachable

_SMALLEST = 16


@dataclass(frozen=True, slots=True)
class Blocker:
    """One box that stands in the way of another, and how."""

    box: BoxId
    relation: Relation


class BlockingGraph:
    """G = (E, V): a vertex per perceived box, an edge from each box to those that block it.

    A box that leaves, comes or moves changes its own edges only. Every change is whole or not
    at all: what cannot stand in one world raises PileError and leaves the graph as it was.

    Attributes:
        tolerances: how wrong the poses may be.
    """

    def __init__(self, boxes: Iterable[Perceived] = (), tolerances: Tolerances = PERCEIVED) -> None:
        """The graph of boxes in the cell frame.

        Args:
            boxes: what was perceived, each with a name of its own.
            tolerances: how wrong the poses may be.

        Raises:
            PileError: a name twice, or two boxes in one place.
        """
        self.tolerances = tolerances
        self._build(list(boxes))

    # What is there

    def __len__(self) -> int:
        """How many boxes there are."""
        return len(self._slots)

    def __contains__(self, box: object) -> bool:
        """Whether a box of that name is there."""
        return box in self._slots

    def __iter__(self) -> Iterator[Perceived]:
        """The boxes, in no promised order."""
        return (box for box in self._boxes if box is not None)

    def __getitem__(self, box: BoxId) -> Perceived:
        """The box of that name.

        Raises:
            PileError: there is none.
        """
        return self.at(self._slot(box))

    @property
    def edges(self) -> int:
        """How many edges there are."""
        return int(self._links.free[1])

    @property
    def nbytes(self) -> int:
        """The memory of the arrays [bytes]."""
        return sum(array.nbytes for array in self._links) + self._prisms.nbytes

    def blockers(self, box: BoxId) -> frozenset[Blocker]:
        """The boxes that block a box directly.

        Raises:
            PileError: there is no such box.
        """
        slots, relations = blockers_of(self._links, self._slot(box))
        return frozenset(
            Blocker(self.at(slot).id, Relation(relation))
            for slot, relation in zip(slots.tolist(), relations.tolist(), strict=True)
        )

    def reachable(self, box: BoxId) -> frozenset[BoxId]:
        """T(b): every box that must leave before the box can, itself included.

        Raises:
            PileError: there is no such box.
        """
        slots = len(self._boxes)
        marked, stack = np.zeros(slots, np.bool_), np.empty(slots, np.int32)
        found = mark_reachable(self._links, self._slot(box), marked, stack)
        return frozenset(self.at(slot).id for slot in stack[:found].tolist())

    def leaves(self) -> frozenset[BoxId]:
        """The boxes that nothing blocks."""
        return frozenset(
            self.at(slot).id for slot in np.flatnonzero(self._links.blockers == 0).tolist()
        )

    def cycle(self) -> tuple[BoxId, ...]:
        """One cycle of G, each box blocked by the next and the last by the first; or nothing.

        The same boxes give the same cycle whatever their names and order: it is the one met
        first from the first box by geometry, and starts at its own first box by geometry.
        """
        slots = find_cycle(self._links, self._prisms)
        return tuple(self.at(slot).id for slot in slots)

    # What the selection works on: boxes in numbered slots

    @property
    def links(self) -> Links:
        """The edges between slots; for reading."""
        return self._links

    @property
    def prisms(self) -> Array:
        """(slots, 8), one prism per slot, any numbers in empty slots; for reading."""
        return self._prisms

    @property
    def used_slots(self) -> npt.NDArray[np.intp]:
        """The slots that hold a box, rising."""
        return np.flatnonzero(self._links.blockers != EMPTY)

    def at(self, slot: int) -> Perceived:
        """The box in a slot.

        Raises:
            LookupError: the slot is empty.
        """
        box = self._boxes[slot]
        if box is None:
            raise LookupError(slot)
        return box

    def by_slot(self) -> tuple[Perceived | None, ...]:
        """(slots,) what is in each slot now, None where it is empty."""
        return tuple(self._boxes)

    def slot_of(self, box: BoxId) -> int | None:
        """The slot of a box, or None when it is not perceived."""
        return self._slots.get(box)

    def geometric_rank(self) -> npt.NDArray[np.int64]:
        """(slots,) where each slot's box stands in the order that settles ties."""
        return geometric_rank(self._prisms)

    def removals(self, slot: int) -> tuple[int, int]:
        """|T(b)| - 1 of the box in a slot, which no order under G can undercut; twice."""
        slots = len(self._boxes)
        marked, stack = np.zeros(slots, np.bool_), np.empty(slots, np.int32)
        count = int(mark_reachable(self._links, slot, marked, stack)) - 1
        return count, count

    def ahead(self, aims: Sequence[Aim]) -> tuple[frozenset[int], ...]:  # noqa: ARG002
        """None: by the paper the score alone decides."""
        return ()

    # What changes

    def add(self, box: Perceived) -> None:
        """A box has come into view.

        Raises:
            PileError: its name is taken, or another box is in its place.
        """
        if box.id in self._slots:
            raise _taken(box.id)
        if not self._free_slots:
            self._grow()
        slot = self._free_slots[-1]
        self._place(slot, box)
        self._free_slots.pop()
        self._slots[box.id] = slot

    def remove(self, box: BoxId) -> None:
        """A box has left.

        Raises:
            PileError: there is no such box.
        """
        slot = self._slot(box)
        remove(self._links, slot)
        del self._slots[box]
        self._boxes[slot] = None
        self._free_slots.append(slot)

    def move(self, box: Perceived) -> None:
        """A box is seen at another pose, with another size, or newly recognised.

        Raises:
            PileError: there is no such box, or another box is in its place.
        """
        slot = self._slot(box.id)
        if self.at(slot).shape == box.shape:
            self._boxes[slot] = box
        else:
            self._place(slot, box)

    def update(self, boxes: Iterable[Perceived]) -> None:
        """Brings the graph to what is perceived now; only what differs is worked on.

        Raises:
            PileError: a name twice, or two boxes in one place; the graph is as it was.
        """
        now: dict[BoxId, Perceived] = {}
        for box in boxes:
            if now.setdefault(box.id, box) is not box:
                raise _taken(box.id)
        before = list(self)
        for box in before:
            if box.id not in now or now[box.id].shape != box.shape:
                self.remove(box.id)
        try:
            for box in now.values():
                if box.id in self._slots:
                    self.move(box)
                else:
                    self.add(box)
        except PileError:
            self._build(before)
            raise

    # How it is kept

    def _build(self, boxes: list[Perceived]) -> None:
        self._boxes: list[Perceived | None] = [*boxes]
        self._slots: dict[BoxId, int] = {}
        self._free_slots: list[int] = []
        for slot, box in enumerate(boxes):
            if self._slots.setdefault(box.id, slot) != slot:
                raise _taken(box.id)
        self._prisms = prisms_of(box.shape for box in boxes)
        unsound = first_unsound(self._prisms, 0, len(boxes))
        if unsound != NONE:
            raise _no_box(boxes[unsound])
        self._links, (a, b) = link_prisms(self._prisms, self.tolerances)
        if a != BUILT:
            raise _in_one_place(boxes[a], boxes[b])

    def _slot(self, box: BoxId) -> int:
        try:
            return self._slots[box]
        except KeyError:
            exists = did_you_mean(str(box), map(str, self._slots))
            problem = Problem("pile", f"no box {box!r} is perceived", exists=exists)
            raise PileError("", [problem]) from None

    def _place(self, slot: int, box: Perceived) -> None:
        before = self._prisms[slot].copy()
        self._prisms[slot] = prism_of(box.shape)
        if first_unsound(self._prisms, slot, slot + 1) != NONE:
            self._prisms[slot] = before
            raise _no_box(box)
        codes = np.empty(len(self._boxes), np.int32)
        overlap, slack = self.tolerances.overlap, self.tolerances.slack
        edges = relate_to_all(self._prisms, slot, self._links, overlap, slack, codes)
        if edges == NONE:
            self._prisms[slot] = before
            raise _in_one_place(self.at(int(np.flatnonzero(codes == CLASH)[0])), box)
        room = len(self._links.edges)
        if edges > room - self.edges:
            self._links = self._links.grown(len(self._boxes), 2 * room + edges)
        unlink(self._links, slot)
        self._boxes[slot] = box
        link_one(self._links, slot, codes)

    def _grow(self) -> None:
        old = len(self._boxes)
        new = max(_SMALLEST, 2 * old)
        self._links = self._links.grown(new, len(self._links.edges))
        prisms = np.zeros((new, PRISM_WIDTH))
        prisms[:old] = self._prisms
        self._prisms = prisms
        self._boxes.extend([None] * (new - old))
        self._free_slots.extend(range(new - 1, old - 1, -1))


def _taken(name: BoxId) -> PileError:
    what = f"two boxes are called {name!r}"
    return PileError("", [Problem("pile", what, "a name of its own for every box")])


def _in_one_place(first: Perceived, second: Perceived) -> PileError:
    x, y, z = second.shape.centre
    names = sorted((str(first.id), str(second.id)))
    what = f"boxes {names[0]!r} and {names[1]!r} are in one place"
    where = f"pile at ({x:.3f}, {y:.3f}, {z:.3f}) m"
    return PileError("", [Problem(where, what, "boxes that stand beside each other")])


def _no_box(box: Perceived) -> PileError:
    what = f"box {box.id!r} has centre {box.shape.centre} and size {box.shape.size}"
    return PileError("", [Problem("pile", what, "finite numbers, sizes above 0 m")])
