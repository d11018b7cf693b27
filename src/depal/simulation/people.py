"""The simulated worker: answers questions, exchanges trolleys, picks boxes up from the floor."""

import asyncio
from collections.abc import Callable

import numpy as np

from depal.domain import BoxId, StorageKind
from depal.executive.clock import Clock
from depal.geometry import Pose
from depal.ports import TAKEN, Question
from depal.simulation.model import PARKING
from depal.simulation.referee import ELSEWHERE, FLOOR, PALLET, Referee
from depal.simulation.witness import Witness
from depal.simulation.world import World

Policy = Callable[[Question], str]
"""Which choice the worker picks."""

PRODUCT = "product/"
"""How questions after the product of a box begin."""


class SimulatedPerson:
    """A worker who comes after a while and does what the answer promises.

    The answer to a question about a trolley that is the first of its choices means that the
    trolley is exchanged; `TAKEN` means that the box is taken away, wherever it is. A box on the
    floor that a question is about is picked up in any case. Who is asked for a product reads the
    box; who is asked for a box that is not there says so.
    """

    def __init__(
        self,
        world: World,
        clock: Clock,
        policy: Policy | None = None,
        mean_delay: float = 20.0,
        exchange_time: float = 30.0,
    ) -> None:
        """The worker beside this world.

        Args:
            world: in which things are moved.
            clock: the loop's time.
            policy: picks the answers; None for what is so.
            mean_delay: until the worker comes [s]; half of it to one and a half times it.
            exchange_time: a bay is empty for this long [s].
        """
        self._world, self._clock, self._policy = world, clock, policy
        self._mean, self._exchange_time = mean_delay, exchange_time
        self._referee = Referee(world)
        self.witness = Witness(world)
        self._random = np.random.default_rng([world.seed, 2])
        self._trolleys = 0
        self.asked: list[tuple[float, Question, str]] = []

    async def ask(self, question: Question) -> str:
        """Asks and waits for as long as it takes; returns one of the choices."""
        answer = self.what_is_so(question) if self._policy is None else self._policy(question)
        self.asked.append((self._clock.now(), question, answer))
        pointed_at = self._meant(question)
        await asyncio.sleep(self._mean * float(self._random.uniform(0.5, 1.5)))
        await self.does(question, answer, pointed_at)
        return answer

    async def does(self, question: Question, answer: str, pointed_at: int | None = None) -> None:
        """Does in the world what an answer promises.

        Args:
            question: what was asked.
            answer: one of its choices.
            pointed_at: the box that the question meant when it was asked, by its index in the
                stack: it is taken wherever it has slid or fallen since.
        """
        self._world.advance(self._clock.now())
        if self._is_trolley(question.about) and answer == question.choices[0]:
            await self._exchange(question.about)
            return
        meant = self._meant(question)
        self._pick_up(question, pointed_at if meant is None else meant, anywhere=answer == TAKEN)

    def what_is_so(self, question: Question) -> str:
        """What is asked, where it can be done; what is read, where that is a choice."""
        self._world.advance(self._clock.now())
        first, last = question.choices[0], question.choices[-1]
        if question.id.startswith(PRODUCT):
            box = self._meant(question)
            read = None if box is None else str(self._world.cases[box].gtin)
            return read if read in question.choices else last
        if first == TAKEN and self._meant(question) is None:
            return last
        return first

    def _meant(self, question: Question) -> int | None:
        """The box that a question is about, where there is one."""
        found = self.witness.find(BoxId(question.about), question.at)
        if found is not None or question.gtin is None:
            return found
        known = set(self.witness.indices.values())
        there = {
            case.index: self._referee.where(case.index)
            for case in self._world.cases
            if case.gtin == question.gtin and case.index not in known
        }
        lying = [index for index, where in there.items() if where in {FLOOR, ELSEWHERE}]
        return next(iter([index for index in there if there[index] == PALLET] + lying), None)

    def _is_trolley(self, name: str) -> bool:
        storages = self._world.layout.storages
        return any(s.id == name and s.kind is StorageKind.TROLLEY for s in storages)

    async def _exchange(self, bay: str) -> None:
        """Takes the trolley with its boxes away and brings an empty one."""
        inside = f"{bay}/"
        for truth in self._referee.boxes():
            if truth.where.startswith(inside):
                self.take_away(truth.index)
        self._world.show_storage(bay, trolley=None)
        await asyncio.sleep(self._exchange_time)
        self._world.advance(self._clock.now())
        self._trolleys += 1
        self._world.show_storage(bay, trolley=f"{bay}#{self._trolleys + 1}")

    def _pick_up(self, question: Question, index: int | None, *, anywhere: bool) -> None:
        if index is None or index in self._world.removed:
            return
        if anywhere or self._referee.where(index) in {FLOOR, ELSEWHERE}:
            self.witness.means(BoxId(question.about), index)
            self.take_away(index)

    def take_away(self, index: int) -> None:
        """Takes a box out of the cell, wherever it is."""
        x, y = PARKING
        height = self._world.cases[index].shape.size[2]
        self._world.removed.append(index)
        self._world.place_box(index, Pose((x + index % 10, y + index // 10, height / 2)))
