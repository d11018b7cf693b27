"""Laws of the photographs that fill the database of simulated products."""

import numpy as np

from depal.domain import Gtin, Product
from depal.perception.pictures import SIDES, pixels, side_size
from depal.simulation.imaging.photographs import Studio, book_of, drawn

PRODUCTS = tuple(
    Product(Gtin(f"{12000823000000 + k * 7919:014d}"), f"article {k}", (0.3, 0.2, 0.15), 4.0)
    for k in range(40)
)


def test_a_product_looks_the_same_whatever_others_there_are() -> None:
    """Its pictures follow from the seed and its number."""
    alone = book_of(PRODUCTS[:1], 3, 1.0)
    among = book_of(PRODUCTS[2::-1], 3, 1.0)
    for side in SIDES:
        one, other = (book.entries[PRODUCTS[0].gtin].faces[side] for book in (alone, among))
        np.testing.assert_array_equal(one, other)


def test_another_seed_takes_other_photographs_of_the_same_print() -> None:
    """Light and print differ; what is printed does not."""
    first, second = (book_of(PRODUCTS[:1], seed, 1.0) for seed in (1, 2))
    one, other = (
        book.entries[PRODUCTS[0].gtin].faces["top"].astype(float) for book in (first, second)
    )
    assert (one != other).mean() > 0.5
    assert np.corrcoef(one.ravel(), other.ravel())[0, 1] > 0.7


def test_about_the_stated_share_of_the_products_is_known() -> None:
    """Each is drawn by itself."""
    assert 25 <= len(book_of(PRODUCTS, 5, 0.8).entries) <= 39
    assert not book_of(PRODUCTS, 5, 0.0).entries


def test_pictures_have_a_pixel_for_every_millimetre() -> None:
    """As the book promises."""
    entry = book_of(PRODUCTS[:1], 1, 1.0).entries[PRODUCTS[0].gtin]
    for side in SIDES:
        width, height = pixels(side_size(PRODUCTS[0], side))
        assert entry.faces[side].shape == (height, width, 3)


def test_a_label_is_on_the_upright_faces_or_not() -> None:
    """Both kinds of photographs are taken; a label changes its own place alone."""
    random = np.random.default_rng(0)
    with_label = drawn(PRODUCTS[0], "side", random, Studio(labelled=1.0)).astype(int)
    without = drawn(PRODUCTS[0], "side", random, Studio(labelled=0.0)).astype(int)
    changed = np.argwhere(np.abs(with_label - without).sum(axis=2) > 0)
    low, high = changed.min(axis=0), changed.max(axis=0)
    assert (high - low < (60, 100)).all()
    assert low[0] > 40
