"""The same stores with a behaviour tree library and with a planner, where they are installed."""

import io
import time
from collections.abc import Callable
from contextlib import redirect_stdout
from importlib import import_module
from itertools import count, islice
from statistics import median
from types import ModuleType
from typing import Any, Protocol

from depal.executive.conditions import Key, Value
from depal.executive.schema import Task
from depal.studies.bench.executive_work import actions_of, effect, store_tasks
from depal.studies.bench.figure import median_seconds

_PLANS = 50


def py_trees_tick(stores: int, ticks: int) -> float | None:
    """What an event costs an executive that ticks a py_trees tree for each store.

    Args:
        stores: how many trees there are.
        ticks: how often all of them are ticked, each after one more action has ended.

    Returns:
        The median time of a tick of all trees [s], or None where py_trees is not installed.
    """
    library = imported("py_trees")
    return None if library is None else median_tick(Forest(library, stores), ticks)


class Ticked(Protocol):
    """Trees that look at all facts whenever something may have changed."""

    def tick(self) -> None:
        """Ticks every tree once, the oldest first."""

    def end_one(self) -> None:
        """The primitive that runs has done what it is for; a store that is done is replaced."""


def median_tick(forest: Ticked, ticks: int) -> float:
    """The median time of a tick of all trees, each after one more action has ended [s]."""
    seconds = []
    for _ in range(ticks):
        forest.end_one()
        start = time.perf_counter()
        forest.tick()
        seconds.append(time.perf_counter() - start)
    return median(seconds)


def gtpyhop_plan(boxes: int) -> float | None:
    """What it takes GTPyhop to plan the stores of some boxes.

    Returns:
        The median time [s], or None where GTPyhop is not installed.
    """
    plan = gtpyhop_planner(boxes)
    if plan is None:
        return None
    with redirect_stdout(io.StringIO()):
        return median_seconds(plan, _PLANS)


class Forest:
    """One py_trees tree for each store, on the same facts, with one arm for all of them.

    Attributes:
        facts: what is the case.
        stored: how many stores were done.
        running: the action that runs, and its box.
    """

    def __init__(self, library: ModuleType, stores: int) -> None:
        """Builds the trees."""
        self.facts: dict[Key, Value] = {}
        self.stored = 0
        self._status = library.common.Status
        self._behaviour = library.behaviours.Running
        self._sequence = library.composites.Sequence
        self._selector = library.composites.Selector
        self._names = (f"b{number}" for number in count(1))
        self._trees = {name: self._store(name) for name in islice(self._names, stores)}
        self.running = ("", "")
        self._arm: str | None = None
        self.tick()

    def tick(self) -> None:
        """Ticks every tree once, the oldest first."""
        for tree in self._trees.values():
            tree.tick_once()

    def end_one(self) -> None:
        """The primitive that runs has done what it is for; a store that is done is replaced."""
        action, box = self.running
        self.facts.update(effect(action, box, self.facts))
        if self.facts.get(f"{box}.stored"):
            self.stored += 1
            del self._trees[box]
            self._arm = None
            fresh = next(self._names)
            self._trees[fresh] = self._store(fresh)

    def _store(self, box: str) -> Any:  # noqa: ANN401 - of a library without types
        """The store task: below each postcondition, the steps that make it true, in order."""
        return self._until(
            self._fact(f"{box}.stored"),
            self._not(f"{box}.on_floor"),
            self._until(
                self._fact(f"{box}.taken"),
                self._until(self._at(box), self._act("kr60_reach", box)),
                self._at(box),
                self._act("kr60_grasp", box),
            ),
            self._until(
                self._fact(f"{box}.known"),
                self._fact(f"{box}.taken"),
                self._until(self._at("reader"), self._act("kr60_show", box)),
                self._at("reader"),
                self._act("read_barcode", box),
            ),
            self._until(
                self._fact(f"{box}.target"),
                self._fact(f"{box}.known"),
                self._act("ask_target", box),
            ),
            self._fact(f"{box}.taken"),
            self._until(self._at_target(box), self._act("kr60_carry", box)),
            self._at_target(box),
            self._act("kr60_release", box),
        )

    def _until(self, reached: Any, *steps: Any) -> Any:  # noqa: ANN401
        """Done where a condition holds; otherwise the steps, in order, from the first again."""
        work = self._sequence("steps", memory=False, children=list(steps))
        return self._selector("until", memory=False, children=[reached, work])

    def _fact(self, key: Key) -> Any:  # noqa: ANN401
        return self._condition(lambda: bool(self.facts.get(key)))

    def _not(self, key: Key) -> Any:  # noqa: ANN401
        return self._condition(lambda: not self.facts.get(key))

    def _at(self, place: str) -> Any:  # noqa: ANN401
        return self._condition(lambda: self.facts.get("kr60.at") == place)

    def _at_target(self, box: str) -> Any:  # noqa: ANN401
        target = f"{box}.target"
        return self._condition(lambda: self.facts.get("kr60.at") == self.facts.get(target))

    def _condition(self, holds: Callable[[], bool]) -> Any:  # noqa: ANN401
        yes, no = self._status.SUCCESS, self._status.FAILURE
        return self._leaf(lambda: yes if holds() else no)

    def _act(self, action: str, box: str) -> Any:  # noqa: ANN401
        """Runs while the arm is this store's; the first that asks has it until it is done."""
        running = self._status.RUNNING

        def update() -> object:
            if self._arm is None:
                self._arm = box
            if self._arm == box:
                self.running = (action, box)
            return running

        return self._leaf(update)

    def _leaf(self, update: Callable[[], object]) -> Any:  # noqa: ANN401
        leaf = self._behaviour(name="leaf")
        leaf.update = update
        return leaf


def gtpyhop_planner(boxes: int) -> Callable[[], list[tuple[str, ...]]] | None:
    """A planner that decomposes the stores of some boxes into actions, as the task file does.

    Returns:
        What plans once, from the beginning; None where GTPyhop is not installed.
    """
    with redirect_stdout(io.StringIO()):  # it greets
        library = imported("gtpyhop")
        if library is None:
            return None
        library.set_verbose_level(0)
        library.set_recursive_planning("iterative_greedy")
        library.Domain("depal")
        tasks = store_tasks()
        library.declare_actions(*(_operator(action.name) for action in actions_of(tasks)))
        for schema in tasks.schemata.values():
            if isinstance(schema, Task):
                library.declare_task_methods(schema.name, _method(schema))
    names = [f"b{number}" for number in range(boxes)]
    state = library.State("pallet")
    state.facts = {}
    wanted = [("store", name) for name in names]

    def plan() -> list[tuple[str, ...]]:
        found: list[tuple[str, ...]] = library.find_plan(state, wanted)
        return found

    return plan


def _operator(action: str) -> Callable[[Any, str], Any]:
    def operate(state: Any, box: str) -> Any:  # noqa: ANN401
        state.facts.update(effect(action, box, state.facts))
        return state

    operate.__name__ = action
    return operate


def _method(task: Task) -> Callable[[Any, str], list[tuple[str, str]]]:
    steps = [step.schema for step in task.steps]

    def decompose(_: Any, box: str) -> list[tuple[str, str]]:  # noqa: ANN401
        return [(step, box) for step in steps]

    decompose.__name__ = f"do_{task.name}"
    return decompose


def imported(name: str) -> ModuleType | None:
    """A peer, where it is installed."""
    try:
        return import_module(name)
    except ImportError:
        return None
