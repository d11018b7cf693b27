"""The work that the executive is measured on: boxes stored one after the other, for ever."""

import math
import time
from collections import OrderedDict
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from itertools import count
from pathlib import Path

from depal.executive.commands import Start
from depal.executive.conditions import Key, Value
from depal.executive.engine import Call, Engine, Report, Step
from depal.executive.events import Change
from depal.executive.language import read_tasks
from depal.executive.schema import Action, Repository

BEAT = 0.5
"""Time between two inputs [s]."""

PLACE = "trolley_1"
"""Where every box goes."""

SEEN = "on_the_pallet"
"""A box that the camera sees and nobody stores yet."""


def store_tasks() -> Repository:
    """The paper's running example, as it ships."""
    return read_tasks(Path(str(files("depal.cell.tasks") / "store.task")))


def effect(action: str, box: str, facts: Mapping[Key, Value]) -> tuple[Change, ...]:
    """What an action of the store task changes when all goes well."""
    changes: dict[str, tuple[Change, ...]] = {
        "kr60_reach": (("kr60.at", box),),
        "kr60_grasp": ((f"{box}.taken", True),),
        "kr60_show": (("kr60.at", "reader"),),
        "read_barcode": ((f"{box}.known", True),),
        "ask_target": ((f"{box}.target", PLACE),),
        "kr60_carry": (("kr60.at", facts.get(f"{box}.target")),),
        "kr60_release": ((f"{box}.taken", False), (f"{box}.stored", True), ("kr60.at", None)),
    }
    return changes[action]


def actions_of(repository: Repository) -> list[Action]:
    """The primitives that a repository declares."""
    return [schema for schema in repository.schemata.values() if isinstance(schema, Action)]


@dataclass(frozen=True, slots=True)
class Timed:
    """One input of an engine.

    Attributes:
        step: what it has led to.
        seconds: how long the engine took [s].
        allocation: whether it was an allocation.
    """

    step: Step
    seconds: float
    allocation: bool


def percentile(values: Sequence[float], percent: int) -> float:
    """The value that so many percent of the values do not exceed.

    Args:
        values: at least one.
        percent: 1 to 100.
    """
    return sorted(values)[math.ceil(len(values) * percent / 100) - 1]


class Shift:
    """An engine that always has the same number of stores to do.

    One primitive ends, then a fact from outside changes, and so on. Of the facts from outside,
    one half is about a store that waits (its box falls to the floor, then is picked up) and one
    half about a box that nobody stores yet. A store that is done makes room for a new one.

    Attributes:
        engine: at work.
    """

    def __init__(self, stores: int) -> None:
        """Nothing is allocated yet; there will be `stores` stores."""
        self.engine = Engine(store_tasks())
        self._stores = stores
        self._names = (f"b{number}" for number in count(1))
        self._running: dict[int, tuple[str, str]] = {}
        self._waiting: OrderedDict[str, None] = OrderedDict()
        self._now = 0.0

    def inputs(self) -> Iterator[Timed]:
        """Allocates the stores, then works; never ends."""
        while True:
            yield from self._end_one()
            waiting = self._next_waiting()
            yield self._change(f"{waiting}.on_floor", value=True)
            yield from self._end_one()
            yield self._change(f"{SEEN}.known", value=True)
            yield from self._end_one()
            yield self._change(f"{waiting}.on_floor", value=False)
            yield from self._end_one()
            yield self._change(f"{SEEN}.known", value=False)

    def _allocate(self) -> Timed:
        box = next(self._names)
        self._waiting[box] = None
        calls = [Call("store", (box,))]
        return self._timed(lambda at: self.engine.allocate(calls, at), allocation=True)

    def _end_one(self) -> Iterator[Timed]:
        """Fills up the stores, then has the oldest of the primitives that run do its work."""
        while len(self.engine.state.trees) < self._stores:
            yield self._allocate()
        attempt = next(iter(self._running))
        action, box = self._running.pop(attempt)
        report = Report(effect(action, box, self.engine.state.facts))
        yield self._timed(lambda at: self.engine.report(attempt, report, at))

    def _change(self, key: Key, *, value: Value) -> Timed:
        return self._timed(lambda at: self.engine.change([(key, value)], "camera", at))

    def _timed(self, decide: Callable[[float], Step], *, allocation: bool = False) -> Timed:
        self._now += BEAT
        start = time.perf_counter()
        step = decide(self._now)
        seconds = time.perf_counter() - start
        for command in step.commands:
            if isinstance(command, Start):
                action, box = command.action.name, command.args[0]
                self._running[command.attempt] = (action, box)
                self._waiting.pop(box, None)
        return Timed(step, seconds, allocation)

    def _next_waiting(self) -> str:
        """The next box of which nothing has begun; one that nobody stores if there is none."""
        if not self._waiting:
            return SEEN
        box = next(iter(self._waiting))
        self._waiting.move_to_end(box)
        return box
