"""The simulated worker: answers questions, exchanges trolleys, picks boxes up from the floor."""

import asyncio
from collections.abc import Callable

import numpy as np

from depal.domain import BoxId, StorageKind
from depal.executive.clock import Clock
from depal.geometry import Pose
from depal.ports import TAKEN, Question
from depal.simulation.referee import ELSEWHERE, FLOOR, Referee
from depal.simulation.world import World

Policy = Callable[[Question], str]
"""Which choice the worker picks."""

PARKING = (40.0, 0.0)
"""Where boxes are put that people took away: far outside the cell [m]."""


def first_choice(question: Question) -> str:
    """The worker does what is asked."""
    return question.choices[0]


def name_of(index: int) -> BoxId:
    """What a box of the stack is called in the simulated cell: b1 is the first."""
    return BoxId(f"b{index + 1}")


def index_of(name: str, boxes: int) -> int | None:
    """The index of a box in a stack of so many by its name; None where there is no such box."""
    number = name.removeprefix("b")
    known = name.startswith("b") and number.isdecimal() and 0 < int(number) <= boxes
    return int(number) - 1 if known else None


class SimulatedPerson:
    """A worker who comes after a while and does what the answer promises.

    The answer to a question about a trolley that is the first of its choices means that the
    trolley is exchanged; `TAKEN` means that the box is taken away, wherever it is. A box on the
    floor that a question is about is picked up in any case.
    """

    def __init__(
        self,
        world: World,
        clock: Clock,
        policy: Policy = first_choice,
        mean_delay: float = 20.0,
        exchange_time: float = 30.0,
    ) -> None:
        """The worker beside this world.

        Args:
            world: in which things are moved.
            clock: the loop's time.
            policy: picks the answers.
            mean_delay: until the worker comes [s]; half of it to one and a half times it.
            exchange_time: a bay is empty for this long [s].
        """
        self._world, self._clock, self._policy = world, clock, policy
        self._mean, self._exchange_time = mean_delay, exchange_time
        self._referee = Referee(world)
        self._random = np.random.default_rng([world.seed, 2])
        self._trolleys = 0
        self.asked: list[tuple[float, Question, str]] = []

    async def ask(self, question: Question) -> str:
        """Asks and waits for as long as it takes; returns one of the choices."""
        answer = self._policy(question)
        self.asked.append((self._clock.now(), question, answer))
        await asyncio.sleep(self._mean * float(self._random.uniform(0.5, 1.5)))
        self._world.advance(self._clock.now())
        if self._is_trolley(question.about) and answer == question.choices[0]:
            await self._exchange(question.about)
        else:
            self._pick_up(question.about, anywhere=answer == TAKEN)
        return answer

    def _is_trolley(self, name: str) -> bool:
        storages = self._world.layout.storages
        return any(s.id == name and s.kind is StorageKind.TROLLEY for s in storages)

    async def _exchange(self, bay: str) -> None:
        """Takes the trolley with its boxes away and brings an empty one."""
        inside = f"{bay}/"
        for truth in self._referee.boxes():
            if truth.where.startswith(inside):
                self._take_away(truth.index)
        self._world.show_storage(bay, trolley=None)
        await asyncio.sleep(self._exchange_time)
        self._world.advance(self._clock.now())
        self._trolleys += 1
        self._world.show_storage(bay, trolley=f"{bay}#{self._trolleys + 1}")

    def _pick_up(self, name: str, *, anywhere: bool) -> None:
        index = index_of(name, len(self._world.cases))
        if index is None or index in self._world.removed:
            return
        if anywhere or self._referee.where(index) in {FLOOR, ELSEWHERE}:
            self._take_away(index)

    def _take_away(self, index: int) -> None:
        x, y = PARKING
        height = self._world.cases[index].shape.size[2]
        self._world.removed.append(index)
        self._world.place_box(index, Pose((x + index % 10, y + index // 10, height / 2)))
