"""Planted hazards, each found with a shortest way to it that can be walked again."""

import time
from collections import deque
from importlib.resources import files
from pathlib import Path

import pytest

from depal.errors import TaskError
from depal.executive.exploring import (
    Exploration,
    Hazard,
    HazardKind,
    TraceStep,
    explore,
    together,
)
from depal.executive.exploring.model import Model
from depal.executive.exploring.moves import Moves, Rules, State
from depal.executive.language import parse, read_tasks
from depal.executive.schema import Repository
from depal.executive.tree import ground

STORE = Path(str(files("depal.cell.tasks") / "store.task"))

FACTS = """
fact Box.a : flag
fact Box.b : flag
fact Box.done : flag
fact Box.floor : flag
fact Box.weight : number?
fact arm.at : Box | place ?
resource arm capacity 1
resource hand capacity 1
"""

DEAD_END = """
task work(Box) until Box.done
  - first(Box)   when not Box.b
  - second(Box)  when Box.a and Box.b
action first(Box) until Box.a uses arm sets Box.a
action second(Box) until Box.done uses arm sets Box.done, Box.b
"""

LIVELOCK = """
task work(Box) until Box.done
  - there(Box)  when not Box.a
  - back(Box)   when Box.a
  - end(Box)    when Box.a and Box.b
action there(Box) until Box.a uses arm sets Box.a
action back(Box) until not Box.a uses arm sets Box.a
action end(Box) until Box.done uses arm sets Box.done, Box.b
"""

CLASH = """
task work(Box) until Box.done
  - left(Box)
  - right(Box)
  - end(Box)  when Box.a and Box.b
action left(Box) until Box.a uses arm sets Box.a, arm.at
action right(Box) until Box.b uses hand sets Box.b, arm.at
action end(Box) until Box.done uses arm, hand sets Box.done
"""

KEPT = """
task work(Box) until Box.done
  - hold(Box)
  - help(Box)  when Box.a
task hold(Box) until Box.done keeps arm
  - first(Box)
  - last(Box)  when Box.b
action first(Box) until Box.a uses arm sets Box.a
action help(Box) until Box.b uses arm sets Box.b
action last(Box) until Box.done uses arm sets Box.done
"""


def explored(text: str, **rules: bool) -> Exploration:
    """Every state of `work(b1)`."""
    return explore(parse(FACTS + text, "test.task"), "work", ["b1"], **rules)  # type: ignore[arg-type]


def the_hazard(found: Exploration, kind: HazardKind) -> Hazard:
    """The nearest hazard of a kind."""
    return next(one for one in found.hazards if one.kind is kind)


def replayed(repository: Repository, task: str, hazard: Hazard, rules: Rules) -> list[State]:
    """The states that a trace leads through; each step must be allowed in the state before."""
    model = Model(repository, ground(repository, task, ["b1"]))
    moves = Moves(model, rules)

    def agrees(state: State, step: TraceStep) -> bool:
        named = model.named(state.facts)
        return step.running == tuple(moves.labels[place] for place in state.running) and all(
            named[key] == value for key, value in step.facts.items()
        )

    # Of a change that comes in parts a step names the first alone: several moves may be meant.
    paths = [[moves.first(model.unset)]]
    for step in hazard.trace:
        paths = [
            [*path, move.after]
            for path in paths
            for move in (*moves.after(path[-1]), *moves.by_the_world(path[-1]))
            if move.what == step.what and agrees(move.after, step)
        ]
        assert paths
    return paths[0]


def distance(repository: Repository, task: str, goal: State, rules: Rules) -> int:
    """How far a state is, by a plain search."""
    model = Model(repository, ground(repository, task, ["b1"]))
    moves = Moves(model, rules)
    seen = {moves.first(model.unset): 0}
    frontier = deque(seen)
    while frontier:
        here = frontier.popleft()
        if here == goal:
            return seen[here]
        for move in moves.after(here):
            if move.after not in seen:
                seen[move.after] = seen[here] + 1
                frontier.append(move.after)
    pytest.fail("the state is out of reach")


def test_the_papers_store_has_no_hazard() -> None:
    """Every state is seen, crashes included."""
    found = explore(read_tasks(STORE), "store", ["b1"])
    assert found.complete
    assert found.hazards == ()
    assert found.idle == ()
    assert found.waits == ()
    assert found.states > found.valuations > 30


def test_a_dead_end_is_found_with_its_reason() -> None:
    """Nothing in the tree sets what the second step needs: `Box.b` comes too late."""
    hazard = the_hazard(explored(DEAD_END), HazardKind.DEAD_END)
    assert hazard.what == "first(b1) is accomplished; second(b1) needs b1.a and b1.b"
    assert [step.what for step in hazard.trace] == [
        "first(b1) starts",
        "first(b1) ends: b1.a := true",
    ]
    replayed(parse(FACTS + DEAD_END, "test.task"), "work", hazard, Rules())


def test_a_livelock_is_found_with_those_that_take_part() -> None:
    """Two actions undo one another."""
    found = explored(LIVELOCK)
    hazard = the_hazard(found, HazardKind.LIVELOCK)
    assert hazard.what == "back(b1), there(b1) run on and on, and work(b1) is never accomplished"
    assert hazard.trace == ()
    assert [one.kind for one in found.hazards] == [HazardKind.LIVELOCK]
    assert found.idle == ("end(b1)",)


def test_two_that_may_set_the_same_fact_at_once_break_the_exclusion() -> None:
    """They share no resource, but both move the arm."""
    hazard = the_hazard(explored(CLASH), HazardKind.EXCLUSION)
    assert hazard.what == "left(b1) and right(b1) run at once, and each may set arm.at"
    assert len(hazard.trace) == 2


def test_a_resource_is_never_used_beyond_its_capacity() -> None:
    """Actions that claim one arm do not run at once, whatever happens."""
    text = CLASH.replace("uses hand", "uses arm")
    assert not [one for one in explored(text).hazards if one.kind is HazardKind.EXCLUSION]


def test_a_kept_resource_that_somebody_outside_needs_is_a_dead_end() -> None:
    """The keeper waits for help that waits for the keeper."""
    hazard = the_hazard(explored(KEPT), HazardKind.DEAD_END)
    assert "help(b1) waits for arm, kept by hold(b1)" in hazard.what
    assert not explored(KEPT.replace(" keeps arm", "")).hazards


def test_split_changes_send_the_robot_back_for_the_box_that_it_has_put_down() -> None:
    """The hazard for which changes are atomic; its trace is a shortest one and replays."""
    repository = read_tasks(STORE)
    rules = Rules(atomic=False)
    found = explore(repository, "store", ["b1"], atomic=False)
    hazard = next(one for one in found.hazards if one.what.startswith("kr60_grasp(b1)"))
    assert hazard.kind is HazardKind.HALF_CHANGE
    assert hazard.what == "kr60_grasp(b1) starts before b1.stored has arrived"
    assert hazard.trace[-1].what == "kr60_grasp(b1) starts"
    assert any("kr60_release(b1) ends: b1.taken := false" in one.what for one in hazard.trace)
    states = replayed(repository, "store", hazard, rules)
    assert distance(repository, "store", states[-1], rules) == len(hazard.trace)


def test_every_trace_to_a_hazard_is_a_shortest_one() -> None:
    """Against a plain search."""
    for text in (DEAD_END, LIVELOCK, KEPT, CLASH):
        repository = parse(FACTS + text, "test.task")
        for hazard in explored(text).hazards:
            states = replayed(repository, "work", hazard, Rules())
            assert distance(repository, "work", states[-1], Rules()) == len(hazard.trace)


def test_a_held_box_that_slips_is_taken_again() -> None:
    """A disturbance makes more states and no hazard."""
    calm = explore(read_tasks(STORE), "store", ["b1"])
    shaken = explore(read_tasks(STORE), "store", ["b1"], disturbances={"Box.taken": [False]})
    assert shaken.states > calm.states
    assert shaken.hazards == ()


def test_a_box_on_the_floor_waits_for_a_person() -> None:
    """The task goes on only when somebody has picked it up: no hazard, but a wait."""
    found = explore(read_tasks(STORE), "store", ["b1"], disturbances=["Box.on_floor"])
    assert [one.what for one in found.waits] == ["not b1.on_floor"]
    assert found.hazards == ()


def test_a_disturbance_that_the_task_does_not_know_is_refused() -> None:
    """With what was meant."""
    with pytest.raises(TaskError, match=r"mentions 'Box.takn'; did you mean 'Box.taken'\?"):
        explore(read_tasks(STORE), "store", ["b1"], disturbances=["Box.takn"])
    with pytest.raises(TaskError, match=r"Box\.taken is never told apart as 'blue'"):
        explore(read_tasks(STORE), "store", ["b1"], disturbances={"Box.taken": ["blue"]})


def test_what_nobody_sets_is_awaited_from_the_world() -> None:
    """It is no dead end."""
    text = "task work(Box) until Box.done\n  - end(Box)  when Box.a and Box.b\n"
    text += "action end(Box) until Box.done sets Box.done\n"
    found = explored(text)
    assert found.hazards == ()
    assert [one.what for one in found.waits] == ["b1.a and b1.b"]


def test_a_task_with_nothing_to_do_at_first_is_given_something() -> None:
    """A recovery is explored from the fault that calls for it."""
    text = "task work(Box) until not Box.floor\n  - lift(Box)\n"
    text += "action lift(Box) until not Box.floor sets Box.floor\n"
    found = explored(text)
    assert found.states > 1
    assert found.idle == ()


def test_retries_that_are_used_up_are_a_matter_for_a_person() -> None:
    """Counted, no hazard; with crashes and without."""
    text = "task work(Box) until Box.done\n  - end(Box)\n"
    text += "action end(Box) until Box.done sets Box.done retries 3\n"
    assert explored(text).attended == 1
    assert explored(text, crashes=False).hazards == ()


def test_numbers_are_told_apart_at_their_limits() -> None:
    """Below, at and above; the heavy box is never lifted."""
    text = "task work(Box) until Box.done\n  - weigh(Box)  when not Box.weight\n"
    text += "  - lift(Box)  when Box.weight < 5\n"
    text += "action weigh(Box) until Box.weight sets Box.weight\n"
    text += "action lift(Box) until Box.done sets Box.done\n"
    found = explored(text)
    hazard = the_hazard(found, HazardKind.DEAD_END)
    assert "lift(b1) needs b1.weight < 5" in hazard.what
    assert any(step.facts.get("b1.weight") in {5.0, 6.0} for step in hazard.trace)


def test_a_time_condition_comes_true_in_its_time() -> None:
    """And only while what lasts holds."""
    text = "task work(Box) until Box.done\n  - first(Box)\n  - end(Box)  when Box.a for 2 s\n"
    text += "action first(Box) until Box.a sets Box.a\n"
    text += "action end(Box) until Box.done sets Box.done\n"
    found = explored(text)
    assert found.hazards == ()
    assert found.idle == ()


def test_a_policy_decides_whether_a_primitive_outlives_its_gate() -> None:
    """What may be broken off at once is; a suction stroke is not."""
    text = "task work(Box) until Box.done\n  - end(Box)  when not Box.floor\n"
    text += "action end(Box) until Box.done sets Box.done"
    repository = parse(f"{FACTS}{text}\n", "test.task")
    soft = explore(repository, "work", ["b1"], disturbances=["Box.floor"])
    repository = parse(f"{FACTS}{text} cancel never\n", "test.task")
    hard = explore(repository, "work", ["b1"], disturbances=["Box.floor"])
    assert hard.states > soft.states


def test_the_limit_is_kept_and_told() -> None:
    """What lies beyond it is no hazard."""
    found = explore(read_tasks(STORE), "store", ["b1"], limit=20)
    assert not found.complete
    assert 20 <= found.states < 40
    assert found.hazards == ()


def test_exploring_twice_gives_the_same() -> None:
    """Nothing depends on a hash."""
    runs = [explore(read_tasks(STORE), "store", ["b1"], atomic=False) for _ in range(2)]
    assert runs[0] == runs[1]


@pytest.mark.slow
def test_the_store_is_explored_within_its_time() -> None:
    """One second, with room for a slow machine."""
    repository = read_tasks(STORE)
    start = time.perf_counter()
    assert explore(repository, "store", ["b1"]).complete
    assert time.perf_counter() - start < 3.0


def test_two_stores_at_once_share_the_arm() -> None:
    """No dead end, no livelock, no fact that two may set at once; either may be the first."""
    repository, labels = together(read_tasks(STORE), [("store", ["b1"]), ("store", ["b2"])])
    found = explore(repository, "together", labels)
    assert found.task == "together(store(b1), store(b2))"
    assert found.complete
    assert not found.hazards
    assert not found.idle
    assert found.states > 20 * explore(read_tasks(STORE), "store", ["b1"]).states


def test_two_that_keep_what_the_other_needs_block_each_other() -> None:
    """Each alone is without fault."""
    text = """
task left(Box) until Box.a keeps arm
  - first(Box)
  - second(Box)  when Box.b
task right(Box) until Box.done keeps hand
  - third(Box)
  - fourth(Box)  when Box.floor
action first(Box) until Box.b uses arm sets Box.b
action second(Box) until Box.a uses arm, hand sets Box.a
action third(Box) until Box.floor uses hand sets Box.floor
action fourth(Box) until Box.done uses arm, hand sets Box.done
"""
    repository = parse(FACTS + text, "test.task")
    for name in ("left", "right"):
        assert not explore(repository, name, ["b1"]).hazards
    both, labels = together(repository, [("left", ["b1"]), ("right", ["b1"])])
    (hazard,) = explore(both, "together", labels).hazards
    assert hazard.kind is HazardKind.DEAD_END
    assert [one.what for one in hazard.trace if "starts" in one.what] == [
        "first(b1) starts",
        "third(b1) starts",
    ]


def test_what_cannot_be_called_cannot_be_called_together() -> None:
    """The same sentences."""
    with pytest.raises(TaskError, match=r"unknown task 'stroe'; did you mean 'store'\?"):
        together(read_tasks(STORE), [("store", ["b1"]), ("stroe", ["b2"])])
