"""What must hold for a whole subtree: `within` and `limit`."""

import re
from collections.abc import Mapping
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_random_tasks import INPUTS, repositories

from depal.executive.checking import FindingKind, check
from depal.executive.conditions import Value
from depal.executive.drawing import tree_mermaid, tree_svg, tree_text
from depal.executive.engine import Call, Engine, Report
from depal.executive.events import Outcome
from depal.executive.exploring import explore
from depal.executive.exploring.grounding import conditions_of
from depal.executive.language import parse
from depal.executive.limits import (
    avoided_on,
    branches_ahead,
    limits_of,
    limits_on,
    zones_of,
)
from depal.executive.nodes import LiveNode
from depal.executive.schema import Action, Cancel, Repository
from depal.executive.snapshot import freeze, thaw
from depal.executive.tree import Tree, ground, sweep
from depal.executive.units import Quantity
from depal.executive.why import why

CARRY = """
fact cell.open   : flag
fact cell.speed  : number?
fact cell.firm   : number?
fact cell.shut   : text?
fact Box.held    : flag
fact Box.stored  : flag
fact Box.lost    : flag
resource arm capacity 1

task store(Box) when not Box.lost until Box.stored
    within not cell.open
    limit speed 0.5 m/s, speed cell.speed, payload 60 kg,
        margin at least 0.02 g, margin at least cell.firm
    avoids aisle, cell.shut
    keeps arm
  - grasp(Box)
  - carry(Box) when Box.held

action grasp(Box) until Box.held uses arm sets Box.held
    cancel never

action carry(Box) until Box.stored
    limit speed 250 mm/s, margin at least 0.05 g avoids hatch
    uses arm sets Box.stored
    cancel at_checkpoint
"""


def cell() -> Engine:
    """A box is being grasped, another one waits for the arm."""
    engine = Engine(parse(CARRY))
    engine.allocate([Call("store", ("b1",), 0.9), Call("store", ("b2",), 0.1)], 0.0)
    assert running(engine) == {"grasp(b1)": None}
    return engine


def running(engine: Engine) -> dict[str, str | None]:
    """What runs, and why it is to stop."""
    return {a.node.node.label: a.cancel for a in engine.state.attempts.values()}


def ended(engine: Engine, *facts: tuple[str, Value], at: float) -> None:
    """The only attempt ends."""
    (number,) = engine.state.attempts
    engine.report(number, Report(facts), at)


def test_a_running_stroke_goes_on_and_nothing_starts() -> None:
    """`cancel never` is never broken off; what follows it waits, and the arm stays with its box."""
    engine = cell()
    engine.change([("cell.open", True)], "safety", 1.0)
    assert running(engine) == {"grasp(b1)": None}
    ended(engine, ("b1.held", True), at=2.0)
    assert not engine.state.attempts
    assert [node.node.label for _, node in engine.state.holdings.kept()] == ["store(b1)"]
    engine.change([("cell.open", False)], "safety", 3.0)
    assert running(engine) == {"carry(b1)": None}


def test_a_running_motion_is_asked_to_stop_and_the_work_goes_on_afterwards() -> None:
    """At its checkpoint; that is no failure of it."""
    engine = cell()
    ended(engine, ("b1.held", True), at=1.0)
    step = engine.change([("cell.open", True)], "safety", 2.0)
    asked = "what store(b1) has to stay within does not hold"
    assert running(engine) == {"carry(b1)": asked}
    assert [command.policy for command in step.commands] == [Cancel.AT_CHECKPOINT]  # type: ignore[union-attr]
    (number,) = engine.state.attempts
    engine.report(number, Report(outcome=Outcome.CANCELLED, reason=asked), 2.5)
    assert not engine.state.attempts
    assert all(node.failures == 0 for node in engine.state.trees[1].nodes)
    engine.change([("cell.open", False)], "safety", 3.0)
    assert running(engine) == {"carry(b1)": None}


def test_a_precondition_lets_the_arm_go_and_a_rule_does_not() -> None:
    """That is the difference between `when` and `within`."""
    engine = cell()
    ended(engine, ("b1.held", True), at=1.0)
    engine.change([("cell.open", True)], "safety", 2.0)
    assert [node.node.label for _, node in engine.state.holdings.kept()] == ["store(b1)"]
    engine.change([("b1.lost", True)], "camera", 3.0)
    assert not list(engine.state.holdings.kept())
    again = thaw(engine.repository, engine.state.weights, freeze(engine.state))
    assert freeze(again) == freeze(engine.state)


@given(repositories(), INPUTS, st.sampled_from(Cancel))
def test_nothing_runs_unasked_where_a_rule_is_broken(
    repository: Repository,
    inputs: list[list[tuple[str, Value]] | tuple[str, str] | None],
    policy: Cancel,
) -> None:
    """Whatever the task: each attempt below a broken rule is asked to stop, or never is."""
    schemata = {
        name: replace(schema, cancel=policy) if isinstance(schema, Action) else schema
        for name, schema in repository.schemata.items()
    }
    engine = Engine(replace(repository, schemata=schemata))
    engine.allocate([Call("root", ("a", "b"))], 0.0)
    for at, happens in enumerate(inputs, 1):
        before = set(engine.state.attempts)
        if happens is None:
            engine.tick(float(at))
        elif isinstance(happens, tuple):
            engine.allocate([Call("root", happens)], float(at))
        else:
            engine.change(happens, "world", float(at))
        for attempt in engine.state.attempts.values():
            if all(inside(engine, attempt.node)):
                continue
            assert attempt.number in before, "it has started against a rule"
            assert (attempt.cancel is None) == (policy is Cancel.NEVER)


def inside(engine: Engine, node: LiveNode) -> list[bool]:
    """Whether each node on a branch is within its conditions, by definition."""
    tree = Tree(tuple(each.node for each in node.tree.nodes))
    standings = sweep(tree, engine.state.facts, engine.state.spans.has_lasted)
    found, index = [], node.node.index
    while index >= 0:
        found.append(standings[index].within)
        index = tree.nodes[index].parent
    return found


SPEEDS = st.none() | st.floats(0.01, 3.0)


@given(SPEEDS)
def test_the_tightest_limit_counts(told: float | None) -> None:
    """Of the action, of every task above it and of the world's facts."""
    engine = cell()
    engine.change([("cell.speed", told)], "safety", 1.0)
    grasp, carry = engine.state.trees[1].nodes[1:]
    most = 3.0 if told is None else told
    assert limits_on(grasp, engine.state.facts)["speed"] == min(0.5, most)
    assert limits_on(carry, engine.state.facts)["speed"] == min(0.25, most)
    assert limits_on(carry, engine.state.facts)["payload"] == 60.0


@given(st.none() | st.floats(0.01, 0.2))
def test_of_lower_bounds_the_greatest_counts(told: float | None) -> None:
    """For that is the tightest of them."""
    engine = cell()
    engine.change([("cell.firm", told)], "person", 1.0)
    grasp, carry = engine.state.trees[1].nodes[1:]
    least = 0.0 if told is None else told
    assert limits_on(grasp, engine.state.facts)["margin"] == max(0.02, least)
    assert limits_on(carry, engine.state.facts)["margin"] == max(0.05, least)


def test_the_zones_of_the_whole_branch_are_avoided() -> None:
    """A fact may name one more; while it is empty it names none."""
    engine = cell()
    grasp, carry = engine.state.trees[1].nodes[1:]
    assert avoided_on(grasp, engine.state.facts) == {"aisle"}
    assert avoided_on(carry, engine.state.facts) == {"aisle", "hatch"}
    engine.change([("cell.shut", "corner")], "person", 1.0)
    assert avoided_on(grasp, engine.state.facts) == {"aisle", "corner"}


@given(SPEEDS, st.none() | st.just("corner"))
def test_what_will_bind_a_task_is_known_before_it_is_allocated(
    speed: float | None, shut: str | None
) -> None:
    """So that its motions can be planned ahead."""
    engine = cell()
    engine.change([("cell.speed", speed), ("cell.shut", shut)], "safety", 1.0)
    facts = engine.state.facts
    for node in engine.state.trees[1].nodes[1:]:
        name = node.node.schema.name
        (branch,) = branches_ahead(engine.repository, "store", ("b1",), {name})
        assert limits_of(branch, facts) == limits_on(node, facts)
        assert zones_of(branch, facts) == avoided_on(node, facts)


def test_the_explanation_names_the_rule() -> None:
    """And the node that has it."""
    engine = cell()
    engine.change([("cell.open", True)], "safety", 5.0)
    state = engine.state
    assert why(state, state.trees[1], 1).text == (
        "grasp(b1) is disabled: cell.open is set since 5 s, within of store(b1) wants it not set"
    )


@pytest.mark.parametrize("draw", [tree_text, tree_svg, tree_mermaid])
def test_every_drawing_shows_rules_and_limits(draw: object) -> None:
    """With a mark where it is known whether they hold."""
    tree = ground(parse(CARRY), "store", ("b1",))
    facts: Mapping[str, Value] = {"cell.open": True}
    text = draw(tree, sweep(tree, facts, lambda *_: True))  # type: ignore[operator]
    words = " ".join(re.sub("</?(tspan|text|rect)[^>]*>", " ", text).split())  # lines are broken
    assert "✗ within not cell.open" in words
    assert "limit speed 0.5 m/s" in words
    assert "margin at least 0.02 g" in words
    assert "avoids aisle, cell.shut" in words
    assert "✓" not in draw(tree, None)  # type: ignore[operator]


def test_an_explorer_walks_what_a_rule_does() -> None:
    """It is broken at any moment: the carrying is broken off and begun again, and all ends well."""
    repository = parse(CARRY)
    found = explore(repository, "store", ("b1",), disturbances=["cell.open"])
    assert found.complete
    assert not found.hazards
    assert found.states > explore(repository, "store", ("b1",)).states


def test_a_rule_that_contradicts_its_task_is_found() -> None:
    """A branch that can never be enabled."""
    text = CARRY.replace("when not Box.lost", "when cell.open")
    never = [one for one in check(parse(text)) if one.kind is FindingKind.NEVER_ENABLED]
    assert [one.what for one in never] == [
        "can never be enabled: 'cell.open' and 'not cell.open' never hold at once"
    ]


KNOWN = {
    "speed": Quantity("m/s"),
    "payload": Quantity("kg"),
    "tilt": Quantity("rad"),
    "margin": Quantity("g", at_least=True),
}


@pytest.mark.parametrize(
    ("limit", "said"),
    [
        ("sped 1 m/s", "nothing keeps a limit of 'sped'; did you mean 'speed'?"),
        ("speed 1 kg", "speed is measured in m/s, not in kg"),
        ("speed cell.open", "cell.open holds a flag, and limits speed"),
        ("speed cell.sped", "undeclared fact 'cell.sped'; did you mean 'cell.speed'?"),
        ("speed 1 g", "speed is measured in m/s, not in g"),
        ("tilt at least 5 deg", "tilt is bounded from above: without 'at least'"),
        ("margin 0.1 g", "margin is bounded from below: write 'limit margin at least'"),
    ],
)
def test_limits_that_nothing_keeps_are_mistakes(limit: str, said: str) -> None:
    """Quantities, their units, and the facts that tell how much."""
    text = CARRY.replace("payload 60 kg", limit)
    found = [str(one) for one in check(parse(text), None, KNOWN) if one.serious]
    assert found == [f"store(Box), limit: {said}"]
    assert not [one for one in check(parse(CARRY), None, KNOWN) if one.serious]


@pytest.mark.parametrize(
    ("zones", "known", "said"),
    [
        ("aisel", ("aisle", "hatch"), "the cell has no zone 'aisel'; did you mean 'aisle'?"),
        ("aisle", (), "the cell has no zone 'aisle'; its file names none"),
        ("cell.open", ("hatch",), "cell.open holds a flag, and no zone's name"),
        ("cell.shutt", ("hatch",), "undeclared fact 'cell.shutt'; did you mean 'cell.shut'?"),
    ],
)
def test_zones_that_are_not_there_are_mistakes(
    zones: str, known: tuple[str, ...], said: str
) -> None:
    """And facts that cannot name one."""
    text = CARRY.replace("aisle, cell.shut", zones).replace("avoids hatch", "")
    found = [str(one) for one in check(parse(text), None, KNOWN, known) if one.serious]
    assert found == [f"store(Box), avoids: {said}"]
    assert not [one for one in check(parse(text), None, KNOWN) if "no zone '" in one.what]


def test_the_facts_of_a_rule_are_known_to_every_node() -> None:
    """So that drawings and the explorer may be told of them."""
    repository = parse(CARRY)
    tree = ground(repository, "store", ("b1",))
    known = {key for node in conditions_of(repository, tree) for one in node for key in one.facts}
    assert "cell.open" in known
