"""The first law again, over tasks that nobody would write."""

from hypothesis import given
from hypothesis import strategies as st

from depal.executive import conditions as c
from depal.executive.engine import Call, Engine
from depal.executive.schema import (
    Action,
    FactDeclaration,
    FactType,
    Param,
    Repository,
    Resource,
    Step,
    Task,
)
from depal.executive.snapshot import freeze, thaw

ANYTHING = FactType(("flag", "number", "text"), optional=True)
KEYS = ["a.p", "a.q", "b.p", "b.q", "arm.p"]
VALUES = st.sampled_from([None, False, True, 0, 1.0, 2.0, "a", "b", "reader"])
REFERENCES = st.builds(
    c.FactRef,
    st.sampled_from([c.Var("X"), c.Var("Y"), c.Literal("arm")]),
    st.sampled_from(["p", "q"]),
).filter(lambda fact: fact != c.FactRef(c.Literal("arm"), "q"))
OTHERS = st.one_of(
    REFERENCES,
    st.sampled_from([c.Var("X"), c.Var("Y"), c.Literal("reader"), c.Literal(1.0)]),
)


def grown(inner: st.SearchStrategy[c.Condition]) -> st.SearchStrategy[c.Condition]:
    """One level more."""
    pairs = st.tuples(inner, inner)
    return st.one_of(
        st.builds(c.Not, inner),
        st.builds(c.AllOf, pairs),
        st.builds(c.AnyOf, pairs),
        st.builds(c.Lasting, inner, st.sampled_from([1.0, 2.5])),
    )


CONDITIONS = st.recursive(
    st.one_of(
        st.just(c.ALWAYS),
        st.builds(c.Holds, REFERENCES),
        st.builds(c.Compare, REFERENCES, st.sampled_from(["=", "!=", "<", ">="]), OTHERS),
    ),
    grown,
    max_leaves=5,
)
BOTH = (Param("X", "Thing"), Param("Y", "Thing"))
CALLS = st.sampled_from([(c.Var("X"), c.Var("Y")), (c.Var("Y"), c.Var("X")), (c.Var("X"),) * 2])


@st.composite
def repositories(draw: st.DrawFn) -> Repository:
    """A root, a task below it that is mentioned twice, and two primitives."""

    def step(name: str) -> Step:
        return Step(name, draw(CALLS), draw(CONDITIONS))

    def task(name: str, *steps: Step, keeps: tuple[str, ...] = ()) -> Task:
        until, when, within = (draw(CONDITIONS) for _ in range(3))
        return Task(name, BOTH, steps, until, when, keeps, within=within)

    def action(name: str) -> Action:
        until, when, within = (draw(CONDITIONS) for _ in range(3))
        return Action(name, BOTH, until, when, within=within)

    schemata = [
        task("root", step("sub"), step("left"), step("sub"), step("right")),
        task("sub", step("left"), step("right"), keeps=("arm",)),
        action("left"),
        action("right"),
    ]
    facts = [FactDeclaration("Thing", name, ANYTHING) for name in "pq"]
    facts.append(FactDeclaration("arm", "p", ANYTHING))
    named = {fact.name: fact for fact in facts}
    return Repository(
        named, {"arm": Resource("arm")}, {schema.name: schema for schema in schemata}, "random"
    )


INPUTS = st.lists(
    st.one_of(
        st.lists(st.tuples(st.sampled_from(KEYS), VALUES), min_size=1, max_size=3),
        st.sampled_from([("a", "b"), ("b", "a"), ("a", "a")]),
        st.just(None),
    ),
    max_size=12,
)


@given(repositories(), INPUTS)
def test_gates_are_what_a_sweep_says_whatever_the_task(
    repository: Repository, inputs: list[list[tuple[str, c.Value]] | tuple[str, str] | None]
) -> None:
    """After every change, allocation and moment; and a snapshot knows the same."""
    engine = Engine(repository)
    engine.hold("person", 0.0)
    engine.allocate([Call("root", ("a", "b"))], 0.0)
    for at, happens in enumerate(inputs, 1):
        if happens is None:
            engine.tick(float(at))
        elif isinstance(happens, tuple):
            engine.allocate([Call("root", happens)], float(at))
        else:
            engine.change(happens, "world", float(at))
        state = engine.state
        again = thaw(repository, state.weights, freeze(state))
        assert freeze(again) == freeze(state)
        for number, tree in state.trees.items():
            swept = [standing.gate for standing in state.standings(tree)]
            assert [node.gate for node in tree.nodes] == swept
            assert [node.gate for node in again.trees[number].nodes] == swept
            kept = [standing.kept for standing in state.standings(tree)]
            assert [node.kept for node in tree.nodes] == kept
            for node in tree.nodes:
                assert state.waiting.waits(node) == (node.gate and node.node.concrete)
