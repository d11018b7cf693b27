"""Holds what the cell believes against the truth of a light world, after every change of either."""

import itertools
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from depal.cell.departures import Departure, Fate
from depal.cell.workplace import Workplace
from depal.domain import BoxId
from depal.executive import events as ev
from depal.simulation.light import FLOOR, HAND, PALLET, REMOVED, LightBox, LightCell
from depal.simulation.witness import name_of

STILL = 3_600.0
"""Nothing may stand still for longer than this [s]: no person takes so long (I6)."""

SPARE = 1e-6
"""A box leaves the pallet once: two ends that name other times are two [s]."""

SEAM = 0.002
"""Boxes in one place that overlap by more than this are in one slot [m]."""


@dataclass(frozen=True, slots=True)
class Count:
    """What became of the boxes of a run, by the referee.

    Attributes:
        boxes: how many there were.
        stored: in the place that the books and the store's system name.
        aside: set aside.
        by_person: taken by a person.
        dropped: fallen, known to have, and taken from the floor.
        left: still on the pallet, and known to be.
        lost: whose whereabouts the books do not tell, or tell wrongly without having stored them.
        doubled: placed twice, told twice or ended twice.
        misplaced: that the books call stored and that stand elsewhere, or are something else.
    """

    boxes: int = 0
    stored: int = 0
    aside: int = 0
    by_person: int = 0
    dropped: int = 0
    left: int = 0
    lost: int = 0
    doubled: int = 0
    misplaced: int = 0

    def __add__(self, other: "Count") -> "Count":
        """Both together."""
        mine, its = _numbers(self), _numbers(other)
        return Count(*(a + b for a, b in zip(mine, its, strict=True)))


def _numbers(count: Count) -> tuple[int, ...]:
    return (
        count.boxes, count.stored, count.aside, count.by_person, count.dropped, count.left,
        count.lost, count.doubled, count.misplaced,
    )  # fmt: skip


class Referee:
    """Knows the truth, whichever controller is at work.

    Attributes:
        wrongs: every breach of an invariant, once each, in words.
        steps: how often it has looked.
    """

    def __init__(self, cell: LightCell) -> None:
        """Nothing has happened."""
        self._cell = cell
        self._work: Workplace | None = None
        self._said: set[str] = set()
        self._ended: dict[BoxId, Departure] = {}
        self._served: dict[str, BoxId | None] = {}
        self._asked = 0
        self._moved = 0.0
        self._twice: set[BoxId] = set()
        self.wrongs: list[str] = []
        self.steps = 0
        cell.world.listen(self.look)

    def watch(self, work: Workplace) -> None:
        """Another controller has begun."""
        self._work = work

    def heard(self, _: int, __: Sequence[ev.Event]) -> None:
        """A step of the executive."""
        self.look()

    def _breach(self, what: str) -> None:
        if what not in self._said:
            self._said.add(what)
            self.wrongs.append(f"{self._cell.clock.now():.1f} s: {what}")

    def look(self) -> None:
        """Every invariant that holds at any time."""
        self.steps += 1
        work = self._work
        if work is None:
            return
        self._hand(work)
        self._places()
        self._ends(work)
        self._requests(work)
        self._progress()

    def _hand(self, work: Workplace) -> None:
        """I2: where the product is known, which tells what one box weighs, one hangs there."""
        held = self._cell.world.held
        if work.held is not None and len(held) > 1 and work.product_of(work.held.box):
            self._breach(f"I2: {len(held)} boxes in the hand: {_names(held)}")

    def _places(self) -> None:
        """I2, I3: no two boxes in one slot, none put anywhere twice."""
        for box in self._cell.world.boxes:
            if len(box.placed) > 1:
                self._breach(f"I3: {name_of(box.index)} was placed {len(box.placed)} times")
        standing = [box for box in self._cell.world.boxes if "/" in box.where]
        for one, other in itertools.combinations(standing, 2):
            if one.where == other.where and _overlap(one, other):
                names = _names((one.index, other.index))
                self._breach(f"I2: {names} are in one slot of {one.where}")

    def _ends(self, work: Workplace) -> None:
        """I1, I3, I4: what the books say of a box that has ended is so, and stays said."""
        for departure in work.departures.sequence:
            before = self._ended.setdefault(departure.box, departure)
            if (before.fate, before.place) != (departure.fate, departure.place):
                self._breach(
                    f"I3: {departure.box} has ended as {before.fate.value} and as "
                    f"{departure.fate.value}"
                )
            if abs(before.at - departure.at) > SPARE:
                self._twice.add(departure.box)
                self._breach(f"I3: {departure.box} has ended twice")
            why = self._untrue(departure)
            if why is not None:
                self._breach(f"I1, I4: {departure.box} is {departure.fate.value}: {why}")

    def _untrue(self, departure: Departure) -> str | None:
        """What is wrong with a departure."""
        box = self._meant(departure.box)
        if box is None:
            return "there is no such box"
        place = str(departure.place)
        match departure.fate:
            case Fate.STORED | Fate.SET_ASIDE:
                if _last_place(box) != place:
                    return f"booked in {place}, it is at {_last_place(box)}"
                if departure.fate is Fate.STORED and departure.gtin != box.gtin:
                    return f"booked as {departure.gtin}, it is {box.gtin}"
            case Fate.BY_PERSON if box.where != REMOVED:
                return f"it is at {box.where}"
            case Fate.LOST if box.where == HAND and len(self._cell.world.held) == 1:
                return "it is in the hand"
            case _:
                pass
        return None

    def _meant(self, name: BoxId) -> LightBox | None:
        boxes = self._cell.world.boxes
        index = self._cell.deeds.meant.get(name)
        if index is not None:
            return boxes[index]
        return next((box for box in boxes if name_of(box.index) == name), None)

    def _requests(self, work: Workplace) -> None:
        """I8: a request that a box has served, whose end is known, has ended for good."""
        for wish in work.wishes:
            before = self._served.get(wish.key)
            if before is not None and wish.box != before:
                self._breach(f"I8: request {wish.key} was served by {before} and by {wish.box}")
            if wish.box is not None and work.departures.has_ended(wish.box):
                self._served[wish.key] = wish.box
        serving = Counter(wish.box for wish in work.wishes if wish.box is not None)
        for box, count in serving.items():
            if count > 1:
                self._breach(f"I8: {box} serves {count} requests")

    def _progress(self) -> None:
        """I6: something moves, or a person is asked."""
        now, world = self._cell.clock.now(), self._cell.world
        if now - max(self._moved, world.changed) > STILL:
            self._breach("I6: nothing has moved for an hour")
        if world.motions != self._asked:
            self._asked, self._moved = world.motions, now

    def at_rest(self, motions: int) -> None:
        """I7: a controller that was started anew has moved nothing before a person said start."""
        if self._cell.world.motions != motions:
            self._breach("I7: the arm moved before a person said start")

    def no_end(self, why: str) -> None:
        """I6: the run has not ended."""
        self._breach(f"I6: {why}")

    # At the end

    def count(self) -> Count:
        """Every box, once."""
        self.look()
        work = self._work
        if work is None:
            return Count()
        total = Count()
        there = {box.id for box in work.pile.boxes}
        doubled = self._doubled()
        ends = {
            box.index: departure
            for departure in work.departures.sequence
            if (box := self._meant(departure.box)) is not None
        }
        for box in self._cell.world.boxes:
            total += self._one(box, ends.get(box.index), name_of(box.index) in there)
            total += Count(doubled=int(box.index in doubled))
        return total

    def _one(self, box: LightBox, end: Departure | None, believed: bool) -> Count:  # noqa: FBT001
        if end is None:
            known = box.where == PALLET and believed
            if not known:
                self._breach(f"I1: {name_of(box.index)} is at {box.where}, and nobody knows")
            return Count(boxes=1, left=int(known), lost=int(not known))
        wrong = self._untrue(end) is not None
        if end.fate is Fate.LOST and box.where not in {FLOOR, REMOVED}:
            wrong = True
            self._breach(f"I1: {end.box} counts as fallen, it is at {box.where}")
        if wrong:
            stored = end.fate is Fate.STORED
            return Count(boxes=1, lost=int(not stored), misplaced=int(stored))
        return Count(
            boxes=1,
            stored=int(end.fate is Fate.STORED),
            aside=int(end.fate is Fate.SET_ASIDE),
            by_person=int(end.fate is Fate.BY_PERSON),
            dropped=int(end.fate is Fate.LOST),
        )

    def _doubled(self) -> set[int]:
        """Boxes that were placed twice, or that the store was told of twice under two names."""
        told = Counter(movement.box for movement in self._cell.store.movements.values())
        out = {box.index for box in self._cell.world.boxes if len(box.placed) > 1}
        for name, times in told.items():
            box = self._meant(name)
            if times > 1 and box is not None:
                self._breach(f"I3: the store was told {times} times of {name}")
                out.add(box.index)
        ended = Counter(
            box.index
            for departure in self._ended.values()
            if (box := self._meant(departure.box)) is not None
        )
        out |= {index for index, times in ended.items() if times > 1}
        for name in self._twice:
            box = self._meant(name)
            if box is not None:
                out.add(box.index)
        self._told()
        return out

    def _told(self) -> None:
        """The store's system knows exactly the boxes that the books call stored."""
        work = self._work
        if work is None:
            return
        stored = {d.box: d for d in work.departures.sequence if d.fate is Fate.STORED}
        told = {movement.box: movement for movement in self._cell.store.movements.values()}
        for name in sorted({*stored, *told}):
            if name not in told:
                self._breach(f"I1: the store was not told of {name}")
            elif name not in stored:
                self._breach(f"I1: the store was told of {name}, which is not stored")
            elif told[name].place != stored[name].place:
                self._breach(f"I4: the store was told another place of {name}")


def _last_place(box: LightBox) -> str:
    """Where a box is; of one that was carried off with its trolley, where it had been put."""
    return str(box.placed[-1]) if box.where == REMOVED and box.placed else box.where


def _names(indices: Iterable[int]) -> str:
    return " and ".join(name_of(index) for index in indices)


def _overlap(one: LightBox, other: LightBox) -> bool:
    return all(
        min(one.high[k], other.high[k]) - max(one.low[k], other.low[k]) > SEAM for k in range(3)
    )
