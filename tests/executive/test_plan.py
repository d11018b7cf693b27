"""Plans mean what the trees that they stand for mean."""

import gc
from dataclasses import fields
from importlib.resources import files
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st
from worlds import STORE, effect

from depal.errors import TaskError
from depal.executive import plan as plans
from depal.executive.atoms import members
from depal.executive.conditions import Value, at_once
from depal.executive.engine import Call, Engine, Report
from depal.executive.language import parse
from depal.executive.nodes import LiveTree
from depal.executive.plan import Plan
from depal.executive.schema import Task
from depal.executive.tree import Node, Tree, ground, sweep
from depal.executive.watching import Move

CELL = parse(
    "\n".join((files("depal.cell.tasks") / f"{n}.task").read_text() for n in ("store", "cell"))
)
TASKS = sorted(name for name, schema in CELL.schemata.items() if isinstance(schema, Task))


def told(node: Node) -> list[object]:
    """Everything about a node."""
    return [getattr(node, part.name) for part in fields(Node)]


@pytest.mark.parametrize("name", TASKS)
def test_a_stamp_makes_the_nodes_that_grounding_makes(name: str) -> None:
    """For any arguments, also where one thing stands for several parameters."""
    plan = Plan(CELL, name, {})
    for args in product(["b1", "b2"], repeat=plan.arity):
        grounded = ground(CELL, name, args).nodes
        assert [told(n) for n in plan.stamp.nodes(args)] == [told(n) for n in grounded]


FACTS: dict[str, list[Value]] = {
    "b1.taken": [None, False, True],
    "b1.known": [None, False, True],
    "b1.stored": [None, True],
    "b1.on_floor": [None, True],
    "b1.at": [None, "p1", "aside"],
    "b1.target": [None, "p1"],
    "p1.full": [None, True],
    "kr60.at": [None, "b1", "reader", "p1", "p2"],
}


@given(
    st.sampled_from(
        [name for name in TASKS if "Box" in [p.name for p in CELL.schemata[name].params]]
    ),
    st.fixed_dictionaries({key: st.sampled_from(values) for key, values in FACTS.items()}),
)
def test_what_a_set_of_atoms_means_is_what_a_sweep_says(name: str, facts: dict[str, Value]) -> None:
    """Of every node; a plan that has seen the set before says the same again."""
    plan = Plan(CELL, name, dict(facts))
    args = ("b1", "p1", "p2")[: plan.arity]
    subject = plan.subject(args, ())
    true = sum(atom.test(subject) << number for number, atom in enumerate(plan.atoms))
    swept = sweep(Tree(tuple(plan.stamp.nodes(args))), facts, at_once)
    gates = plan.gates(true)
    assert plan.gates(true) is gates
    for index, standing in enumerate(swept):
        assert gates.open >> index & 1 == standing.gate
        assert gates.accomplished >> index & 1 == standing.post
        part = plan.parts[index]
        assert part.pre(true) == standing.pre
        awake = not part.parent or bool(gates.open & part.parent)
        assert gates.awake >> index & 1 == awake
        assert not awake or gates.needed & part.mentioned == part.mentioned


def test_a_plan_forgets_before_it_remembers_too_much(monkeypatch: pytest.MonkeyPatch) -> None:
    """And then works everything out again."""
    monkeypatch.setattr(plans, "ROOM", 2)
    plan = Plan(STORE, "store", {})
    first = plan.gates(0)
    assert plan.gates(1) != first
    assert plan.gates(0) is first
    plan.gates(2)
    assert plan.gates(0) is not first
    assert plan.gates(0) == first


def test_a_plan_is_made_once_for_all_arguments() -> None:
    """A wrong number of them is refused each time."""
    state = Engine(STORE).state
    plan = state.plan("store", ("b1",))
    assert state.plan("store", ("b2",)) is plan
    with pytest.raises(TaskError, match="store takes 1 arguments, 2 given"):
        state.plan("store", ("b1", "b2"))
    assert state.plan("store", ("b3",)) is plan


def test_trees_that_have_ended_do_not_wait_for_the_garbage_collector() -> None:
    """A restart folds thousands of them with the collector off."""
    gc.collect()
    gc.disable()
    try:
        before = sum(isinstance(thing, LiveTree) for thing in gc.get_objects())
        engine = Engine(STORE)
        for number in range(300):
            engine.allocate([Call("store", (f"b{number}",))], number)
            while attempts := list(engine.state.attempts.values()):
                node = attempts[0].node
                changes = effect(node.action.name, node.node.args[0], engine.state.facts)
                engine.report(attempts[0].number, Report(changes), number)
        assert not engine.state.trees
        left = sum(isinstance(thing, LiveTree) for thing in gc.get_objects()) - before
        assert left < 150
    finally:
        gc.enable()


def test_only_shared_facts_that_matter_are_watched() -> None:
    """A waiting store is told when the arm comes to its box, and of no other move of the arm."""
    engine = Engine(STORE)
    engine.allocate([Call("store", (f"b{number}",)) for number in range(50)], 0.0)
    told_of = engine.state._watchers.told  # noqa: SLF001 - its cost is the point
    assert len(told_of([Move("kr60.at", None, "b7")])) == 1
    assert not told_of([Move("kr60.at", None, "reader")])
    engine.change([("b7.taken", True), ("b7.target", "p1")], "world", 1.0)
    assert len(told_of([Move("kr60.at", None, "reader")])) == 2  # at the reader, at the target
    engine.change([("b7.known", True)], "world", 1.0)
    assert len(told_of([Move("kr60.at", None, "reader")])) == 1
    engine.change([("b7.taken", False)], "world", 1.0)
    assert not told_of([Move("kr60.at", None, "reader")])
    engine.withdraw(8, "no longer wanted", 2.0)
    assert not told_of([Move("kr60.at", "b7", None), Move("b7.taken")])


def test_all_that_names_the_first_argument_is_watched_all_the_time() -> None:
    """A waiting store listens to its box; of the arm it hears when it comes to the box.

    And of the cell, that nothing may move: a rule of its root is the only other thing.
    """
    engine = Engine(STORE)
    engine.allocate([Call("store", (f"b{number}",)) for number in range(3)], 0.0)
    for tree in list(engine.state.trees.values())[1:]:
        own = [number for number, atom in enumerate(tree.plan.atoms) if atom.own]
        assert len(own) == len(tree.plan.atoms) - 3
        assert own == members(tree.plan.own)
        rule = members(tree.watched & ~tree.plan.own)
        assert [tree.subject.watches[number] for number in rule] == [["cell.suspended"]]
