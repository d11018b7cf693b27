"""The solver against the meaning of conditions."""

from itertools import product

from hypothesis import given
from hypothesis import strategies as st

from depal.executive.checking.solver import judge, satisfiable
from depal.executive.conditions import (
    ALWAYS,
    AllOf,
    AnyOf,
    Compare,
    Condition,
    FactRef,
    Holds,
    Literal,
    Not,
    Value,
    at_once,
    holds,
)

DOMAINS: dict[str, tuple[Value, ...]] = {
    "b.taken": (False, True),
    "b.known": (False, True),
    "arm.at": (None, "left", "right", "other_place"),
    "b.target": (None, "left", "other_place"),
    "b.weight": (None, 1.0, 2.0, 3.0),
}


def ref(key: str) -> FactRef:
    """A fact by its key."""
    subject, attribute = key.split(".")
    return FactRef(Literal(subject), attribute)


atoms = st.one_of(
    st.just(ALWAYS),
    st.sampled_from(sorted(DOMAINS)).map(lambda key: Holds(ref(key))),
    st.builds(
        Compare,
        st.just(ref("arm.at")),
        st.sampled_from(["=", "!="]),
        st.sampled_from([Literal("left"), Literal("right"), ref("b.target")]),
    ),
    st.builds(
        Compare,
        st.just(ref("b.weight")),
        st.sampled_from(["<", "<=", ">", ">=", "=", "!="]),
        st.just(Literal(2.0)),
    ),
)
conditions: st.SearchStrategy[Condition] = st.recursive(
    atoms,
    lambda inner: st.one_of(
        inner.map(Not),
        st.lists(inner, min_size=2, max_size=3).map(lambda parts: AllOf(tuple(parts))),
        st.lists(inner, min_size=2, max_size=3).map(lambda parts: AnyOf(tuple(parts))),
    ),
    max_leaves=6,
)
valuations = st.fixed_dictionaries({k: st.sampled_from(v) for k, v in DOMAINS.items()})


@given(conditions, valuations)
def test_with_all_facts_known_the_judgement_is_the_meaning(
    condition: Condition, facts: dict[str, Value]
) -> None:
    """Nothing is left open."""
    assert judge(condition, facts) is holds(condition, facts, {}, at_once)


@given(conditions, valuations, st.sets(st.sampled_from(sorted(DOMAINS))))
def test_what_some_facts_settle_the_others_do_not_change(
    condition: Condition, facts: dict[str, Value], hidden: set[str]
) -> None:
    """Unknown is never wrong."""
    known = {key: value for key, value in facts.items() if key not in hidden}
    assert judge(condition, known) in {None, holds(condition, facts, {}, at_once)}


@given(st.lists(conditions, min_size=1, max_size=3))
def test_the_solver_agrees_with_trying_everything(demands: list[Condition]) -> None:
    """It is exact."""
    every = (dict(zip(DOMAINS, values, strict=True)) for values in product(*DOMAINS.values()))
    expected = any(all(holds(one, facts, {}, at_once) for one in demands) for facts in every)
    assert satisfiable(demands, DOMAINS) is expected


def test_a_used_up_budget_leaves_the_question_open() -> None:
    """It is no answer."""
    assert satisfiable([Holds(ref("b.taken"))], DOMAINS, budget=1) is None
