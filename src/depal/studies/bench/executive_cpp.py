"""The same stores with BehaviorTree.CPP, where its Python bindings are installed.

Conditions are scripts of the library's own, on its blackboards; Python is called back only by the
one action that runs.
"""

from collections.abc import Callable
from itertools import count, islice
from types import ModuleType
from typing import Any, Final

from depal.executive.conditions import Key, Value
from depal.studies.bench.executive_peers import imported, median_tick
from depal.studies.bench.executive_work import effect


def behaviortree_cpp_tick(stores: int, ticks: int) -> float | None:
    """What an event costs an executive that ticks a BehaviorTree.CPP tree for each store.

    Args:
        stores: how many trees there are.
        ticks: how often all of them are ticked, each after one more action has ended.

    Returns:
        The median time of a tick of all trees [s], or None where behaviortreepy is not installed.
    """
    library = imported("behaviortreepy")
    return None if library is None else median_tick(CppForest(library, stores), ticks)


def _until(reached: str, *steps: str) -> str:
    """Done where a condition holds; otherwise the steps, in order, from the first again."""
    work = f"<ReactiveSequence>{''.join(steps)}</ReactiveSequence>"
    return f"<ReactiveFallback>{reached}{work}</ReactiveFallback>"


def _if(code: str) -> str:
    return f'<ScriptCondition code="{code}"/>'


def _act(action: str) -> str:
    """Runs while the arm is this store's; the first that asks has it until it is done."""
    mine = _if("@arm == '' || @arm == box")
    start = f"<Script code=\"@arm := box; @action := '{action}'\"/>"
    return f"<ReactiveSequence>{mine}{start}<Work/></ReactiveSequence>"


_STORE: Final = _until(
    _if("stored"),
    _if("!on_floor"),
    _until(
        _if("taken"),
        _until(_if("@at == box"), _act("kr60_reach")),
        _if("@at == box"),
        _act("kr60_grasp"),
    ),
    _until(
        _if("known"),
        _if("taken"),
        _until(_if("@at == 'reader'"), _act("kr60_show")),
        _if("@at == 'reader'"),
        _act("read_barcode"),
    ),
    _until(_if("target != ''"), _if("known"), _act("ask_target")),
    _if("taken"),
    _until(_if("@at == target"), _act("kr60_carry")),
    _if("@at == target"),
    _act("kr60_release"),
)
"""The store task; names with @ stand on the blackboard that all trees share."""


class CppForest:
    """One BehaviorTree.CPP tree for each store, on the same facts, with one arm for all of them.

    Attributes:
        facts: what is the case; the blackboards have the same.
        stored: how many stores were done.
    """

    def __init__(self, library: ModuleType, stores: int) -> None:
        """Builds the trees."""
        self.facts: dict[Key, Value] = {}
        self.stored = 0
        self._boards = library.Blackboard
        self._factory = library.BehaviorTreeFactory()
        running: Callable[..., object] = lambda *_: library.NodeStatus.RUNNING  # noqa: E731
        self._factory.register_simple_stateful_action("Work", running, running, lambda *_: None)
        tree = f'<BehaviorTree ID="store">{_STORE}</BehaviorTree>'
        self._factory.register_behavior_tree_from_text(f'<root BTCPP_format="4">{tree}</root>')
        self._cell = self._boards.create()
        for name in ("at", "arm", "action"):
            self._cell.set_string(name, "")
        self._names = (f"b{number}" for number in count(1))
        self._trees = {name: self._store(name) for name in islice(self._names, stores)}
        self.tick()

    @property
    def running(self) -> tuple[str, str]:
        """The action that runs, and its box."""
        return self._cell.get_string("action"), self._cell.get_string("arm")

    def tick(self) -> None:
        """Ticks every tree once, the oldest first."""
        for tree, _ in self._trees.values():
            tree.tick_exactly_once()

    def end_one(self) -> None:
        """The primitive that runs has done what it is for; a store that is done is replaced."""
        action, box = self.running
        for key, value in effect(action, box, self.facts):
            self.facts[key] = value
            subject, _, attribute = key.partition(".")
            board = self._trees[subject][1] if subject in self._trees else self._cell
            if isinstance(value, bool):
                board.set_bool(attribute, value)
            else:
                board.set_string(attribute, value or "")
        if self.facts.get(f"{box}.stored"):
            self.stored += 1
            del self._trees[box]
            self._cell.set_string("arm", "")
            fresh = next(self._names)
            self._trees[fresh] = self._store(fresh)

    def _store(self, box: str) -> tuple[Any, Any]:
        """A tree and its own blackboard, of a library without types."""
        board = self._boards.create(self._cell)
        board.set_string("box", box)
        board.set_string("target", "")
        for name in ("stored", "on_floor", "taken", "known"):
            board.set_bool(name, False)  # noqa: FBT003 - the library's own
        return self._factory.create_tree("store", board), board
