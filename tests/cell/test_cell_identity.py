"""Whether a box can be what somebody says: by size and weight."""

import dataclasses

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from depal.cell.identity import (
    beyond_seen,
    fits,
    looks_like_two,
    may_be_two,
    plausible,
    size_by_weight,
    told_size,
    weighs_like,
    why_not,
)
from depal.domain import EURO_PALLET, Approach, Delivery, DeliveryLine, Grasp, Gtin, Product
from depal.geometry import Pose, Vector3
from depal.motion.grasping import resized, swollen

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


@example(size=(0.39, 0.32, 0.16), turned=False, axis=0, error=-0.2)
@given(size=sizes, turned=st.booleans(), axis=st.integers(0, 1), error=st.floats(-0.3, 0.3))
def test_a_told_box_lies_within_the_room_that_it_is_given(
    *, size: Vector3, turned: bool, axis: int, error: float
) -> None:
    """Whichever end of the edge was seen wrong, and whichever way it lies where edges are equal."""
    truth = (size[1], size[0], size[2]) if turned else size
    seen = [*truth]
    seen[axis] = max(seen[axis] + error, 0.05)
    told, beyond = told_size(size, tuple(seen))  # type: ignore[arg-type]
    shift = abs(seen[axis] - truth[axis]) / 2  # of its middle, seen with one end wrong
    room = (told[axis] + 2 * beyond[axis]) / 2
    assert room >= truth[axis] / 2 + shift - 0.004 - 1e-9


@given(hidden=st.floats(0.05, 0.09), error=st.floats(0.0, 0.01), turned=st.booleans())
def test_a_box_of_which_two_edges_are_hidden_in_part_has_room_for_both_ways_to_lie(
    *, hidden: float, error: float, turned: bool
) -> None:
    """One of them may then be as long as the other edge is, and it seems to lie so (dev-021)."""
    size = (0.39, 0.32, 0.16) if not turned else (0.32, 0.39, 0.16)
    seen = (size[0] - hidden, size[1] - hidden + error, 0.16)
    told, beyond = told_size((0.39, 0.32, 0.16), seen)
    shift = hidden / 2  # of its middle, where one end of either edge is hidden
    for axis in (0, 1):
        assert (told[axis] + 2 * beyond[axis]) / 2 >= size[axis] / 2 + shift - error / 2 - 1e-9


@given(sizes)
def test_a_box_that_was_seen_right_is_given_no_room(size: Vector3) -> None:
    """Nor is one of which all edges fit one product alone."""
    told, beyond = told_size(size, size)
    assert told == size
    if abs(size[0] - size[1]) > 0.04:  # else it may lie the other way
        assert beyond == (0.0, 0.0, 0.0)
        assert beyond_seen(note(product(size)), size) == (0.0, 0.0, 0.0)


def test_a_like_top_leaves_open_how_long_a_box_is() -> None:
    """Two of its edges are those of a longer product; what it weighs may tell it is not that."""
    delivery = note(
        product((0.22, 0.22, 0.245), 6.4, "a"), product((0.295, 0.223, 0.248), 7.8, "b")
    )
    seen = (0.22, 0.22, 0.245)
    assert beyond_seen(delivery, seen) == pytest.approx((0.075, 0.075, 0.003))
    assert beyond_seen(delivery, seen, 7.8) == pytest.approx((0.075, 0.075, 0.003))
    assert beyond_seen(delivery, seen, 6.4) == (0.0, 0.0, 0.0)


@given(
    size=sizes,
    beyond=st.tuples(*[st.floats(0.0, 0.1)] * 3),
    approach=st.sampled_from(Approach),
    side=st.booleans(),
)
def test_what_a_held_box_may_be_lies_in_its_bulk(
    *, size: Vector3, beyond: Vector3, approach: Approach, side: bool
) -> None:
    """Its held face stays where the cups are; every other face has room to be farther out."""
    out = (np.array(size) / 2 + 0.2) * (
        (0, 0, 1) if approach is Approach.VERTICAL else ((-1, 0, 0) if side else (0, -1, 0))
    )
    axis = int(np.argmax(np.abs(out)))
    grasp = Grasp(approach, folded=False, box_from_flange=Pose.from_arrays(out, np.eye(3)), cups=())
    held, bulk = swollen(grasp, size, beyond)
    shift = np.array(grasp.box_from_flange.translation) - held.box_from_flange.translation
    sign = np.sign(out[axis])
    for k in range(3):
        low, high = shift[k] - bulk[k] / 2, shift[k] + bulk[k] / 2
        held_side = high if sign > 0 else -low
        if k == axis:
            assert held_side == pytest.approx(size[k] / 2)
        assert max(-low, high) >= size[k] / 2 + beyond[k] - 1e-9
        assert min(-low, high) >= size[k] / 2 - 1e-9


def test_a_box_that_weighs_like_nothing_of_its_size_may_be_higher_than_all() -> None:
    """Its product is not on the note, and its height a guess where only the top shows."""
    delivery = note(product((0.22, 0.22, 0.2), 6.4, "a"), product((0.4, 0.1, 0.3), 7.8, "b"))
    seen = (0.22, 0.22, 0.2)
    assert seen[2] + beyond_seen(delivery, seen, 3.0)[2] > 0.3
    assert beyond_seen(delivery, seen, 6.4) == (0.0, 0.0, 0.0)


kilos = st.floats(0.5, 20.0)


@given(kilos, kilos, st.floats(-0.05, 0.05))
def test_what_weighs_like_its_product_is_one_box_and_what_weighs_like_two_is_two(
    mass: float, other: float, error: float
) -> None:
    """A neighbour that sticks is told by the weight, unless it is too light to be told."""
    one, two = product((0.3, 0.2, 0.2), mass, "a"), product((0.3, 0.2, 0.25), other, "b")
    felt = (mass + other) * (1 + error)
    assert not may_be_two((one,), note(one, two), mass * (1 + error))
    assert may_be_two((one,), note(one, two), felt) is not weighs_like(one, felt)


@given(kilos)
def test_where_nobody_knows_what_a_box_can_be_its_weight_tells_nothing(mass: float) -> None:
    """No product fits it."""
    assert not may_be_two((), note(product((0.3, 0.2, 0.2), mass)), 2 * mass)


@given(sizes, st.integers(0, 2), st.floats(0.5, 10.0), st.floats(-0.02, 0.02))
def test_two_cases_flush_beside_each_other_look_like_two_and_weigh_so(
    size: Vector3, axis: int, mass: float, error: float
) -> None:
    """Along any axis, one edge taken over from another product; never by less than two cases."""
    one = product(size, mass)
    seen = [*size]
    seen[axis] *= 2
    seen[(axis + 1) % 3] += 0.1  # an edge that is not what it looks like
    seen[(axis + 2) % 3] += error
    twice = Delivery("d", EURO_PALLET, (DeliveryLine(one, 2),))
    assert looks_like_two(twice, tuple(seen), 2 * mass * (1 + error))  # type: ignore[arg-type]
    assert not looks_like_two(note(one), tuple(seen), 2 * mass)  # type: ignore[arg-type]


def test_two_low_cartons_that_were_taken_for_one_high_one_are_told_by_their_weight() -> None:
    """Of a delivery: neither can be that one alone, and so its weight is no doubt of its own."""
    low, high = product((0.174, 0.167, 0.179), 1.516, "low"), product((0.328, 0.177, 0.21), 3.751)
    delivery = Delivery("d", EURO_PALLET, (DeliveryLine(low, 9), DeliveryLine(high, 9)))
    seen = (0.177, 0.328, 0.21)
    assert not may_be_two((high,), delivery, 3.1)
    assert looks_like_two(delivery, seen, 3.1)
    assert not looks_like_two(delivery, seen, high.mass)
    assert not looks_like_two(delivery, (0.25, 0.25, 0.21), 3.1)
