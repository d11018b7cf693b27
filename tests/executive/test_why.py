"""The explanation of a disabled node, when flipped, enables it."""

from hypothesis import assume, given
from hypothesis import strategies as st
from test_engine_laws import REPOSITORIES, Driver
from worlds import STORE

from depal.executive.engine import Call, Engine
from depal.executive.tree import NodeState
from depal.executive.why import Culprit, why


def remedy(culprit: Culprit) -> object:
    """The value that the culprit wants."""
    wanted = culprit.wanted
    if wanted == "set":
        attribute = culprit.key.rpartition(".")[2]
        return "trolley_1" if attribute == "target" else True
    if wanted in {"not set", "not = None"}:
        return None if culprit.key in {"kr60.at", "line.busy"} else False
    operator, _, right = wanted.partition(" ")
    if operator == "=":
        return right.rpartition("(")[2].rstrip(")") if "(" in right else right
    if operator in {">", ">="}:
        return float(right) + 1
    return None


@given(st.sampled_from(["store", "pack"]), st.integers(0, 2**32 - 1))
def test_flipping_what_is_named_enables_the_node(name: str, seed: int) -> None:
    """For every disabled node of a random run."""
    driver = Driver(REPOSITORIES[name], seed)
    for _ in driver.steps(15):
        pass
    trees = list(driver.engine.state.trees.values())
    assume(trees)
    for index in range(len(trees[0].nodes)):
        found = why(driver.engine.state, trees[0], index)
        assert (found.state is NodeState.DISABLED) == bool(found.culprits)
        if found.state is not NodeState.DISABLED:
            continue
        if any(
            "for" in culprit.wanted
            or "kr60.at (" in culprit.wanted
            or (culprit.wanted.startswith("=") and "not set" in culprit.wanted)
            for culprit in found.culprits
        ):
            continue  # needs time, or another fact first
        if len({culprit.key for culprit in found.culprits}) < len(found.culprits):
            continue  # two nodes want one fact to be two things: no flip can please both
        facts = dict(driver.engine.state.facts)
        facts.update({culprit.key: remedy(culprit) for culprit in found.culprits})  # type: ignore[misc]
        before = dict(driver.engine.state.facts)
        driver.engine.state.facts.update(facts)
        after = why(driver.engine.state, trees[0], index)
        driver.engine.state.facts.clear()
        driver.engine.state.facts.update(before)
        assert after.state is not NodeState.DISABLED, found.text


def test_the_explanation_names_the_facts_and_since_when() -> None:
    """In a sentence."""
    engine = Engine(STORE)
    engine.allocate([Call("store", ("b1",))], 0.0)
    engine.change([("b1.on_floor", True)], "camera", 5.0)
    tree = engine.state.trees[1]
    assert why(engine.state, tree, 0).text == (
        "store(b1) is disabled: b1.on_floor is set since 5 s, store(b1) wants it not set"
    )
    leave = next(n.node.index for n in tree.nodes if n.node.schema.name == "leave")
    assert why(engine.state, tree, leave).text == (
        "leave(b1) is disabled: b1.taken is not set, leave(b1) in store(b1) wants it set; "
        "b1.target is not set, leave(b1) in store(b1) wants it set; "
        "b1.on_floor is set since 5 s, store(b1) wants it not set"
    )


def test_an_enabled_node_says_what_it_waits_for() -> None:
    """The arm, a person, a retry, or nothing."""
    engine = Engine(STORE)
    engine.allocate([Call("store", ("b1",), 0.9), Call("store", ("b2",), 0.1)], 0.0)
    first, second = engine.state.trees.values()
    assert why(engine.state, first, 2).text == "kr60_reach(b1) is enabled and runs (attempt 1)"
    assert why(engine.state, second, 2).text == (
        "kr60_reach(b2) is enabled, and waits for kr60 (kr60_reach(b1)); kr60 (kept by store(b1))"
    )
