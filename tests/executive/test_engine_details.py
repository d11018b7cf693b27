"""Details of evaluation, arbitration and folding that a random run seldom reaches."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from worlds import STORE

from depal.executive import conditions as c
from depal.executive import events as ev
from depal.executive.atoms import Atoms, Subject, filled, members, stand_ins
from depal.executive.emphasis import EmphasisWeights, rank, resting_emphasis
from depal.executive.engine import Call, Engine, Report, Step
from depal.executive.events import Outcome
from depal.executive.language import parse
from depal.executive.nodes import Attempt
from depal.executive.schema import Repository
from depal.executive.snapshot import freeze, thaw
from depal.executive.timers import Timers

HEAD = """
fact Box.a : flag
fact Box.b : flag
fact Box.c : flag
fact Box.stop : flag
fact Box.fault : text?
fact Box.attempts : number
resource arm capacity 2
resource hand capacity 1
resource belt capacity 1
"""


def tasks(text: str) -> Repository:
    """Schemata over three flags of a box, an arm of two units, a hand and a belt."""
    return parse(HEAD + text, "details")


def running(engine: Engine) -> list[str]:
    """What runs, in the order of its start."""
    return [attempt.node.node.label for attempt in engine.state.attempts.values()]


def kinds(step: Step) -> list[str]:
    """The kinds of a step's events."""
    return [type(event).__name__ for event in step.events]


def attempt_of(engine: Engine, label: str) -> Attempt:
    """The one attempt of a node that runs."""
    (found,) = (a for a in engine.state.attempts.values() if a.node.node.label == label)
    return found


def end(engine: Engine, label: str, outcome: Outcome, at: float, *done: str) -> Step:
    """A running primitive ends and has set some flags."""
    facts = tuple((key, True) for key in done)
    return engine.report(attempt_of(engine, label).number, Report(facts, outcome), at)


# Conditions

KEYS = ("x.p", "x.q", "y.p", "y.q")
VALUES = st.sampled_from([None, False, True, 0.0, 1.0, 2.0, "x", "y"])
FACTS = st.dictionaries(st.sampled_from(KEYS), VALUES)
SUBJECTS = st.sampled_from([c.Var("X"), c.Var("Y"), c.Literal("x")])
REFERENCES = st.builds(c.FactRef, SUBJECTS, st.sampled_from(["p", "q"]))
OTHERS = st.one_of(
    REFERENCES,
    st.just(c.Var("X")),
    st.builds(c.Literal, st.sampled_from([0.0, 1.0, 2.0, "x", "y"])),
)
CONDITIONS: st.SearchStrategy[c.Condition] = st.recursive(
    st.one_of(
        st.just(c.ALWAYS),
        st.builds(c.Holds, REFERENCES),
        st.builds(c.Compare, REFERENCES, st.sampled_from(sorted(c.COMPARISONS)), OTHERS),
    ),
    lambda inner: st.one_of(
        st.builds(c.Not, inner),
        st.lists(inner, min_size=2, max_size=4).map(lambda parts: c.AllOf(tuple(parts))),
        st.lists(inner, min_size=2, max_size=4).map(lambda parts: c.AnyOf(tuple(parts))),
    ),
    max_leaves=6,
)
BINDING = {"X": "x", "Y": "y"}


class Read:
    """A condition, read once for all things."""

    def __init__(self, condition: c.Condition, facts: dict[str, c.Value]) -> None:
        """Reads it for stand-ins."""
        self.atoms = Atoms(facts)
        binding = dict(zip(("X", "Y"), stand_ins(2), strict=True))
        self.formula, self.mentioned = self.atoms.read(condition, binding)

    def subject(self, *things: str) -> Subject:
        """Some things."""
        return Subject(filled(self.atoms.words)(things), ())

    def holds(self, *things: str) -> bool:
        """Its value for them."""
        true = 0
        for number, atom in enumerate(self.atoms.found):
            true |= atom.test(self.subject(*things)) << number
        return self.formula(true)

    def watches(self, *things: str) -> list[object]:
        """What it is told of."""
        subject = self.subject(*things)
        atoms = [self.atoms.found[number] for number in members(self.mentioned)]
        return [watch for atom in atoms for watch in atom.watches(subject)]


@given(CONDITIONS, FACTS, st.sampled_from(KEYS), VALUES)
def test_a_grounded_condition_means_what_the_written_one_means(
    condition: c.Condition, facts: dict[str, c.Value], key: str, value: c.Value
) -> None:
    """Before and after any change, and whoever's value has changed was to be told of it."""
    read = Read(condition, facts)
    before, old = read.holds("x", "y"), facts.get(key)
    assert before is c.holds(condition, facts, BINDING, c.at_once)
    facts[key] = value
    assert read.holds("x", "y") is c.holds(condition, facts, BINDING, c.at_once)
    assert read.holds("y", "x") is c.holds(condition, facts, {"X": "y", "Y": "x"}, c.at_once)
    if read.holds("x", "y") != before:
        assert {key, (key, old), (key, value)} & set(read.watches("x", "y"))


@pytest.mark.parametrize("op", sorted(c.COMPARISONS))
@pytest.mark.parametrize("left", [None, False, True, 1.0, 2.0, 3.0, "x", "y"])
@pytest.mark.parametrize("right", [2.0, "x"])
def test_a_grounded_comparison_means_what_the_written_one_means(
    op: str, left: c.Value, right: float | str
) -> None:
    """Every operator, with numbers, names and nothing on the left."""
    fact = c.FactRef(c.Literal("x"), "p")
    condition = c.Compare(fact, op, c.Literal(right))
    holds = Read(condition, {"x.p": left}).holds("x", "y")
    assert holds is c.holds(condition, {"x.p": left}, BINDING, c.at_once)


def test_a_comparison_with_one_value_is_not_told_of_others() -> None:
    """So a thousand trees that wait for `kr60.at` are not all looked at when it moves."""
    at = c.FactRef(c.Literal("kr60"), "at")
    for op in ("=", "!="):
        assert Read(c.Compare(at, op, c.Var("X")), {}).watches("b1", "b2") == [("kr60.at", "b1")]
    assert Read(c.Compare(at, "<", c.Literal(2.0)), {}).watches("b1", "b2") == ["kr60.at"]


def test_only_what_names_the_first_argument_is_a_trees_own() -> None:
    """All else may be shared by a thousand trees; such atoms are watched while they matter."""
    taken, full = c.FactRef(c.Var("X"), "p"), c.FactRef(c.Var("Y"), "p")
    at = c.FactRef(c.Literal("kr60"), "at")
    for condition, own in (
        (c.Holds(taken), True),
        (c.Compare(taken, "=", c.Var("Y")), True),
        (c.Holds(full), False),
        (c.Holds(at), False),
        (c.Compare(taken, "=", full), False),
        (c.Compare(at, "=", c.Var("X")), True),
        (c.Compare(at, "=", c.Var("Y")), False),
        (c.Compare(at, "=", c.Literal("reader")), False),
        (c.Compare(at, "=", taken), False),
    ):
        assert [atom.own for atom in Read(condition, {}).atoms.found] == [own]


@given(CONDITIONS, CONDITIONS)
def test_what_is_the_same_for_all_things_is_one_atom(one: c.Condition, two: c.Condition) -> None:
    """Whichever condition mentions it, and under whichever name of a parameter."""
    atoms = Atoms({})
    x, y = stand_ins(2)
    atoms.read(c.AllOf((one, two)), {"X": x, "Y": y})
    before = len(atoms.found)
    atoms.read(two, {"X": x, "Y": y})
    assert len(atoms.found) == before


# Time

moments = st.floats(0, 10, allow_nan=False)


@given(st.lists(moments, max_size=12), moments, st.sets(st.integers(0, 11)))
def test_timers_come_up_soonest_first_and_in_the_order_of_their_setting(
    at: list[float], now: float, stale: set[int]
) -> None:
    """Those that have lost their meaning never do, neither as the next nor as due."""
    timers: Timers[int] = Timers(lambda _, number: number in stale)
    for number, moment in enumerate(at):
        timers.set(moment, number)
    fresh = [(moment, number) for number, moment in enumerate(at) if number not in stale]
    assert timers.next() == min((moment for moment, _ in fresh), default=None)
    assert list(timers.due(now)) == [number for moment, number in sorted(fresh) if moment <= now]
    assert timers.next() == min((moment for moment, _ in fresh if moment > now), default=None)


LASTING = tasks(
    """
action wait(Box) when Box.a for 2 s until Box.b uses hand sets Box.b
action work(Box) when not (Box.a for 2 s) until Box.b uses hand sets Box.b
action both(Box) when (Box.a for 2 s) for 3 s until Box.b uses hand sets Box.b
"""
)


def test_a_time_condition_is_kept_while_a_tree_mentions_it() -> None:
    """Two trees share one; after the last of them it is forgotten, and starts anew."""
    engine = Engine(LASTING)
    engine.change([("b1.a", True)], "world", 0.0)
    engine.allocate([Call("wait", ("b1",)), Call("wait", ("b1",))], 1.0)
    assert len(engine.state.spans.since()) == 1
    engine.withdraw(1, "enough", 1.5)
    assert list(engine.state.spans.since().values()) == [1.0]
    assert engine.state.next_timer() == 3.0
    engine.withdraw(2, "enough", 2.0)
    assert engine.state.spans.since() == {}
    assert engine.state.next_timer() is None
    engine.allocate([Call("wait", ("b1",))], 2.5)
    assert engine.state.next_timer() == 4.5
    engine.change([("b1.a", False)], "world", 4.0)
    assert engine.state.spans.since() == {}
    assert engine.state.next_timer() is None
    assert not running(engine)


def test_a_time_condition_inside_another_starts_it() -> None:
    """Three seconds after the two, and a break ends both."""
    engine = Engine(LASTING)
    engine.allocate([Call("both", ("b1",))], 0.0)
    engine.change([("b1.a", True)], "world", 1.0)
    assert engine.state.next_timer() == 3.0
    engine.tick(3.0)
    assert engine.state.next_timer() == 6.0
    assert not running(engine)
    assert kinds(engine.tick(6.0)) == ["Ticked", "Started"]
    step = engine.change([("b1.a", False)], "world", 7.0)
    assert kinds(step) == ["Changed", "CancelAsked"]


def test_a_gate_that_opens_again_in_the_same_step_stops_nothing() -> None:
    """The time condition is due just when its fact is withdrawn."""
    engine = Engine(LASTING)
    engine.change([("b1.a", True)], "world", 0.0)
    engine.allocate([Call("work", ("b1",))], 0.0)
    assert running(engine) == ["work(b1)"]
    step = engine.change([("b1.a", False)], "world", 2.0)
    assert kinds(step) == ["Ticked", "Changed"]
    assert attempt_of(engine, "work(b1)").cancel is None


LIMITED = tasks(
    """
action soft(Box) until Box.a uses hand sets Box.a
    timeout 5 s retries 2 backoff 3 s
action hard(Box) until Box.a uses hand sets Box.a
    cancel never timeout 5 s retries 1 backoff 1 s
action free(Box) until Box.a uses hand sets Box.a
"""
)


def test_only_an_action_with_a_time_out_sets_a_timer() -> None:
    """It is broken off then; ten seconds later that has failed too, and a person is called."""
    engine = Engine(LIMITED)
    engine.allocate([Call("free", ("b1",))], 1.0)
    assert engine.state.next_timer() is None
    engine = Engine(LIMITED)
    engine.allocate([Call("soft", ("b1",))], 1.0)
    assert engine.state.next_timer() == 6.0
    assert kinds(engine.tick(5.9)) == []
    assert kinds(engine.tick(6.0)) == ["Ticked", "CancelAsked"]
    assert engine.state.next_timer() == 16.0
    assert engine.state.facts.get("b1.fault") is None
    engine.tick(16.0)
    assert engine.state.facts["b1.fault"] == "soft"
    assert engine.state.next_timer() is None


def test_an_attempt_that_ends_takes_its_time_out_along() -> None:
    """Whatever runs next has its own."""
    engine = Engine(LIMITED)
    engine.allocate([Call("soft", ("b1",)), Call("soft", ("b2",))], 0.0)
    end(engine, "soft(b1)", Outcome.DONE, 4.0, "b1.a")
    assert running(engine) == ["soft(b2)"]
    assert engine.state.next_timer() == 9.0


def test_what_may_not_be_broken_off_is_a_fault_as_soon_as_its_time_is_over() -> None:
    """It goes on and keeps its resource; even when it then fails nothing is tried again."""
    engine = Engine(LIMITED)
    engine.allocate([Call("hard", ("b1",)), Call("free", ("b2",))], 0.0)
    engine.tick(5.0)
    assert engine.state.facts["b1.fault"] == "hard"
    assert engine.state.next_timer() is None
    end(engine, "hard(b1)", Outcome.FAILED, 6.0)
    assert running(engine) == ["free(b2)"]
    end(engine, "free(b2)", Outcome.DONE, 7.0, "b2.a")
    assert running(engine) == []
    engine.change([("b1.fault", None)], "person", 8.0)
    assert running(engine) == ["hard(b1)"]


# Failures


@given(st.integers(0, 4), st.sampled_from([0.5, 1.0, 3.0]))
def test_each_retry_waits_twice_as_long_and_then_it_is_a_fault(
    retries: int, backoff: float
) -> None:
    """Not a moment sooner, and once more than there are retries."""
    head = "action act(Box) until Box.a uses hand sets Box.a"
    engine = Engine(tasks(f"{head} retries {retries} backoff {backoff} s\n"))
    engine.allocate([Call("act", ("b1",))], 0.0)
    now = 0.0
    for failed in range(1, retries + 1):
        now += 1.0
        end(engine, "act(b1)", Outcome.FAILED, now)
        assert engine.state.facts.get("b1.attempts") == failed
        assert running(engine) == []
        due = now + backoff * 2 ** (failed - 1)
        assert engine.state.next_timer() == due
        assert kinds(engine.change([("b1.c", bool(failed % 2))], "world", due - 0.1)) == ["Changed"]
        now = due
        assert kinds(engine.tick(now)) == ["Ticked", "Started"]
    end(engine, "act(b1)", Outcome.FAILED, now)
    assert engine.state.facts["b1.fault"] == "act"
    assert engine.state.next_timer() is None
    engine.retry(1, 0, now)
    assert running(engine) == ["act(b1)"]
    end(engine, "act(b1)", Outcome.DONE, now, "b1.a")
    assert engine.state.facts.get("b1.attempts") is None
    assert not engine.state.trees


@pytest.mark.parametrize(
    ("outcome", "attempts", "fault"),
    [
        (Outcome.DONE, 1.0, None),
        (Outcome.FAILED, 1.0, None),
        (Outcome.TIMEOUT, 1.0, None),
        (Outcome.UNDECLARED, 1.0, None),
        (Outcome.CANCELLED, None, None),
        (Outcome.PROBED, None, None),
        (Outcome.UNKNOWN, None, "soft"),
    ],
)
def test_what_an_end_without_effect_means(
    outcome: Outcome, attempts: float | None, fault: str | None
) -> None:
    """A failure, no failure, or a fault at once."""
    engine = Engine(LIMITED)
    engine.allocate([Call("soft", ("b1",))], 0.0)
    end(engine, "soft(b1)", outcome, 1.0)
    assert engine.state.facts.get("b1.attempts") == attempts
    assert engine.state.facts.get("b1.fault") == fault
    again = attempts is None and fault is None
    assert running(engine) == (["soft(b1)"] if again else [])


def test_a_success_forgets_the_failures_before_it() -> None:
    """The world made the effect and unmade it: the next failure is the first again."""
    engine = Engine(tasks("task t(Box) until Box.b\n  - soft(Box)\n" + _SOFT))
    engine.allocate([Call("t", ("b1",))], 0.0)
    end(engine, "soft(b1)", Outcome.FAILED, 1.0)
    assert engine.state.next_timer() == 4.0
    engine.change([("b1.a", True)], "world", 2.0)
    engine.change([("b1.a", False)], "world", 5.0)
    end(engine, "soft(b1)", Outcome.FAILED, 6.0)
    assert engine.state.next_timer() == 9.0


_SOFT = """
action soft(Box) until Box.a uses hand sets Box.a
    timeout 5 s retries 2 backoff 3 s
"""


def test_a_fault_survives_a_snapshot_and_can_still_be_cleared() -> None:
    """And so does a deadline that runs."""
    engine = Engine(tasks(_SOFT.replace("retries 2", "retries 0")))
    engine.allocate([Call("soft", ("b1",))], 0.0)
    end(engine, "soft(b1)", Outcome.FAILED, 1.0)
    engine.state = thaw(engine.repository, engine.state.weights, freeze(engine.state))
    assert running(engine) == []
    assert not engine.state.waiting
    engine.change([("b1.fault", None)], "person", 2.0)
    assert running(engine) == ["soft(b1)"]
    engine.state = thaw(engine.repository, engine.state.weights, freeze(engine.state))
    assert engine.state.next_timer() == 7.0
    assert kinds(engine.tick(7.0)) == ["Ticked", "CancelAsked"]


def test_a_fault_whose_tree_has_ended_starts_nothing_when_it_is_cleared() -> None:
    """The new tree of the same box is forgiven, the old one forgotten."""
    engine = Engine(tasks(_SOFT.replace("retries 2", "retries 0")))
    engine.allocate([Call("soft", ("b1",))], 0.0)
    end(engine, "soft(b1)", Outcome.FAILED, 1.0)
    assert len(engine.state.faults) == 1
    engine.withdraw(1, "enough", 2.0)
    assert engine.state.trees == {}
    assert len(engine.state.faults) == 0
    step = engine.change([("b1.fault", None)], "person", 3.0)
    assert kinds(step) == ["Changed"]
    assert not engine.state.waiting


def test_trees_and_attempts_are_numbered_one_after_the_other() -> None:
    """From one, also across steps."""
    engine = Engine(LIMITED)
    engine.allocate([Call("soft", ("b1",)), Call("soft", ("b2",))], 0.0)
    engine.allocate([Call("soft", ("b3",))], 0.0)
    assert list(engine.state.trees) == [1, 2, 3]
    for number in (1, 2, 3):
        assert list(engine.state.attempts) == [number]
        end(engine, f"soft(b{number})", Outcome.DONE, 1.0, f"b{number}.a")
    assert (engine.state.next_tree, engine.state.next_attempt) == (4, 4)


def test_a_restart_gives_every_attempt_its_time_again() -> None:
    """Held, in doubt where it may not be repeated."""
    repository = tasks(
        "action move(Box) until Box.a uses arm sets Box.a timeout 5 s probe eye\n"
        "action tell(Box) until Box.b uses arm sets Box.b timeout 7 s idempotent\n"
    )
    engine = Engine(repository)
    engine.allocate([Call("move", ("b1",)), Call("tell", ("b2",))], 0.0)
    engine.restart(3.0)
    assert engine.state.held
    move, tell = engine.state.attempts.values()
    assert (move.in_doubt, tell.in_doubt) == (True, False)
    assert (move.deadline, tell.deadline) == (8.0, 10.0)
    assert engine.state.next_timer() == 8.0


# Emphasis

TREE = tasks(
    """
task t(Box) until Box.b
  - u(Box) bias 0.5
task u(Box) until Box.b
  - act(Box) bias 0.25
action act(Box) until Box.a uses hand sets Box.a
"""
)


def test_emphasis_is_a_weighted_sum_along_the_branch() -> None:
    """e(n) = w_bias bias + w_parent e(parent), with the priority at the root."""
    weights = EmphasisWeights(priority=2.0, bias=3.0, parent=0.5, age=0.25, margin=0.1)
    engine = Engine(TREE, weights)
    engine.hold("person", 0.0)
    engine.allocate([Call("t", ("b1",), 0.75)], 4.0)
    root, middle, leaf = engine.state.trees[1].nodes
    assert resting_emphasis(root, weights) == 1.5
    assert resting_emphasis(middle, weights) == 1.5 + 0.75
    assert resting_emphasis(leaf, weights) == 0.75 + 0.5 * 2.25
    assert rank(leaf, weights) == 0.75 + 0.5 * 2.25 - 1.0


def test_equals_go_in_the_order_of_trees_and_steps() -> None:
    """No randomness: lower places first."""
    engine = Engine(LIMITED)
    engine.hold("person", 0.0)
    calls = [Call("soft", ("b1",)), Call("free", ("b2",)), Call("hard", ("b3",))]
    engine.allocate(calls, 0.0)
    engine.start("person", 0.0)
    order = []
    while engine.state.attempts:
        (label,) = running(engine)
        order.append(label)
        end(engine, label, Outcome.DONE, 1.0, f"{label[-3:-1]}.a")
    assert order == ["soft(b1)", "free(b2)", "hard(b3)"]


def test_a_new_priority_counts_at_once_for_whoever_waits() -> None:
    """Up and down."""
    engine = Engine(LIMITED)
    calls = [Call("free", (f"b{i}",), p) for i, p in enumerate((0.9, 0.3, 0.2, 0.1))]
    engine.allocate(calls, 0.0)
    engine.prioritise(4, 0.4, 1.0)
    engine.prioritise(2, 0.0, 1.0)
    order = []
    while engine.state.attempts:
        (label,) = running(engine)
        order.append(label)
        end(engine, label, Outcome.DONE, 2.0, f"{label[-3:-1]}.a")
    assert order == ["free(b0)", "free(b3)", "free(b2)", "free(b1)"]


# Displacement

RIVALS = tasks(
    """
action slow(Box) until Box.a uses arm sets Box.a
    cancel at_checkpoint
action fixed(Box) until Box.a uses arm sets Box.a
    cancel never
action lone(Box) until Box.b uses hand sets Box.b
"""
)
EXACT = EmphasisWeights(age=0.125, margin=0.25)


def test_a_challenger_must_exceed_the_holder_by_more_than_the_margin() -> None:
    """Its age counts, the holder's does not."""
    engine = Engine(RIVALS, EXACT)
    engine.allocate([Call("lone", ("b1",), 0.5)], 0.0)
    engine.allocate([Call("lone", ("b2",), 0.5)], 1.0)
    engine.change([("b9.a", True)], "world", 3.0)
    assert attempt_of(engine, "lone(b1)").cancel is None  # two seconds make 0.25 exactly
    step = engine.change([("b9.a", False)], "world", 4.0)
    assert kinds(step) == ["Changed", "CancelAsked"]
    assert attempt_of(engine, "lone(b1)").cancel == "lone(b2) is more urgent"
    end(engine, "lone(b1)", Outcome.CANCELLED, 5.0)
    assert running(engine) == ["lone(b2)"]


def test_with_the_usual_weights_an_equal_waits_for_200_seconds() -> None:
    """A thousandth per second, against a margin of a fifth."""
    engine = Engine(RIVALS)
    engine.allocate([Call("lone", ("b1",), 0.5), Call("lone", ("b2",), 0.5)], 0.0)
    engine.change([("b9.a", True)], "world", 199.0)
    assert attempt_of(engine, "lone(b1)").cancel is None
    engine.change([("b9.a", False)], "world", 201.0)
    assert attempt_of(engine, "lone(b1)").cancel == "lone(b2) is more urgent"


def test_the_weakest_holder_gives_way() -> None:
    """Not the first, and not the one that may not be broken off."""
    engine = Engine(RIVALS, EXACT)
    engine.allocate([Call("slow", ("b1",), 0.3), Call("slow", ("b2",), 0.2)], 0.0)
    engine.allocate([Call("slow", ("b3",), 1.0)], 0.0)
    assert attempt_of(engine, "slow(b1)").cancel is None
    assert attempt_of(engine, "slow(b2)").cancel == "slow(b3) is more urgent"
    engine = Engine(RIVALS, EXACT)
    engine.allocate([Call("slow", ("b1",), 0.3), Call("fixed", ("b2",), 0.2)], 0.0)
    engine.allocate([Call("slow", ("b3",), 1.0)], 0.0)
    assert attempt_of(engine, "slow(b1)").cancel == "slow(b3) is more urgent"
    assert attempt_of(engine, "fixed(b2)").cancel is None


# Claims and keepers

CLAIMS = tasks(
    """
action small(Box) until Box.a uses hand sets Box.a
    cancel never
action other(Box) until Box.a uses belt sets Box.a
    cancel never
action large(Box) until Box.b uses hand, belt sets Box.b
    cancel never
"""
)


def test_a_large_claim_reserves_what_is_free_of_it() -> None:
    """A smaller one with less emphasis waits, one with more goes first."""
    engine = Engine(CLAIMS)
    engine.allocate([Call("small", ("b1",), 0.5)], 0.0)
    engine.allocate([Call("large", ("b2",), 0.5)], 0.0)
    engine.allocate([Call("other", ("b3",), 0.4)], 0.0)
    assert running(engine) == ["small(b1)"]
    engine.allocate([Call("other", ("b4",), 0.6)], 0.0)
    assert running(engine) == ["small(b1)", "other(b4)"]
    end(engine, "small(b1)", Outcome.DONE, 1.0, "b1.a")
    assert running(engine) == ["other(b4)"]
    end(engine, "other(b4)", Outcome.DONE, 2.0, "b4.a")
    assert running(engine) == ["large(b2)"]
    end(engine, "large(b2)", Outcome.DONE, 3.0, "b2.b")
    assert running(engine) == ["other(b3)"]


KEEPING = tasks(
    """
task job(Box) when not Box.stop until Box.c keeps arm
  - one(Box)
  - two(Box) when Box.a
action one(Box) until Box.a uses arm sets Box.a
action two(Box) until Box.b uses arm sets Box.b
action aside(Box) until Box.a uses arm sets Box.a
"""
)


def kept(engine: Engine) -> list[str]:
    """Who keeps an arm."""
    return [node.node.label for name, node in engine.state.holdings.kept() if name == "arm"]


def test_a_keeper_holds_its_unit_between_two_uses() -> None:
    """Also one of several units; outsiders share what is left."""
    engine = Engine(KEEPING)
    engine.allocate([Call("job", ("b1",), 0.5)], 0.0)
    calls = [Call("aside", (f"b{i}",), 0.4) for i in (2, 3)]
    engine.allocate(calls, 0.0)
    assert kept(engine) == ["job(b1)"]
    assert running(engine) == ["one(b1)", "aside(b2)"]
    end(
        engine,
        "one(b1)",
        Outcome.DONE,
        1.0,
        "b1.a",
    )
    assert running(engine) == ["aside(b2)", "two(b1)"]
    end(engine, "two(b1)", Outcome.DONE, 2.0, "b1.b")
    assert running(engine) == ["aside(b2)"]
    engine.change([("b1.c", True)], "world", 3.0)
    assert kept(engine) == []
    assert running(engine) == ["aside(b2)", "aside(b3)"]


def test_keepers_of_every_unit_close_a_resource() -> None:
    """Inside them work goes on, however urgent it is outside."""
    engine = Engine(KEEPING)
    engine.allocate([Call("job", ("b1",)), Call("job", ("b2",))], 0.0)
    assert engine.state.holdings.closed == {"arm"}
    engine.allocate([Call("aside", ("b3",), 5.0), Call("job", ("b4",), 5.0)], 0.0)
    end(engine, "one(b1)", Outcome.DONE, 1.0, "b1.a")
    assert running(engine) == ["one(b2)", "two(b1)"]
    assert kept(engine) == ["job(b1)", "job(b2)"]
    end(engine, "two(b1)", Outcome.DONE, 2.0, "b1.b")
    assert running(engine) == ["one(b2)"]
    engine.change([("b1.stop", True)], "world", 3.0)
    assert running(engine) == ["one(b2)", "aside(b3)"]
    assert engine.state.holdings.closed == set()
    assert kept(engine) == ["job(b2)"]


def test_an_unchanged_fact_changes_nothing() -> None:
    """Neither since when it is so, nor anybody's state; a flag is no number."""
    engine = Engine(RIVALS)
    engine.change([("b1.a", True)], "world", 1.0)
    engine.change([("b1.a", True)], "world", 2.0)
    assert engine.state.changed_at == {"b1.a": 1.0}
    engine.change([("b1.a", True), ("b1.b", True)], "world", 3.0)
    assert engine.state.changed_at == {"b1.a": 1.0, "b1.b": 3.0}
    engine.state.apply(ev.Changed(4.0, (("b1.a", 1.0),), "world"))
    assert engine.state.changed_at == {"b1.a": 4.0, "b1.b": 3.0}


INSIDE = tasks(
    """
task job(Box) until Box.c keeps arm
  - one(Box)
  - grip(Box) when Box.a
task clasp(Box) until Box.c keeps hand
  - hold(Box) bias 0.3
  - press(Box) bias 0.1
  - turn(Box) bias 0.2
action one(Box) until Box.a uses arm sets Box.a
action grip(Box) until Box.b uses arm, hand sets Box.b
action hold(Box) until Box.a uses hand sets Box.a
action press(Box) until Box.b uses hand sets Box.b
action turn(Box) until Box.stop uses hand sets Box.stop
action aside(Box) until Box.a uses arm sets Box.a
action lay(Box) until Box.b uses belt sets Box.b
"""
)


def test_inside_a_keeper_the_best_goes_first() -> None:
    """By emphasis, not by place."""
    engine = Engine(INSIDE)
    engine.allocate([Call("clasp", ("b1",))], 0.0)
    assert running(engine) == ["hold(b1)"]
    end(engine, "hold(b1)", Outcome.DONE, 1.0, "b1.a")
    assert running(engine) == ["turn(b1)"]
    end(engine, "turn(b1)", Outcome.DONE, 2.0, "b1.stop")
    assert running(engine) == ["press(b1)"]


def test_what_waits_for_a_kept_resource_holds_nobody_up() -> None:
    """However urgent: its keeper may need the rest."""
    engine = Engine(INSIDE)
    engine.allocate([Call("clasp", ("b2",))], 0.0)
    engine.allocate([Call("job", ("b1",), 5.0)], 0.0)
    end(engine, "one(b1)", Outcome.DONE, 1.0, "b1.a")
    assert running(engine) == ["hold(b2)"]
    engine.allocate([Call("aside", ("b3",)), Call("lay", ("b4",))], 1.0)
    assert running(engine) == ["hold(b2)", "aside(b3)", "lay(b4)"]
    engine.change([("b2.c", True)], "world", 2.0)
    end(engine, "hold(b2)", Outcome.CANCELLED, 3.0)
    assert running(engine) == ["aside(b3)", "lay(b4)", "grip(b1)"]


def test_one_challenger_breaks_off_one_holder() -> None:
    """A unit that is already on its way is not asked for twice, whatever happens meanwhile."""
    tasks = parse(
        """
fact Box.done : flag
fact lamp.on : flag
resource arm capacity 2
task work(Box) until Box.done
  - turn(Box)
action turn(Box) until Box.done uses arm sets Box.done cancel at_checkpoint
""",
        "two_units",
    )
    engine = Engine(tasks)
    engine.allocate([Call("work", ("b1",), 0.1), Call("work", ("b2",), 0.2)], 0.0)
    engine.allocate([Call("work", ("b3",), 0.9)], 1.0)
    engine.change([("lamp.on", True)], "person", 2.0)
    asked = [a.node.node.args[0] for a in engine.state.attempts.values() if a.cancel is not None]
    assert asked == ["b1"]


def test_a_task_that_opens_again_keeps_what_it_still_uses() -> None:
    """Otherwise the arm would go for another box with this one in the gripper."""
    engine = Engine(STORE)
    engine.allocate([Call("store", ("b1",), 0.5)], 0.0)
    engine.report(1, Report((("kr60.at", "b1"),)), 1.0)
    engine.allocate([Call("store", ("b2",), 0.9)], 2.0)
    engine.change([("b1.on_floor", True)], "camera", 3.0)
    engine.change([("b1.on_floor", False)], "camera", 4.0)
    (grasp,) = engine.state.attempts.values()
    engine.report(grasp.number, Report((("b1.taken", True),)), 5.0)
    running = [attempt.node.node.label for attempt in engine.state.attempts.values()]
    assert running == ["kr60_show(b1)"]


@pytest.mark.parametrize(("order", "gets_the_arm"), [("before", "held"), ("after", "other")])
def test_who_is_to_go_on_with_a_held_box_is_allocated_before_its_task_is_withdrawn(
    order: str, gets_the_arm: str
) -> None:
    """A withdrawn task lets the arm go at once, whatever the gripper holds."""
    engine = Engine(
        tasks(
            """
task first(Box) until Box.b keeps hand
  - grab(Box)
  - put(Box)  when Box.a
task instead(Box) until Box.c keeps hand
  - lay(Box)  when Box.a
action grab(Box) until Box.a uses hand sets Box.a
action put(Box) until Box.b uses hand sets Box.b, Box.a
action lay(Box) until Box.c uses hand sets Box.c, Box.a
"""
        )
    )
    engine.allocate([Call("first", ("held",)), Call("first", ("other",))], 0.0)
    end(engine, "grab(held)", Outcome.DONE, 1.0, "held.a")
    end(engine, "put(held)", Outcome.FAILED, 2.0)
    assert running(engine) == []
    instead = [Call("instead", ("held",), 1000.0)]
    if order == "before":
        assert kinds(engine.allocate(instead, 3.0)) == ["Allocated"]
    engine.withdraw(1, "it cannot be put there", 3.0)
    if order == "after":
        engine.allocate(instead, 3.0)
    (attempt,) = engine.state.attempts.values()
    assert attempt.node.node.args == (gets_the_arm,)


def test_who_waits_has_waited_since_its_own_gate_opened() -> None:
    """What else moves in its tree does not make it younger."""
    engine = Engine(
        tasks(
            """
task both(Box) until Box.c
  - left(Box)
  - right(Box)  when Box.b
action left(Box) until Box.a uses hand sets Box.a
action right(Box) until Box.c uses belt sets Box.c
"""
        )
    )
    engine.hold("person", 0.0)
    engine.allocate([Call("both", ("b1",))], 1.0)
    _, left, right = engine.state.trees[1].nodes
    for at, value in ((2.0, True), (3.0, False), (4.0, True)):
        engine.change([("b1.b", value)], "world", at)
        assert left.waiting_since == 1.0
        assert engine.state.waiting.waits(right) is value
    assert right.waiting_since == 4.0


def test_a_success_below_a_closed_gate_forgets_the_failures_too() -> None:
    """Its second failure in a row would be its last."""
    engine = Engine(
        tasks(
            """
task work(Box) when not Box.stop until Box.c
  - do(Box)
action do(Box) until Box.a uses hand sets Box.a cancel never retries 1
"""
        )
    )
    engine.allocate([Call("work", ("b1",))], 0.0)
    end(engine, "do(b1)", Outcome.FAILED, 1.0)
    engine.tick(2.0)
    engine.change([("b1.stop", True)], "world", 3.0)
    end(engine, "do(b1)", Outcome.DONE, 4.0, "b1.a")
    engine.change([("b1.stop", None), ("b1.a", None)], "world", 5.0)
    end(engine, "do(b1)", Outcome.FAILED, 6.0)
    assert "b1.fault" not in engine.state.facts
    assert engine.state.facts["b1.attempts"] == 1.0


def test_a_snapshot_keeps_every_value_as_it_is() -> None:
    """Whole numbers, halves of surrogate pairs, and the sign of zero."""
    head = "fact Box.n : number?\nfact Box.t : text?\n"
    engine = Engine(parse(head, "values"))
    values = [1, 1.0, -0.0, 2**80, 1e300, "x", "\u00e4\u2713", '"', "\ud800"]
    for number, value in enumerate(values):
        key = f"b{number}.{'t' if isinstance(value, str) else 'n'}"
        engine.change([(key, value)], "world", 1.5)
        text = freeze(engine.state)
        thawed = thaw(engine.repository, engine.state.weights, text)
        assert repr(sorted(thawed.facts.items())) == repr(sorted(engine.state.facts.items()))
        assert freeze(thawed) == text


def test_a_time_condition_that_is_mentioned_twice_is_one() -> None:
    """In a row, with others before and after it."""
    engine = Engine(
        tasks(
            """
task work(Box) until Box.c
  - one(Box)  when Box.a for 1 s and not (Box.a for 1 s) or Box.a for 1 s
  - two(Box)  when Box.b for 5 s and Box.a for 1 s
action one(Box) until Box.c uses hand sets Box.c
action two(Box) until Box.c uses belt sets Box.c
"""
        )
    )
    engine.change([("b1.a", True), ("b1.b", True)], "world", 0.0)
    engine.allocate([Call("work", ("b1",))], 0.0)
    engine.tick(1.0)
    assert running(engine) == ["one(b1)"]
    engine.tick(4.0)
    assert running(engine) == ["one(b1)"]
    engine.tick(5.0)
    assert running(engine) == ["one(b1)", "two(b1)"]


def test_a_keeper_goes_on_with_what_somebody_outside_has_reserved() -> None:
    """Else the two would wait for each other: the one outside for the keeper's own resource."""
    engine = Engine(
        tasks(
            """
task keep(Box) until Box.c keeps hand
  - hold(Box)
  - pass(Box)  when Box.a
action hold(Box) until Box.a uses hand sets Box.a
action pass(Box) until Box.c uses hand, belt sets Box.c
action occupy(Box) until Box.a uses arm sets Box.a
action large(Box) until Box.b uses arm, belt sets Box.b
"""
        )
    )
    engine.allocate([Call("keep", ("b1",)), *(Call("occupy", (f"x{n}",)) for n in (1, 2))], 0.0)
    engine.allocate([Call("large", ("b2",), 5.0)], 1.0)
    assert running(engine) == ["hold(b1)", "occupy(x1)", "occupy(x2)"]
    end(engine, "hold(b1)", Outcome.DONE, 2.0, "b1.a")
    assert "pass(b1)" in running(engine)
