"""Laws of the engine, over random runs of random tasks."""

import random
from collections.abc import Iterator

import pytest
from hypothesis import given
from hypothesis import strategies as st
from worlds import STORE, effect

from depal.errors import TaskError
from depal.executive import events as ev
from depal.executive.engine import Call, Engine, Report, Step
from depal.executive.events import Outcome, decode, encode
from depal.executive.language import parse
from depal.executive.restart import restored
from depal.executive.schema import Repository
from depal.executive.snapshot import freeze, thaw
from depal.executive.state import State

TWO_ARMS = parse(
    """
fact Box.clean  : flag
fact Box.warm   : flag
fact Box.packed : flag
fact Box.weight : number
fact Box.fault  : text?
fact Box.attempts : number
fact line.speed : number
fact line.busy  : Box?
resource arm capacity 2
resource belt capacity 1

task pack(Box) when not line.busy or line.busy = Box until Box.packed keeps belt
  - wash(Box)  bias 0.3
  - heat(Box)  when Box.clean and line.speed >= 2
  - ship(Box)  when (Box.clean and Box.warm) or Box.weight > 5

action wash(Box) until Box.clean uses arm sets Box.clean, Box.weight retries 2 backoff 1 s
action heat(Box) until Box.warm uses arm, belt sets Box.warm
    cancel at_checkpoint timeout 5 s retries 1
action ship(Box) when (not Box.packed) for 2 s until Box.packed uses belt sets Box.packed, Box.clean
    cancel never idempotent retries 3
""",
    "two_arms",
)


def things(repository: Repository) -> tuple[str, list[str], list[tuple[str, list[object]]]]:
    """A task, some boxes, and facts that the world may change by itself."""
    if repository is STORE:
        world: list[tuple[str, list[object]]] = [
            (f"b{i}.{name}", [True, False])
            for i in range(4)
            for name in ("taken", "known", "stored", "on_floor")
        ]
        world += [(f"b{i}.fault", [None]) for i in range(4)]
        world += [("kr60.at", [None, "b0", "b1", "reader", "trolley_1"])]
        return "store", [f"b{i}" for i in range(4)], world
    world = [
        (f"b{i}.{name}", [True, False]) for i in range(4) for name in ("clean", "warm", "packed")
    ]
    world += [(f"b{i}.fault", [None]) for i in range(4)]
    world += [("line.speed", [0.0, 1.0, 2.0, 3.0]), ("line.busy", [None, "b0", "b1"])]
    world += [(f"b{i}.weight", [1.0, 9.0]) for i in range(4)]
    return "pack", [f"b{i}" for i in range(4)], world


class Driver:
    """Does random things to an engine, and keeps every event."""

    def __init__(self, repository: Repository, seed: int) -> None:
        """Nothing has happened yet."""
        self.repository = repository
        self.random = random.Random(seed)  # noqa: S311 - a simulation
        self.engine = Engine(repository)
        self.events: list[ev.Event] = []
        self.now = 0.0
        self.task, self.boxes, self.world = things(repository)

    def steps(self, count: int) -> Iterator[None]:
        """Random inputs, one after the other."""
        for _ in range(count):
            self.now += self.random.choice([0.0, 0.1, 1.0, 3.0])
            self.events += self._input().events
            yield

    def _input(self) -> Step:  # noqa: PLR0911 - one return a kind of input
        engine, draw = self.engine, self.random
        trees, attempts = list(engine.state.trees), list(engine.state.attempts)
        kind = draw.random()
        if kind < 0.2:
            call = Call(self.task, (draw.choice(self.boxes),), draw.random())
            return engine.allocate([call], self.now)
        if kind < 0.45:
            picked = draw.sample(self.world, draw.randint(1, 3))
            return engine.change(
                [(key, draw.choice(values)) for key, values in picked], "world", self.now
            )
        if kind < 0.8 and attempts:
            return self._report(draw.choice(attempts))
        if kind < 0.85 and trees:
            return engine.prioritise(draw.choice(trees), draw.random(), self.now)
        if kind < 0.88 and trees:
            return engine.withdraw(draw.choice(trees), "no longer wanted", self.now)
        if kind < 0.91:
            return engine.hold("person", self.now)
        if kind < 0.96:
            return engine.start("person", self.now)
        return engine.tick(self.now)

    def _report(self, number: int) -> Step:
        node = self.engine.state.attempts[number].node
        outcome = self.random.choice([Outcome.DONE, Outcome.DONE, Outcome.FAILED])
        changes: tuple[tuple[str, object], ...] = ()
        if outcome is Outcome.DONE:
            box = node.node.args[0]
            if self.repository is STORE:
                changes = effect(node.action.name, box, self.engine.state.facts)
            else:
                changes = {
                    "wash": ((f"{box}.clean", True), (f"{box}.weight", 4.0)),
                    "heat": ((f"{box}.warm", True),),
                    "ship": ((f"{box}.packed", True), (f"{box}.clean", False)),
                }[node.action.name]
        return self.engine.report(number, Report(changes, outcome), self.now)  # type: ignore[arg-type]


repositories = st.sampled_from(["store", "pack"])
REPOSITORIES = {"store": STORE, "pack": TWO_ARMS}
seeds = st.integers(0, 2**32 - 1)


def gates(state: State) -> dict[tuple[int, int], bool]:
    """Which nodes may run, as the engine keeps it."""
    return {node.place: node.gate for tree in state.trees.values() for node in tree.nodes}


@given(repositories, seeds)
def test_the_incremental_result_equals_a_full_sweep(name: str, seed: int) -> None:
    """After every single event: gates, values, and who waits."""
    repository = REPOSITORIES[name]
    driver = Driver(repository, seed)
    for _ in driver.steps(60):
        state = driver.engine.state
        for tree in state.trees.values():
            for node, swept in zip(tree.nodes, state.standings(tree), strict=True):
                assert node.gate == (swept.gate and tree.withdrawn is None)
                if tree.gates.awake >> node.node.index & 1:
                    part = tree.plan.parts[node.node.index]
                    assert part.pre(tree.true) == swept.pre
                    assert part.post(tree.true) == swept.post
                may_run = node.gate and node.node.concrete and node.attempt is None
                if state.waiting.waits(node):
                    assert may_run
                    assert not node.faulted
                elif may_run:
                    assert node.faulted or node.retry_at > state.now or node.retry_at > 0


@given(repositories, seeds)
def test_no_resource_is_used_beyond_its_capacity(name: str, seed: int) -> None:
    """Keepers included, and claims are all or nothing."""
    repository = REPOSITORIES[name]
    driver = Driver(repository, seed)
    for _ in driver.steps(60):
        state = driver.engine.state
        for held, resource in repository.resources.items():
            users = [a.node for a in state.attempts.values() if held in a.node.action.uses]
            assert len(users) <= resource.capacity
            assert {node.place for node in users} == {
                node.place for node in state.holdings.users(held).values()
            }
            keepers = [node for kept, node in state.holdings.kept() if kept == held]
            outside = [u for u in users if not any(u.is_within(k) for k in keepers)]
            assert len(outside) + len(keepers) <= resource.capacity


@given(repositories, seeds)
def test_folding_the_journal_gives_the_live_state(name: str, seed: int) -> None:
    """Through the text of the events, at the end and at a random earlier moment."""
    repository = REPOSITORIES[name]
    driver = Driver(repository, seed)
    for _ in driver.steps(40):
        pass
    texts = [(event.at, type(event).__name__, encode(event)) for event in driver.events]
    folded = restored(repository, (decode(*text) for text in texts)).state
    live = driver.engine.state
    assert freeze(folded) == freeze(live)
    assert gates(folded) == gates(live)
    assert folded.next_timer() == live.next_timer()


@given(repositories, seeds, st.integers(5, 40))
def test_a_snapshot_goes_on_as_the_original_does(name: str, seed: int, cut: int) -> None:
    """Byte by byte, whatever comes after it."""
    repository = REPOSITORIES[name]
    driver = Driver(repository, seed)
    for _ in driver.steps(cut):
        pass
    twin = Driver(repository, seed)
    twin.engine.state = thaw(repository, driver.engine.state.weights, freeze(driver.engine.state))
    twin.now = driver.now
    twin.random.setstate(driver.random.getstate())
    assert freeze(twin.engine.state) == freeze(driver.engine.state)
    before = len(driver.events)
    for _ in driver.steps(30):
        pass
    for _ in twin.steps(30):
        pass
    assert [encode(e) for e in twin.events] == [encode(e) for e in driver.events[before:]]


@given(repositories, seeds)
def test_the_same_inputs_give_the_same_events(name: str, seed: int) -> None:
    """Twice, to the byte."""
    repository = REPOSITORIES[name]
    first, second = Driver(repository, seed), Driver(repository, seed)
    for _ in first.steps(50):
        pass
    for _ in second.steps(50):
        pass
    assert [encode(e) for e in first.events] == [encode(e) for e in second.events]


@given(seeds)
def test_an_independent_task_changes_nothing_for_the_others(seed: int) -> None:
    """A task with its own facts and resources beside the driver's."""
    extra = """
fact lamp.on : flag
resource switch capacity 1
task light() until lamp.on
  - press()
action press() until lamp.on uses switch sets lamp.on
"""
    from depal.executive.language import format_repository  # noqa: PLC0415 - only here

    both = parse(format_repository(TWO_ARMS) + extra, "both")
    alone, beside = Driver(TWO_ARMS, seed), Driver(TWO_ARMS, seed)
    beside.engine = Engine(both)
    beside.engine.allocate([Call("light")], 0.0)
    hidden = 1

    def told(driver: Driver) -> list[tuple[str, str]]:
        return [
            (type(e).__name__, str(getattr(e, "facts", getattr(e, "reason", ""))))
            for e in driver.events
        ]

    # The lamp's attempt and tree only shift the numbers of the others.
    beside.engine.state.next_tree = 1 + hidden
    light = beside.engine.state.attempts[1]
    beside.engine.report(light.number, Report((("lamp.on", True),)), 0.0)
    for _ in alone.steps(40):
        pass
    for _ in beside.steps(40):
        pass
    assert told(alone) == told(beside)


@given(seeds, st.floats(0.1, 1))
def test_raising_a_priority_never_makes_a_task_lose(seed: int, more: float) -> None:
    """Whoever wins the arm still wins it with a higher priority."""
    draw = random.Random(seed)  # noqa: S311 - a simulation
    priorities = [draw.random() for _ in range(5)]

    def winner(values: list[float]) -> int:
        engine = Engine(STORE)
        engine.hold("person", 0.0)
        engine.allocate([Call("store", (f"b{i}",), p) for i, p in enumerate(values)], 0.0)
        engine.start("person", 1.0)
        return next(a.node.tree.number for a in engine.state.attempts.values()) - 1

    won = winner(priorities)
    raised = [p + more if i == won else p for i, p in enumerate(priorities)]
    assert winner(raised) == won


def test_nobody_starves_among_newcomers_with_higher_priority() -> None:
    """A store of priority 0 is served although one of priority 1 arrives every ten seconds."""
    engine = Engine(STORE)
    engine.allocate([Call("store", ("patient",), 0.0)], 0.0)
    engine.hold("person", 0.0)
    for attempt in list(engine.state.attempts):
        engine.report(attempt, Report(outcome=Outcome.CANCELLED), 0.0)
    engine.start("person", 0.0)
    now, number = 0.0, 0
    while "patient.stored" not in engine.state.facts:
        now += 10.0
        number += 1
        assert number < 2000, "it starves"
        engine.allocate([Call("store", (f"n{number}",), 1.0)], now)
        for _ in range(7):
            for attempt in list(engine.state.attempts.values()):
                box = attempt.node.node.args[0]
                changes = effect(attempt.node.action.name, box, engine.state.facts)
                engine.report(attempt.number, Report(changes), now)


def test_a_running_holder_is_displaced_only_beyond_the_margin() -> None:
    """And only where its policy lets it go."""
    engine = Engine(STORE)
    engine.allocate([Call("store", ("b1",), 0.5)], 0.0)
    engine.allocate([Call("store", ("b2",), 0.6)], 1.0)
    (reach,) = engine.state.attempts.values()
    assert reach.cancel is None
    engine.allocate([Call("store", ("b3",), 0.9)], 2.0)
    assert reach.cancel is None  # store keeps the arm: nobody outside gets it


def test_a_keeper_lets_its_resource_go_when_it_is_disabled() -> None:
    """Not only when it is accomplished."""
    engine = Engine(STORE)
    engine.allocate([Call("store", ("b1",), 0.9), Call("store", ("b2",), 0.1)], 0.0)
    (reach,) = engine.state.attempts.values()
    engine.change([("b1.on_floor", True)], "camera", 1.0)
    engine.report(reach.number, Report(outcome=Outcome.CANCELLED), 2.0)
    (reach,) = engine.state.attempts.values()
    assert reach.node.node.args == ("b2",)


def test_a_time_condition_holds_after_its_time_without_a_break() -> None:
    """`for 2 s` arrives as a timer event; a break starts it anew."""
    engine = Engine(TWO_ARMS)
    engine.change([("b1.weight", 9.0), ("b1.clean", True), ("line.speed", 0.0)], "world", 0.0)
    engine.allocate([Call("pack", ("b1",))], 0.0)
    assert not engine.state.attempts
    assert engine.state.next_timer() == 2.0
    engine.change([("b1.packed", True)], "world", 1.0)
    engine.change([("b1.packed", False)], "world", 1.5)
    engine.allocate([Call("pack", ("b1",))], 1.5)
    engine.tick(2.0)
    assert not engine.state.attempts
    step = engine.tick(3.5)
    assert [type(event).__name__ for event in step.events] == ["Ticked", "Started"]
    assert list(engine.state.spans.since().values()) == [1.5]


@pytest.mark.parametrize(
    ("act", "message"),
    [
        (
            lambda e: e.allocate([Call("stroe", ("b1",))], 0.0),
            "tasks: unknown task 'stroe'; did you mean 'store'?",
        ),
        (
            lambda e: e.allocate([Call("store", ())], 0.0),
            "store(): store takes 1 arguments, 0 given; expected store(Box)",
        ),
        (
            lambda e: e.change([("b1.takn", True)], "camera", 0.0),
            "camera: b1.takn: no fact is called 'takn'; did you mean 'taken'?",
        ),
        (
            lambda e: e.change([("b1.taken", "yes")], "camera", 0.0),
            "camera: b1.taken: 'yes' is no value for it; expected flag",
        ),
        (
            lambda e: e.change([("arm.at", "b1")], "camera", 0.0),
            "camera: arm.at: 'arm' has no fact 'at'; there is: kr60",
        ),
        (
            lambda e: e.change([("b1.attempts", float("nan"))], "camera", 0.0),
            "camera: b1.attempts: nan is no value for it; expected number",
        ),
        (lambda e: e.withdraw(7, "x", 0.0), "trees: no tree 7; there is none"),
    ],
)
def test_what_the_task_file_does_not_know_is_refused(act: object, message: str) -> None:
    """One clear error, and nothing has happened."""
    engine = Engine(STORE)
    assert callable(act)
    with pytest.raises(TaskError) as caught:
        act(engine)
    assert str(caught.value) == message
    assert not engine.state.trees
    assert not engine.state.facts
