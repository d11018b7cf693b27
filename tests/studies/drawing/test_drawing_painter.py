"""The painter's order: what is painted later hides only what lies behind it."""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pytest
from drawing_samples import cut_volume
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from depal.studies.drawing.painter import MICROMETRES, Piece, hiding, painted
from depal.studies.drawing.solids import Paint, draw_solids, solids
from depal.studies.drawing.view import View

Array = npt.NDArray[np.float64]

views = st.builds(
    View, st.floats(-1.2, 1.2).filter(lambda turn: abs(turn) > 0.05), st.floats(0.1, 1.3)
)


def meets(point: Array, towards: Array, low: Array, high: Array) -> tuple[float, float]:
    """Where the line through a point runs inside a cuboid; the second is smaller when nowhere."""
    inside = [
        sorted(
            ((low[axis] - point[axis]) / towards[axis], (high[axis] - point[axis]) / towards[axis])
        )
        for axis in range(3)
    ]
    return max(start for start, _ in inside), min(end for _, end in inside)


def box_of(piece: Piece) -> tuple[Array, Array]:
    """The corners of a piece [m]."""
    return np.array(piece.lower) / MICROMETRES, np.array(piece.upper) / MICROMETRES


@st.composite
def guillotine_piles(draw: Callable[..., object]) -> tuple[Array, Array]:
    """What is left of a volume in random cuts when some boxes are gone."""
    lower, upper = cut_volume(draw(st.integers(2, 24)), draw(st.integers(0, 10_000)))
    kept = draw(st.lists(st.booleans(), min_size=len(lower), max_size=len(lower)))
    mask = np.array(kept)
    return lower[mask], upper[mask]


@st.composite
def loose_piles(draw: Callable[..., object]) -> tuple[Array, Array]:
    """Disjoint cuboids on a coarse grid, which may hide each other in circles."""
    rng = np.random.default_rng(draw(st.integers(0, 100_000)))
    boxes: list[tuple[Array, Array]] = []
    for _ in range(60):
        low = rng.integers(0, 5, 3)
        high = low + rng.integers(1, 4, 3)
        if all((np.minimum(high, b) <= np.maximum(low, a)).any() for a, b in boxes):
            boxes.append((low, high))
    lower, upper = np.array(boxes, dtype=float).swapaxes(0, 1)
    return lower / 10, upper / 10


def woven() -> tuple[Array, Array]:
    """Three cuboids that hide each other in a circle when seen from (+, +, +)."""
    lower = np.array(((0, 1, 0), (0, 0, 1), (1, 0, 0)), dtype=float)
    upper = np.array(((2, 2, 1), (1, 2, 2), (2, 1, 2)), dtype=float)
    return lower, upper


piles = st.one_of(guillotine_piles(), loose_piles())


@given(piles, views, st.integers(0, 1000))
def test_the_last_piece_painted_over_a_point_is_the_nearest_one(
    pile: tuple[Array, Array], view: View, seed: int
) -> None:
    """The painted picture shows, at random points, what a ray from the viewer meets first."""
    lower, upper = pile
    towards = view.towards
    pieces = [box_of(piece) for piece in painted(lower, upper, towards)]
    rng = np.random.default_rng(seed)
    for _ in range(20 if len(lower) else 0):
        aim = int(rng.integers(len(lower)))
        point = lower[aim] + rng.random(3) * (upper[aim] - lower[aim])
        spans = [meets(point, towards, low, high) for low, high in pieces]
        hit = [number for number, (start, end) in enumerate(spans) if end - start > 1e-6]
        assert spans[hit[-1]][1] >= max(spans[number][1] for number in hit) - 1e-6


@given(piles, views, st.integers(0, 1000))
def test_nothing_is_painted_before_what_it_hides(
    pile: tuple[Array, Array], view: View, seed: int
) -> None:
    """A ray from the inside of a piece towards the viewer meets no piece painted earlier."""
    pieces = [box_of(piece) for piece in painted(*pile, view.towards)]
    rng = np.random.default_rng(seed)
    for number, (low, high) in enumerate(pieces):
        point = low + rng.uniform(0.05, 0.95, 3) * (high - low)
        for earlier, (other_low, other_high) in enumerate(pieces[:number]):
            start, end = meets(point, view.towards, other_low, other_high)
            assert end - max(start, 0.0) < 1e-6, (number, earlier)


@given(piles, views)
def test_the_pieces_of_a_cuboid_fill_it(pile: tuple[Array, Array], view: View) -> None:
    """No cut loses or invents volume, and every piece lies in its owner."""
    lower, upper = pile
    volumes = np.zeros(len(lower))
    for piece in painted(lower, upper, view.towards):
        low, high = box_of(piece)
        assert (low >= lower[piece.owner] - 1e-6).all()
        assert (high <= upper[piece.owner] + 1e-6).all()
        volumes[piece.owner] += np.prod(high - low)
    np.testing.assert_allclose(volumes, np.prod(upper - lower, axis=1), atol=1e-5)


@given(guillotine_piles(), views)
def test_what_guillotine_cuts_made_is_never_cut_again(
    pile: tuple[Array, Array], view: View
) -> None:
    """Such piles have no circle, so each box is painted once and whole."""
    owners = [piece.owner for piece in painted(*pile, view.towards)]
    assert sorted(owners) == list(range(len(pile[0])))


def test_three_woven_cuboids_are_cut_once() -> None:
    """The smallest circle needs one cut."""
    lower, upper = woven()
    towards = np.array((1.0, 1.0, 1.0)) / np.sqrt(3)
    hides = hiding(lower, upper, towards)
    assert hides[0, 1]
    assert hides[1, 2]
    assert hides[2, 0]
    assert len(painted(lower, upper, towards)) == 4


@given(piles, views)
def test_two_cuboids_never_hide_each_other(pile: tuple[Array, Array], view: View) -> None:
    """The relation has one direction at most, and nothing hides itself."""
    hides = hiding(*pile, view.towards)
    assert not (hides & hides.T).any()


def test_cuboids_that_share_space_are_painted_all_the_same() -> None:
    """Perceived boxes may overlap a little; the farther one comes first."""
    lower, upper = np.zeros((2, 3)), np.ones((2, 3))
    lower[1] += 0.1
    upper[1] += 0.1
    order = [piece.owner for piece in painted(lower, upper, np.full(3, 0.577))]
    assert order == [0, 1]


@pytest.mark.parametrize("seed", range(4))
def test_a_drawn_pile_shows_the_nearest_cuboid_at_every_pixel(seed: int) -> None:
    """Pixels away from edges have the colour of what a ray from the viewer meets first."""
    rng = np.random.default_rng(seed)
    lower, upper = woven() if seed == 0 else cut_volume(12, seed)
    lower, upper = lower / upper.max() - 0.5, upper / upper.max() - 0.5
    colours = rng.integers(40, 250, (len(lower), 3))
    paints = [Paint(tuple(colour / 255), width=0.0, lit=False) for colour in colours]
    view = View(-0.6, 0.6)
    towards = view.towards
    lower, upper = (
        np.where(towards > 0, lower, -upper),
        np.where(towards > 0, upper, -lower),
    )
    figure = Figure(figsize=(3, 3), dpi=100)
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0, 0, 1, 1), xlim=(-1, 1), ylim=(-1, 1))
    axes.set_axis_off()
    draw_solids(axes, view, solids((lower + upper) / 2, upper - lower, paints))
    canvas.draw()
    pixels = np.asarray(canvas.buffer_rgba())[::-1, :, :3]
    boxes = list(zip(lower, upper, strict=True))
    for row, column in rng.integers(2, 298, (600, 2)):
        patch = pixels[row - 1 : row + 2, column - 1 : column + 2].reshape(-1, 3)
        if (patch != patch[0]).any():
            continue
        point = np.array((column + 0.5, row + 0.5)) / 150 - 1
        spans = [meets(point @ view.plane, towards, low, high) for low, high in boxes]
        ends = [end if end > start else -np.inf for start, end in spans]
        nearest = int(np.argmax(ends))
        expected = colours[nearest] if np.isfinite(ends[nearest]) else (255, 255, 255)
        np.testing.assert_array_equal(patch[0], expected)


@pytest.mark.parametrize("nothing", [[], np.empty((0, 3))])
def test_nothing_is_painted_of_an_empty_pile(nothing: npt.ArrayLike) -> None:
    """An empty pallet is a picture too."""
    assert painted(nothing, nothing, np.full(3, 0.577)) == []
