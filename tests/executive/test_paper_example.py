"""The running example of section II-B: green enabled, blue accomplished, red disabled."""

from worlds import STORE, effect

from depal.executive.engine import Call, Engine, Report
from depal.executive.tree import NodeState

GREEN, BLUE, RED = NodeState.ENABLED, NodeState.ACCOMPLISHED, NodeState.DISABLED


class Run:
    """An engine with one store(b1), told step by step what happens."""

    def __init__(self, *known: tuple[str, bool | str]) -> None:
        """Allocates it, with what the camera knows."""
        self.engine = Engine(STORE)
        self.engine.change(known, "camera", 0.0)
        self.engine.allocate([Call("store", ("b1",))], 0.0)
        self.tree = self.engine.state.trees[1]
        self.ended: list[str] = []

    def states(self) -> dict[str, NodeState]:
        """The state of every node by its schema's name."""
        standings = self.engine.state.standings(self.tree)
        pairs = zip(self.tree.nodes, standings, strict=True)
        return {node.node.schema.name: standing.state for node, standing in pairs}

    def running(self) -> list[str]:
        """What runs now."""
        return [a.node.action.name for a in self.engine.state.attempts.values()]

    def finish(self, action: str) -> None:
        """One running action succeeds."""
        (attempt,) = (
            a for a in self.engine.state.attempts.values() if a.node.action.name == action
        )
        changes = effect(action, "b1", self.engine.state.facts)
        self.engine.report(attempt.number, Report(changes), self.engine.state.now + 1)
        self.ended.append(action)


def test_the_example_has_four_abstract_subtasks_and_seven_concrete_actions() -> None:
    """Five of the robot's and two communications."""
    run = Run()
    abstract = [n.node.schema.name for n in run.tree.nodes if not n.node.concrete]
    concrete = [n.node.schema.name for n in run.tree.nodes if n.node.concrete]
    assert abstract == ["store", "take", "check", "query", "leave"]
    assert len(concrete) == 7
    assert sum(name.startswith("kr60") for name in concrete) == 5


def test_a_known_box_with_a_target_is_taken_and_left() -> None:
    """Check and query never become enabled."""
    run = Run(("b1.known", True), ("b1.target", "trolley_1"))
    assert run.states() | {} == {
        "store": GREEN,
        "take": GREEN, "kr60_reach": GREEN, "kr60_grasp": RED,
        "check": BLUE, "kr60_show": RED, "read_barcode": BLUE,
        "query": BLUE, "ask_target": BLUE,
        "leave": RED, "kr60_carry": RED, "kr60_release": RED,
    }  # fmt: skip
    assert run.running() == ["kr60_reach"]
    run.finish("kr60_reach")
    assert run.states()["kr60_reach"] is BLUE
    assert run.states()["kr60_grasp"] is GREEN
    run.finish("kr60_grasp")
    assert run.states()["take"] is BLUE
    assert run.states()["leave"] is GREEN
    assert run.running() == ["kr60_carry"]
    run.finish("kr60_carry")
    assert run.states()["kr60_release"] is GREEN
    run.finish("kr60_release")
    assert run.ended == ["kr60_reach", "kr60_grasp", "kr60_carry", "kr60_release"]
    assert run.engine.state.trees == {}
    assert run.engine.state.facts["b1.stored"] is True


def test_an_unknown_box_is_shown_to_the_reader_and_its_target_asked_for() -> None:
    """take, check, query, leave; a finished check is shown accomplished, not disabled."""
    run = Run()
    for action in ("kr60_reach", "kr60_grasp"):
        run.finish(action)
    assert run.states()["check"] is GREEN
    assert run.states()["query"] is RED
    assert run.states()["leave"] is RED
    assert run.running() == ["kr60_show"]
    run.finish("kr60_show")
    assert run.states()["read_barcode"] is GREEN
    run.finish("read_barcode")
    assert run.states()["check"] is BLUE
    assert run.states()["query"] is GREEN
    assert run.running() == ["ask_target"]
    run.finish("ask_target")
    assert run.states()["query"] is BLUE
    assert run.running() == ["kr60_carry"]
    run.finish("kr60_carry")
    run.finish("kr60_release")
    assert run.engine.state.trees == {}


def test_a_known_box_without_a_target_asks_while_the_arm_moves() -> None:
    """Query needs only `known`: its cost is hidden."""
    run = Run(("b1.known", True))
    assert sorted(run.running()) == ["ask_target", "kr60_reach"]
    run.finish("ask_target")
    assert run.states()["query"] is BLUE
    assert run.states()["leave"] is RED
    for action in ("kr60_reach", "kr60_grasp", "kr60_carry", "kr60_release"):
        run.finish(action)
    assert run.engine.state.facts["b1.stored"] is True


def test_a_box_that_slips_back_onto_the_pile_is_taken_again() -> None:
    """Accomplished is not latched."""
    run = Run(("b1.known", True), ("b1.target", "trolley_1"))
    run.finish("kr60_reach")
    run.finish("kr60_grasp")
    run.engine.change([("b1.taken", False), ("kr60.at", None)], "vacuum", 9.0)
    assert run.states()["take"] is GREEN
    (attempt,) = run.engine.state.attempts.values()
    assert attempt.cancel is not None  # the carrying is broken off at its next checkpoint
    run.engine.report(attempt.number, Report(), 10.0)
    assert run.running() == ["kr60_reach"]


def test_a_box_on_the_floor_disables_its_store() -> None:
    """And nothing of it runs until a person has cleared it."""
    run = Run(("b1.known", True), ("b1.target", "trolley_1"))
    run.finish("kr60_reach")
    run.engine.change([("b1.on_floor", True)], "camera", 5.0)
    assert run.states()["store"] is RED
    (grasp,) = run.engine.state.attempts.values()
    assert grasp.node.action.name == "kr60_grasp"
    assert grasp.cancel is None  # a suction stroke is never broken off half-way
    run.engine.report(grasp.number, Report(), 6.0)
    assert run.running() == []
    run.engine.change([("b1.on_floor", False)], "person", 7.0)
    assert run.states()["store"] is GREEN
