"""Laws of naming a face by its print."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from printed_faces import (
    LABELLED,
    OTHER,
    SIBLING,
    STRANGER,
    A,
    book_of_drawings,
    face_of,
    lit,
    note_of,
    product,
)

from depal.perception.faces import Facing
from depal.perception.recognition import Limits, gallery_of, identify
from depal.perception.recognition.patches import Patch
from depal.simulation.imaging.prints import design_of

BOOK = book_of_drawings(A, SIBLING, STRANGER, OTHER)
GALLERY = gallery_of(BOOK, note_of(A, SIBLING, STRANGER, OTHER))
ALONE = gallery_of(book_of_drawings(A), note_of(A))
SIDES = st.sampled_from(("end", "side", "top"))

gains = st.floats(0.55, 1.0)
balances = st.tuples(st.floats(0.9, 1.0), st.floats(0.9, 1.0), st.floats(0.9, 1.0))
gradients = st.tuples(st.floats(-0.2, 0.2), st.floats(-0.2, 0.2))
shifts = st.tuples(st.floats(-0.008, 0.008), st.floats(-0.008, 0.008), st.floats(-0.03, 0.03))


def test_the_products_of_these_tests_look_as_they_should() -> None:
    """A sibling has the same brand, others another range."""
    one, sibling, other = (design_of(each.gtin) for each in (A, SIBLING, STRANGER))
    assert one.seed == sibling.seed != other.seed
    assert one != sibling


@given(SIDES, gains, balances, gradients, shifts)
@settings(max_examples=25, deadline=None)
def test_no_light_and_no_shift_within_bounds_makes_a_face_another_products(
    side: str,
    gain: float,
    balance: tuple[float, float, float],
    gradient: tuple[float, float],
    moved: tuple[float, float, float],
) -> None:
    """The best name is right, and what is believed is right."""
    red, green, blue = (gain * each for each in balance)
    patch = lit(face_of(A, side, moved), (red, green, blue), gradient, grain=2.0)
    named = identify(patch, GALLERY)
    assert named is not None
    assert named.name.gtin == A.gtin
    assert named.name.side == side


@given(SIDES, balances, gradients, shifts)
@settings(max_examples=15, deadline=None)
def test_a_clean_face_is_named_for_certain(
    side: str,
    balance: tuple[float, float, float],
    gradient: tuple[float, float],
    moved: tuple[float, float, float],
) -> None:
    """Siblings and strangers on the note do not hinder it."""
    named = identify(lit(face_of(A, side, moved), balance, gradient, 1.0), GALLERY)
    assert named is not None
    assert named.name.certain
    assert named.rivals == ()


@given(SIDES, gains, balances, gradients, shifts)
@settings(max_examples=25, deadline=None)
def test_an_unknown_sibling_is_never_believed_to_be_the_product(
    side: str,
    gain: float,
    balance: tuple[float, float, float],
    gradient: tuple[float, float],
    moved: tuple[float, float, float],
) -> None:
    """Although it has the same size and brand, and no picture of its own."""
    red, green, blue = (gain * each for each in balance)
    patch = lit(face_of(SIBLING, side, moved), (red, green, blue), gradient, grain=2.0)
    named = identify(patch, ALONE)
    assert named is None or not named.name.certain


@given(SIDES, shifts)
@settings(max_examples=10, deadline=None)
def test_a_stranger_is_not_believed(side: str, moved: tuple[float, float, float]) -> None:
    """However much it resembles the only product that may come."""
    named = identify(face_of(STRANGER, side, moved), ALONE)
    assert named is None or not named.name.certain


@given(SIDES, st.sampled_from((0.5, 0.75, 1.25)))
@settings(max_examples=9, deadline=None)
def test_brightness_leaves_the_score_unchanged(side: str, gain: float) -> None:
    """Up to the rounding of pixels."""
    patch = lit(face_of(A, side), (0.78, 0.78, 0.78))
    brighter = lit(face_of(A, side), (0.78 * gain,) * 3)
    one, other = identify(patch, GALLERY), identify(brighter, GALLERY)
    assert one is not None
    assert other is not None
    assert other.name.score == pytest.approx(one.name.score, abs=0.01)
    assert other.odds == pytest.approx(one.odds, abs=1.0)


@given(SIDES, shifts)
@settings(max_examples=15, deadline=None)
def test_the_print_tells_where_the_face_is(side: str, moved: tuple[float, float, float]) -> None:
    """To a fraction of a millimetre, where print and box agree."""
    named = identify(face_of(A, side, moved), GALLERY)
    assert named is not None
    told = named.refined
    assert (told.du, told.dv) == pytest.approx(moved[:2], abs=4e-4)
    assert told.turn == pytest.approx(moved[2], abs=5e-3)
    assert all(sigma > 0 for sigma in told.sigma)


@pytest.mark.parametrize("quarter", range(4))
def test_a_turned_top_is_named_with_its_turn(quarter: int) -> None:
    """And with its place, along the axes of the face as seen."""
    moved = (0.005, -0.003, 0.0)
    patch = face_of(A, "top", moved)
    colour = np.ascontiguousarray(np.rot90(patch.colour, -quarter))
    known = np.ascontiguousarray(np.rot90(patch.known, -quarter))
    size = patch.size if quarter % 2 == 0 else patch.size[::-1]
    named = identify(Patch(Facing.TOP, size, colour, known), GALLERY)
    assert named is not None
    assert (named.name.gtin, named.name.quarter) == (A.gtin, quarter)
    x, y = moved[:2]
    for _ in range(quarter):
        x, y = -y, x
    assert (named.refined.du, named.refined.dv) == pytest.approx((x, y), abs=5e-4)


@pytest.mark.parametrize("side", ["end", "side"])
def test_a_label_changes_no_name(side: str) -> None:
    """It is alike on all products; the book's pictures have none."""
    named = identify(face_of(A, side, studio=LABELLED), GALLERY)
    assert named is not None
    assert named.name.gtin == A.gtin
    assert named.name.certain


def test_a_face_of_another_size_has_no_name() -> None:
    """Print alone is not believed; where the size is nearly right, it is told and not certain."""
    patch = face_of(A, "side")
    assert identify(replace(patch, size=(0.32, 0.18)), GALLERY) is None
    named = identify(replace(patch, size=(0.29, 0.18)), GALLERY)
    assert named is not None
    assert named.name.gtin == A.gtin
    assert not named.name.certain


def test_a_blank_face_has_no_name() -> None:
    """Nothing is printed on it."""
    patch = face_of(A, "side")
    blank = replace(patch, colour=np.full_like(patch.colour, 170))
    named = identify(lit(blank, grain=2.0), GALLERY)
    assert named is None or not named.name.certain


def test_limits_can_be_set() -> None:
    """No odds are high enough for the careful."""
    named = identify(face_of(A, "side"), GALLERY, Limits(odds=1e9))
    assert named is not None
    assert not named.name.certain


def test_two_products_that_look_the_same_are_rivals() -> None:
    """Neither is certain, and each is told."""
    twin = product(int(A.gtin) + 1)
    entries = dict(book_of_drawings(A).entries)
    entries[twin.gtin] = replace(entries[A.gtin], product=twin)
    gallery = gallery_of(replace(BOOK, entries=entries), note_of(A, twin))
    named = identify(face_of(A, "side"), gallery)
    assert named is not None
    assert not named.name.certain
    assert {named.name.gtin, *named.rivals} == {A.gtin, twin.gtin}


def test_a_gallery_knows_what_nobody_has_seen() -> None:
    """Products of the note without pictures are told apart from those with some."""
    gallery = gallery_of(book_of_drawings(A), note_of(A, STRANGER))
    assert gallery.products == {A.gtin}
    assert {(each.gtin, side) for each, side in gallery.unpictured} == {
        (STRANGER.gtin, side) for side in ("end", "side", "top")
    }
    assert gallery.complete
    assert not gallery_of(BOOK).complete
