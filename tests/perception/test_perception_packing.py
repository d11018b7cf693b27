"""The packing is the best set without overlap."""

import itertools

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.perception.faces import Rectangle
from depal.perception.packing import OVERLAP, packed

grids = st.lists(
    st.tuples(st.integers(0, 5), st.integers(0, 5), st.integers(1, 3), st.integers(1, 3)),
    min_size=1,
    max_size=7,
)
CELL = 0.1


def rectangle(x: int, y: int, wide: int, high: int) -> Rectangle:
    """A rectangle on a grid of cells."""
    return Rectangle((x + wide / 2) * CELL, (y + high / 2) * CELL, wide * CELL, high * CELL)


def cells(x: int, y: int, wide: int, high: int) -> set[tuple[int, int]]:
    """The cells it covers."""
    return set(itertools.product(range(x, x + wide), range(y, y + high)))


@given(grids, st.integers(0, 2**32 - 1))
@settings(max_examples=40)
def test_no_other_set_without_overlap_is_worth_more(
    places: list[tuple[int, int, int, int]], seed: int
) -> None:
    """No other set without overlap is worth more."""
    values = np.random.default_rng(seed).normal(0.5, 1.0, len(places))
    chosen = packed([rectangle(*place) for place in places], values)
    squares = [cells(*place) for place in places]
    for one, other in itertools.combinations(chosen, 2):
        assert not squares[one] & squares[other]
    best = 0.0
    for count in range(len(places) + 1):
        for some in itertools.combinations(range(len(places)), count):
            if all(not squares[a] & squares[b] for a, b in itertools.combinations(some, 2)):
                best = max(best, float(values[list(some)].sum()))
    assert abs(float(values[chosen].sum()) - best) < 1e-6


def test_what_is_less_likely_than_not_is_left_out() -> None:
    """What is less likely than not is left out."""
    assert packed([rectangle(0, 0, 1, 1)], np.array([-0.1])) == []


def test_faces_may_reach_a_little_into_each_other() -> None:
    """Faces may reach a little into each other."""
    first = Rectangle(0.1, 0.1, 0.2, 0.2)
    near = Rectangle(0.3 - 0.8 * OVERLAP, 0.1, 0.2, 0.2)
    far = Rectangle(0.3 - 4 * OVERLAP, 0.1, 0.2, 0.2)
    assert packed([first, near], np.array([1.0, 1.0])) == [0, 1]
    assert packed([first, far], np.array([1.0, 2.0])) == [1]


def test_turned_rectangles_overlap_as_they_lie() -> None:
    """Turned rectangles overlap as they lie."""
    first = Rectangle(0.0, 0.0, 0.4, 0.05, turn=np.pi / 4)
    second = Rectangle(0.1, -0.1, 0.2, 0.05, turn=np.pi / 4)
    assert packed([first, second], np.array([1.0, 1.0])) == [0, 1]
