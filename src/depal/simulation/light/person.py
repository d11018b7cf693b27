"""The worker beside a light world, who ends what was begun though the controller has ended."""

import asyncio

from depal.domain import BoxId, StorageKind
from depal.ports import TAKEN, Question
from depal.simulation.light.devices import Seat
from depal.simulation.light.world import FLOOR, HAND, PALLET, REMOVED, LightBox
from depal.simulation.witness import name_of

DELAY = (10.0, 30.0)
"""The worker comes after so long, at the least and at the most [s]."""

EXCHANGE = 30.0
"""A bay is empty for so long [s]."""

ARM = "arm"
"""What questions are about that are about whatever hangs on the arm."""

PRODUCT, RESTART = "product/", "restart/"
"""How questions after a product begin, and those of a controller that was started anew."""

AT_PALLET = ("take/", "missing/")
"""How questions begin that send the worker to the pallet: only there the box is looked for."""


class Deeds:
    """What the worker has begun; it goes on whatever becomes of the controller.

    Attributes:
        asked: every question that was put, with its answer.
        meant: boxes that names mean which are not the sight's own, by their index in the stack.
    """

    def __init__(self) -> None:
        """Nothing is begun."""
        self.asked: list[tuple[float, Question, str]] = []
        self.meant: dict[BoxId, int] = {}
        self.trolleys = 0
        self._tasks: set[asyncio.Task[None]] = set()

    @property
    def tasks(self) -> frozenset[asyncio.Task[None]]:
        """What goes on."""
        return frozenset(self._tasks)

    def begin(self, task: asyncio.Task[None]) -> None:
        """The worker does this to its end."""
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)


class LightPerson:
    """Answers what is so and does what the answer promises."""

    def __init__(self, seat: Seat, deeds: Deeds) -> None:
        """Asked by one controller.

        Args:
            seat: of that controller.
            deeds: of the worker, whoever has asked for them.
        """
        self._seat, self._deeds = seat, deeds

    async def ask(self, question: Question) -> str:
        """Asks, waits for the worker, and for what the worker does."""
        seat = self._seat
        seat.life.check()
        await asyncio.sleep(float(seat.random.uniform(*DELAY)))
        seat.life.check()
        answer = self.what_is_so(question)
        self._deeds.asked.append((seat.now, question, answer))
        doing = asyncio.get_running_loop().create_task(self._does(question, answer))
        self._deeds.begin(doing)
        await asyncio.shield(doing)
        seat.life.check()
        return answer

    def what_is_so(self, question: Question) -> str:
        """The choice that is true."""
        world = self._seat.world
        world.advance(self._seat.now)
        first, last = question.choices[0], question.choices[-1]
        box = self._meant(question)
        if question.id.startswith(PRODUCT):
            read = None if box is None else str(box.gtin)
            return read if read in question.choices else last
        if question.about == ARM:
            return first
        if question.id.startswith(RESTART):
            return last if box is None else self._where(box, question.choices)
        return last if first == TAKEN and box is None else first

    def _where(self, box: LightBox, choices: tuple[str, ...]) -> str:
        """Hanging, standing in its place, on the pallet, or nowhere that the arm can go on from."""
        hangs, *stands, pallet, taken = choices
        if box.where == HAND:
            if self._seat.world.hangs(box.index):
                return hangs
            if self._seat.world.stands_over(box.index) == PALLET:
                return pallet
            return stands[0] if stands else hangs  # the cups hold it all the same
        if box.where == PALLET:
            return pallet
        return taken if box.where in {FLOOR, REMOVED} or not stands else stands[0]

    def _meant(self, question: Question) -> LightBox | None:
        """The box that a question is about, where it still is in the cell."""
        world, name = self._seat.world, BoxId(question.about)
        there = [box for box in world.boxes if box.where != REMOVED]
        if question.id.startswith(AT_PALLET):
            there = [box for box in there if box.where in {PALLET, FLOOR}]
        named = next((box for box in there if name_of(box.index) == name), None)
        if named is not None or question.gtin is None:
            return named
        known = set(self._deeds.meant.values())
        lost = [
            box
            for box in there
            if box.gtin == question.gtin and box.where in {PALLET, FLOOR} and box.index not in known
        ]
        return next(iter(sorted(lost, key=lambda box: box.where != PALLET)), None)

    async def _does(self, question: Question, answer: str) -> None:
        world, now = self._seat.world, self._seat.now
        about, box = question.about, self._meant(question)
        kinds = {each.id: each.kind for each in world.layout.storages}
        if kinds.get(about) is StorageKind.TROLLEY:
            if answer == question.choices[0]:
                world.take_trolley(about, now)
                await asyncio.sleep(EXCHANGE)
                self._deeds.trolleys += 1
                world.bays[about] = f"{about}#{self._deeds.trolleys + 1}"
        elif about == ARM and answer == TAKEN:
            world.empty_hand(now)
        elif box is not None and answer == TAKEN and box.where == HAND:
            self._deeds.meant[BoxId(about)] = box.index
            world.empty_hand(now)  # whatever hangs there
        elif box is not None and (answer == TAKEN or box.where == FLOOR):
            self._deeds.meant[BoxId(about)] = box.index
            world.take_away(box.index, now)
