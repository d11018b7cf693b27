"""Whether a box can be what somebody says: by size and weight."""

import dataclasses

import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.cell.identity import fits, plausible, resized, size_by_weight, weighs_like, why_not
from depal.domain import EURO_PALLET, Approach, Delivery, DeliveryLine, Grasp, Gtin, Product
from depal.geometry import Pose, Vector3

edge = st.floats(0.08, 0.6)
sizes = st.tuples(edge, edge, edge)


def product(size: Vector3, mass: float = 4.0, gtin: str = "g") -> Product:
    """A product."""
    return Product(Gtin(gtin), gtin, size, mass)


def note(*products: Product) -> Delivery:
    """A note of one case each."""
    return Delivery("d", EURO_PALLET, tuple(DeliveryLine(each, 1) for each in products))


@given(sizes, st.permutations(range(3)), st.floats(-0.02, 0.02), st.floats(0.5, 20.0))
def test_nothing_speaks_against_what_it_is(
    size: Vector3, order: list[int], error: float, mass: float
) -> None:
    """However it lies, and a little off in size and weight."""
    seen = tuple(size[k] + error for k in order)
    felt = mass * (1 + error)
    assert why_not(product(size, mass), seen, felt) == ()  # type: ignore[arg-type]


@given(sizes, st.floats(0.05, 0.3), st.integers(0, 2))
def test_an_edge_that_is_a_guess_counts_for_nothing(
    size: Vector3, error: float, which: int
) -> None:
    """The other two must fit."""
    seen = [*size]
    seen[which] += error + max(size)  # no turn makes up for it
    assert not fits(product(size), tuple(seen))  # type: ignore[arg-type]
    assert fits(product(size), tuple(seen), unsized=True)  # type: ignore[arg-type]


@given(st.floats(0.5, 20.0), st.floats(0.0, 40.0))
def test_a_weight_that_is_far_off_speaks_against_a_product(mass: float, felt: float) -> None:
    """By a tenth and 0.2 kg."""
    assert weighs_like(product((0.3, 0.3, 0.3), mass), felt) is (
        abs(felt - mass) <= 0.1 * mass + 0.2
    )


def test_reasons_name_numbers_for_people() -> None:
    """Both of them."""
    reasons = why_not(product((0.4, 0.3, 0.2), 4.0), (0.5, 0.3, 0.2), 9.0)
    assert reasons == (
        "it is 500 x 300 x 200 mm, product g is 400 x 300 x 200 mm",
        "it weighs 9.0 kg, product g weighs 4.0 kg",
    )


def test_the_weight_tells_which_of_two_heights_a_top_belongs_to() -> None:
    """And nothing where it fits none, or two."""
    low, high = product((0.4, 0.3, 0.15), 2.0, "low"), product((0.4, 0.3, 0.25), 5.0, "high")
    other = product((0.3, 0.4, 0.30), 5.1, "other")
    assert plausible(note(low, high), low.size) == (low,)
    assert size_by_weight(note(low, high), low.size, 5.0) == high.size
    assert size_by_weight(note(low, high), (0.3, 0.4, 0.15), 5.0) == (0.3, 0.4, 0.25)
    assert size_by_weight(note(low, high), low.size, 9.0) is None
    assert size_by_weight(note(low, high, other), low.size, 5.0) is None


@pytest.mark.parametrize("approach", list(Approach))
@given(more=st.floats(-0.1, 0.1))
def test_a_grasp_holds_the_same_face_of_a_box_of_another_size(
    approach: Approach, more: float
) -> None:
    """The distance from the flange to that face stays."""
    at = (-0.35, 0.02, 0.03) if approach is Approach.HORIZONTAL else (0.01, 0.02, 0.4)
    axis = 0 if approach is Approach.HORIZONTAL else 2
    grasp = Grasp(approach, folded=False, box_from_flange=Pose(at), cups=())
    old = (0.3, 0.4, 0.25)
    new = tuple(edge + more for edge in old)
    moved = resized(grasp, old, new).box_from_flange.translation  # type: ignore[arg-type]
    assert abs(moved[axis]) - new[axis] / 2 == pytest.approx(abs(at[axis]) - old[axis] / 2)
    still = [k for k in range(3) if k != axis]
    assert [moved[k] for k in still] == [at[k] for k in still]
    assert dataclasses.replace(grasp, box_from_flange=Pose(moved)).cups == ()
