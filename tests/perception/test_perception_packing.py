"""The packing is the best set without overlap."""

import itertools
from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.geometry import Pose
from depal.perception.faces import Facing, Raster, Rectangle
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


DEEPER = 0.2
STEP = 0.01


def raster(depths: dict[tuple[int, int], float]) -> Raster:
    """What is seen in each cell of the grid; nothing where no depth is given."""
    cells_wide, fine = 9, round(CELL / STEP)
    depth = np.full((cells_wide, cells_wide), np.nan, dtype=np.float32)
    for (x, y), seen in depths.items():
        depth[y, x] = seen
    depth = depth.repeat(fine, axis=0).repeat(fine, axis=1)
    colour = np.zeros((*depth.shape, 3), dtype=np.uint8)
    # The middle of the first pixel is the origin: half a pixel must be less than the rim of a face.
    return Raster(Facing.TOP, Pose((0.0, 0.0, 0.0)), STEP, colour, depth, np.isfinite(depth))


layers = st.lists(
    st.tuples(
        st.tuples(st.integers(0, 5), st.integers(0, 5), st.integers(1, 3), st.integers(1, 3)),
        st.booleans(),
    ),
    min_size=1,
    max_size=6,
)


@given(layers, st.integers(0, 2**32 - 1))
@settings(max_examples=40)
def test_a_place_belongs_to_one_rectangle_unless_something_nearer_hides_it(
    places: list[tuple[tuple[int, int, int, int], bool]], seed: int
) -> None:
    """A place belongs to one rectangle, but for those that something nearer hides there.

    Where nothing is seen, whatever lies nearer may hide what surely lies behind it.
    """
    random = np.random.default_rng(seed)
    values = random.normal(0.5, 1.0, len(places))
    seen = {
        (x, y): DEEPER * float(random.integers(2))
        for x, y in itertools.product(range(9), range(9))
        if random.random() < 0.6
    }
    rectangles = [replace(rectangle(*p), depth=DEEPER * deep) for p, deep in places]
    claimed = [
        {cell for cell in cells(*place) if not (deep and seen.get(cell) == 0.0)}
        for place, deep in places
    ]

    sure = random.random(len(places)) < 0.5

    def apart(a: int, b: int) -> bool:
        common = claimed[a] & claimed[b]
        if places[a][1] == places[b][1] or not sure[a if places[a][1] else b]:
            return not common
        return not any(cell in seen for cell in common)

    chosen = packed(rectangles, values, raster(seen), sure)
    assert all(apart(one, other) for one, other in itertools.combinations(chosen, 2))
    best = max(
        float(values[list(some)].sum())
        for count in range(len(places) + 1)
        for some in itertools.combinations(range(len(places)), count)
        if all(apart(a, b) for a, b in itertools.combinations(some, 2))
    )
    assert abs(float(values[chosen].sum()) - best) < 1e-6


def test_the_shadow_of_a_box_hides_what_goes_on_there() -> None:
    """A box before another casts a shadow on it, where nothing is measured: both are there."""
    upper, lower = rectangle(0, 0, 2, 2), replace(rectangle(1, 0, 3, 2), depth=DEEPER)
    likely = np.array([1.0, 2.0])
    shadow = raster(
        dict.fromkeys(cells(2, 0, 2, 2), DEEPER) | dict.fromkeys(cells(0, 0, 1, 2), 0.0)
    )
    sure = np.array([False, True])
    assert packed([upper, lower], likely, shadow, sure) == [0, 1]
    assert packed([upper, lower], likely, shadow, ~sure) == packed([upper, lower], likely, shadow)
    assert packed([upper, lower], likely, shadow) == [1]
    assert packed([upper, replace(lower, depth=0.0)], likely, shadow, sure) == [1]
    bright = raster(dict.fromkeys(cells(1, 0, 3, 2), DEEPER))
    assert packed([upper, lower], likely, bright, sure) == [1]
