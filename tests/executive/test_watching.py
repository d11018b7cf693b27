"""Whoever waits for a change is told of it, and nobody else."""

from hypothesis import given
from hypothesis import strategies as st

from depal.executive.conditions import AllOf, AnyOf, Compare, FactRef, Holds, Lasting, Literal, Not
from depal.executive.watching import Move, Watch, Watchers, atomics_of

KEYS = st.sampled_from(["a.x", "b.x", "c.x"])
VALUES = st.sampled_from([None, True, "p", 1.5])
WATCHES = st.lists(st.one_of(KEYS, st.tuples(KEYS, VALUES)), max_size=3)
TOKENS = st.tuples(st.integers(1, 3), st.integers(0, 2))
MOVES = st.lists(st.builds(Move, KEYS, VALUES, VALUES), max_size=3)


def concerns(move: Move, watch: Watch) -> bool:
    """By definition."""
    if isinstance(watch, str):
        return move.key == watch
    key, value = watch
    return move.key == key and any(
        type(value) is type(one) and value == one for one in (move.before, move.after)
    )


@given(st.dictionaries(TOKENS, WATCHES), st.sets(TOKENS), MOVES)
def test_those_who_still_watch_are_told_in_order(
    watching: dict[tuple[int, int], list[Watch]], gone: set[tuple[int, int]], moves: list[Move]
) -> None:
    """Once each; and nothing is left of those who watch no more."""
    watchers: Watchers[str] = Watchers()
    for token, watches in watching.items():
        watchers.watch(watches, token, str(token))
    for token in gone & set(watching):
        watchers.unwatch(watching[token], token)
    left = {token: watches for token, watches in watching.items() if token not in gone}
    expected = sorted(
        token
        for token, watches in left.items()
        if any(concerns(move, watch) for move in moves for watch in watches)
    )
    assert watchers.told(moves) == [(token, str(token)) for token in expected]
    for token, watches in left.items():
        watchers.unwatch(watches, token)
    assert len(watchers) == 0


def test_the_atomic_parts_of_a_condition_are_those_without_connectives() -> None:
    """A time condition is one of them, whatever it stands around."""
    a, b = (Holds(FactRef(Literal(name), "x")) for name in "ab")
    c = Compare(FactRef(Literal("c"), "x"), "<", Literal(1.0))
    lasting = Lasting(AllOf((a, b)), 2.0)
    assert list(atomics_of(AnyOf((Not(a), AllOf((lasting, c)))))) == [a, lasting, c]
